// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "examples/cli/documentation/documentation.h"

namespace starfocus {
namespace {

// All names of an option, " -o --output".
std::string Names(const CLI::Option& option, const std::string& separator) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += separator + "-" + name;
  for (const std::string& name : option.get_lnames()) names += separator + "--" + name;
  return names;
}

std::string AllNames(const CLI::App& app) {
  std::string names;
  for (const CLI::Option* option : app.get_options()) names += Names(*option, " ");
  return names.empty() ? names : names.substr(1);
}

// "polygon:N" stands for several words: parts of a type in capitals are to be replaced.
bool IsPattern(const std::string& word) {
  return std::any_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

// The shell command that sets COMPREPLY to the values of an option; empty where nobody knows them.
std::string Values(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type == "FILE") return "COMPREPLY=($(compgen -f -- \"$word\"))";
  if (type == "DIR") return "COMPREPLY=($(compgen -d -- \"$word\"))";
  if (type.find('|') == std::string::npos) return "";
  std::string words;
  for (size_t begin = 0; begin < type.size();) {
    const size_t end = std::min(type.find('|', begin), type.size());
    const std::string word = type.substr(begin, end - begin);
    if (!IsPattern(word)) words += (words.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return "COMPREPLY=($(compgen -W '" + words + "' -- \"$word\"))";
}

// A branch for each option of the command that takes a value.
std::string ValueBranches(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    const std::string names = Names(*option, "|");
    if (names.empty() || option->get_expected_max() == 0) continue;
    for (size_t at = 0; at < names.size(); at = names.find('|', at + 1)) {
      const size_t end = std::min(names.find('|', at + 1), names.size());
      text += "    " + command.get_name() + "," + names.substr(at + 1, end - at - 1) + ") " +
              Values(*option) + (Values(*option).empty() ? "" : "; ") + "return ;;\n";
    }
  }
  return text;
}

}  // namespace

std::string CompletionText(CLI::App* app) {
  std::string commands, names, values;
  for (const CLI::App* command : app->get_subcommands({})) {
    commands += " " + command->get_name();
    names += "    " + command->get_name() + ") names='" + AllNames(*command) + "' ;;\n";
    values += ValueBranches(*command);
  }
  commands = commands.substr(1);
  // "help" is completed by the names of the others.
  return "# bash completion for " + app->get_name() + ", written by `" + app->get_name() +
         " help --bash`\n_" + app->get_name() +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} names\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         commands + " " + AllNames(*app) +
         "' -- \"$word\"))\n    return\n  fi\n"
         "  case $command,${COMP_WORDS[COMP_CWORD-1]} in\n" +
         values +
         "  esac\n"
         "  case $command in\n" +
         names +
         "  esac\n"
         "  if [ \"$command\" = help ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         commands +
         " '\"$names\" -- \"$word\"))\n"
         "  elif [ \"${word#-}\" != \"$word\" ]; then\n"
         "    COMPREPLY=($(compgen -W \"$names\" -- \"$word\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _" +
         app->get_name() + " " + app->get_name() + "\n";
}

}  // namespace starfocus
