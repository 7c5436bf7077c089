// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "examples/cli/documentation/documentation.h"

namespace starfocus {
namespace {

std::string AllNames(const Program& program, const Command& command) {
  std::string names;
  for (const Option& option : AllOptions(program, command)) {
    if (IsPositional(option)) continue;
    for (const std::string& name : NamesOf(option)) names += (names.empty() ? "" : " ") + name;
  }
  return names;
}

// Returns true for a pattern such as "polygon:N", in which a capital stands for a value.
bool IsPattern(const std::string& word) {
  return std::any_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

// Returns the arguments of compgen that list the values of a type, or an empty string if the values
// are unknown.
std::string Values(const std::string& type) {
  if (type == "FILE") return "-f";
  if (type == "DIR") return "-d";
  if (type.find('|') == std::string::npos) return "";
  std::string words;
  for (size_t begin = 0; begin < type.size();) {
    const size_t end = std::min(type.find('|', begin), type.size());
    const std::string word = type.substr(begin, end - begin);
    if (!IsPattern(word)) words += (words.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return "-W '" + words + "'";
}

// Returns a branch of a shell `case` statement for each option of the command that takes a value.
// `reply` is the shell function that completes values.
std::string ValueBranches(const Command& command, const std::string& reply) {
  std::string text;
  for (const Option& option : command.options) {
    if (IsPositional(option) || option.type == nullptr) continue;
    const std::string values = Values(option.type);
    for (const std::string& name : NamesOf(option)) {
      text += std::string("    ") + command.name + "," + name + ") ";
      text += (values.empty() ? "" : reply + " " + values + "; ") + "return ;;\n";
    }
  }
  return text;
}

}  // namespace

std::string CompletionText(const Program& program) {
  const std::string name = program.main.name, reply = "_" + name + "_reply";
  std::string commands, names, values;
  for (const Command& command : program.commands) {
    commands += std::string(" ") + command.name;
    names +=
        std::string("    ") + command.name + ") names='" + AllNames(program, command) + "' ;;\n";
    values += ValueBranches(command, reply);
  }
  commands = commands.substr(1);
  // Each line of compgen is one completion, because names of files may contain spaces. "help" is
  // followed by the name of another command.
  return "# bash completion for " + name + ", written by `" + name + " help --bash`\n" + reply +
         "() {\n"
         "  local line\n"
         "  while IFS= read -r line; do\n"
         "    COMPREPLY+=(\"$line\")\n"
         "  done < <(compgen \"$@\" -- \"$word\")\n"
         "}\n_" +
         name +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} names\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
         "    " +
         reply + " -W '" + commands + " " + AllNames(program, program.main) +
         "'\n    return\n  fi\n"
         "  case $command,${COMP_WORDS[COMP_CWORD-1]} in\n" +
         values +
         "  esac\n"
         "  case $command in\n" +
         names +
         "  esac\n"
         "  if [ \"$command\" = help ]; then\n"
         "    " +
         reply + " -W '" + commands +
         " '\"$names\"\n"
         "  elif [ \"${word#-}\" != \"$word\" ]; then\n"
         "    " +
         reply +
         " -W \"$names\"\n"
         "  else\n"
         "    " +
         reply +
         " -f\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _" +
         name + " " + name + "\n";
}

}  // namespace starfocus
