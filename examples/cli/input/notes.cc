// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/notes.h"

#include <map>
#include <mutex>
#include <set>

#include "platform/console.h"
#include "platform/natural_order.h"

namespace starfocus {
namespace {

std::mutex mutex;                              // protects the variables below
std::map<std::string, std::string> inputs_of;  // the input of each printed note without numbers
std::set<std::string> told;                    // all printed notes
std::map<std::string, std::set<std::string>> others_of;  // other inputs with a note of an input

}  // namespace

void TellNote(const std::string& input, const std::string& note) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto [printed, is_new] = inputs_of.emplace(ParseNumberedName(note).shape, input);
  if (is_new || (printed->second == input && told.insert(note).second)) {
    told.insert(note);
    TellLine(input + ": " + note);
  } else if (printed->second != input) {
    others_of[printed->second].insert(input);
  }
}

void TellOtherInputs() {
  const std::lock_guard<std::mutex> lock(mutex);
  for (const auto& [input, others] : others_of) {
    TellLine(
        "starfocus: notes like those about " + input + " apply to " +
        (others.size() == 1 ? *others.begin() : std::to_string(others.size()) + " other inputs"));
  }
}

}  // namespace starfocus
