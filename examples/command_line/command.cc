// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/command.h"

#include <algorithm>

namespace starfocus {

void AddOptions(std::initializer_list<Option> options, Command* command) {
  command->options.insert(command->options.end(), options);
}

std::vector<Option> AllOptions(const Program& program, const Command& command) {
  std::vector<Option> options = {kHelpOption};
  if (!program.main.basics.empty()) options.push_back(kHelpAllOption);
  options.insert(options.end(), command.options.begin(), command.options.end());
  if (&command == &program.main) options.push_back(kVersionOption);
  return options;
}

std::vector<std::string> NamesOf(const Option& option) {
  std::vector<std::string> names;
  const std::string text = option.names;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    names.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

bool IsPositional(const Option& option) { return option.names[0] != '-'; }

std::string DefaultOf(const Option& option) {
  if (option.default_text != nullptr) return option.default_text;
  if (option.use != Use::kDefault) return "";
  return option.target.text != nullptr ? *option.target.text : option.target.shown;
}

}  // namespace starfocus
