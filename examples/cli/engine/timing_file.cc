// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/engine/timing_file.h"

#include "examples/cli/engine/timing_terms.h"
#include "platform/file.h"
#include "starfocus/experimental.h"

namespace starfocus {
namespace {

// Reads coefficient `name` of the object, in picoseconds.
Result<uint32_t> ReadCoefficient(const std::string& path, const JsonObject& object,
                                 const std::string& name) {
  const auto expected = [&](const std::string& found) {
    return Expected(
        path,
        "timing." + name + " as a whole number from 0 to " + std::to_string(STARFOCUS_MAX_TIMING),
        found);
  };
  for (const JsonMember& member : object.members) {
    if (member.name != name) continue;
    if (!member.is_whole || member.whole > STARFOCUS_MAX_TIMING) {
      return expected(member.text.substr(0, 60));
    }
    return static_cast<uint32_t>(member.whole);
  }
  return expected("none");
}

}  // namespace

Json TimingJson(const starfocus_timing& timing) {
  Json json;
  for (const TimingTerm& term : kTimingTerms) json.Set(term.name, timing.*term.coefficient);
  return json;
}

Result<starfocus_timing> ReadTiming(const std::string& path) {
  const Result<Bytes> bytes = ReadSmallFile(path);
  if (!bytes) return bytes.error();
  const JsonObject object = ReadJsonObject(*bytes, "timing");
  if (!object.is_json) return Expected(path, "a JSON file", "other text");
  if (!object.is_there) {
    return Expected(path, "an object \"timing\", as written by starfocus-lab calibrate", "none");
  }
  starfocus_timing timing = {};
  for (const TimingTerm& term : kTimingTerms) {
    Error error = ReadCoefficient(path, object, term.name).MoveTo(&(timing.*term.coefficient));
    if (error) return error;
  }
  for (const JsonMember& member : object.members) {
    bool known = false;
    for (const TimingTerm& term : kTimingTerms) known = known || member.name == term.name;
    if (!known)
      return Expected(path, "only known coefficients", "timing." + member.name.substr(0, 60));
  }
  return timing;
}

}  // namespace starfocus
