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

namespace {

// Longest value of an option in columns. Longer values end with "|..." after whole alternatives.
constexpr size_t kLongestType = 14;

// Returns the names of an option and the type of its value, such as "-o,--output FILE".
std::string HeadOf(const Option& option) {
  if (option.type == nullptr || IsPositional(option)) return option.names;
  std::string type = option.type;
  if (type.size() > kLongestType && type.find('|') != std::string::npos) {
    type = type.substr(0, type.rfind('|', kLongestType - 4)) + "|...";
  }
  return option.names + (" " + type);
}

struct Line {
  std::string head, text;
};

// Finds the command or option of a line. The head is empty if the name is unknown.
Line Find(const Program& program, const Command& command, const HelpLine& line) {
  const auto text = [&line](const char* usual) { return line.text == nullptr ? usual : line.text; };
  for (const Command& one : program.commands) {
    const bool named = &command == &program.main && line.name == std::string(one.name);
    if (named) return {one.name, text(one.help)};
  }
  for (const Option& option : AllOptions(program, command)) {
    const std::vector<std::string> names = NamesOf(option);
    const bool named = std::find(names.begin(), names.end(), line.name) != names.end();
    if (named) return {HeadOf(option), text(option.help)};
  }
  return {};
}

// Returns the lines of the groups, whose descriptions begin in the same column.
std::string GroupsText(const Program& program, const Command& command,
                       const std::vector<HelpGroup>& groups) {
  size_t longest = 0;
  for (const HelpGroup& group : groups) {
    for (const HelpLine& line : group.lines) {
      longest = std::max(longest, Find(program, command, line).head.size());
    }
  }
  std::string text;
  for (const HelpGroup& group : groups) {
    text += std::string(group.title) + ":\n";
    for (const HelpLine& one : group.lines) {
      const Line line = Find(program, command, one);
      text +=
          "  " + line.head + std::string(longest - line.head.size() + 2, ' ') + line.text + "\n";
    }
  }
  return text;
}

// Returns the description and the usage line.
std::string Opening(const Program& program, const Command& command) {
  std::string text = std::string(command.help) + "\nUsage: " + program.main.name;
  if (&command == &program.main) return text + " COMMAND [OPTIONS]\n\n";
  text += std::string(" ") + command.name + " [OPTIONS]";
  for (const Option& option : command.options) {
    if (!IsPositional(option)) continue;
    const bool several = option.target.texts != nullptr;
    text += std::string(" ") + option.names + (several ? "..." : "");
  }
  return text + "\n\n";
}

}  // namespace

std::string BasicHelp(const Program& program, const Command& command) {
  std::string text = Opening(program, command) + GroupsText(program, command, command.basics);
  if (!command.examples.empty()) text += "\nExamples:\n";
  for (const std::string& example : command.examples) text += "  " + example + "\n";
  const std::string name = program.main.name;
  if (&command != &program.main) {
    return text + "\n`" + name + " " + command.name + " --help-all` lists all options.\n";
  }
  return text + "\n`" + name + " COMMAND --help` describes a command.\n" + kExitCodes;
}

std::string FirstLinesOfHelp(const Program& program) {
  const std::string help = BasicHelp(program, program.main);
  const std::string options = std::string("\n") + program.main.basics.back().title + ":";
  return help.substr(0, help.find(options) + 1) + "\n`" + program.main.name +
         " --help` prints more.\n";
}

}  // namespace starfocus
