// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/engine/timing_file.h"

#include <nlohmann/json.hpp>

#include "examples/cli/engine/timing_terms.h"
#include "platform/file.h"

namespace starfocus {
namespace {

// Coefficient `name` of the object, in picoseconds.
std::string ReadCoefficient(const std::string& path, const nlohmann::json& object,
                            const std::string& name, uint32_t* value) {
  const auto expected = [&](const std::string& found) {
    return Expected(
        path, "timing." + name + " as a whole number from 0 to " + std::to_string(SF_MAX_TIMING),
        found);
  };
  const auto member = object.find(name);
  if (member == object.end()) return expected("none");
  // Negative numbers are another type of the parser.
  if (!member->is_number_unsigned() || member->get<uint64_t>() > SF_MAX_TIMING) {
    return expected(member->dump(-1, ' ', true).substr(0, 60));
  }
  *value = static_cast<uint32_t>(member->get<uint64_t>());
  return "";
}

}  // namespace

Json TimingJson(const sf_timing& timing) {
  Json json;
  for (const TimingTerm& term : kTimingTerms) json.Set(term.name, timing.*term.coefficient);
  return json;
}

std::string ReadTiming(const std::string& path, sf_timing* timing) {
  Bytes bytes;
  std::string error = ReadSmallFile(path, &bytes);
  if (!error.empty()) return error;
  const nlohmann::json json = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (json.is_discarded()) return Expected(path, "a JSON file", "other text");
  const auto object = json.is_object() ? json.find("timing") : json.end();
  if (object == json.end() || !object->is_object()) {
    return Expected(path, "an object \"timing\", as starfocus calibrate writes it", "none");
  }
  for (const TimingTerm& term : kTimingTerms) {
    error = ReadCoefficient(path, *object, term.name, &(timing->*term.coefficient));
    if (!error.empty()) return error;
  }
  for (const auto& [name, value] : object->items()) {
    bool known = false;
    for (const TimingTerm& term : kTimingTerms) known = known || name == term.name;
    if (!known) return Expected(path, "no other coefficients", "timing." + name.substr(0, 60));
  }
  return "";
}

}  // namespace starfocus
