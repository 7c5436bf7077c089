// SPDX-License-Identifier: Apache-2.0
// starfocus help: prints help, the manual page or the completion script.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/command_line/parse.h"
#include "starfocus/version.h"

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
  if (type.find("FILE") != std::string::npos) return "-f";  // lists folders, too
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

namespace {

// Escapes a text for roff, in which hyphens, and dots and apostrophes at the start of a line, have
// special meanings.
std::string Roff(const std::string& text) {
  std::string roff;
  for (const char c : text) {
    if (c == '\\' || c == '-') roff += '\\';
    roff += c == '\\' ? "e" : std::string(1, c);
  }
  const bool request = !roff.empty() && (roff[0] == '.' || roff[0] == '\'');
  return request ? "\\&" + roff : roff;
}

std::string Bold(const std::string& text) { return "\\fB" + Roff(text) + "\\fR"; }
std::string Italic(const std::string& text) { return "\\fI" + Roff(text) + "\\fR"; }

// Formats the names and the type of an option: "-o, --output FILE".
std::string Head(const Option& option) {
  if (IsPositional(option)) return Italic(option.names);
  std::string head;
  for (const std::string& name : NamesOf(option)) head += (head.empty() ? "" : ", ") + Bold(name);
  return option.type == nullptr ? head : head + " " + Italic(option.type);
}

std::string Entry(const Option& option) {
  std::string text = ".TP\n" + Head(option) + "\n" + Roff(option.help);
  if (!DefaultOf(option).empty()) text += " (default: " + Roff(DefaultOf(option)) + ")";
  if (option.use == Use::kRequired) text += " (required)";
  return text + "\n";
}

std::string Entries(const Program& program, const Command& command) {
  std::string text;
  for (const Option& option : AllOptions(program, command)) text += Entry(option);
  return text;
}

std::string Section(const Program& program, const Command& command) {
  std::string text = ".SS " + Roff(command.name);
  for (const Option& option : command.options) {
    if (IsPositional(option)) text += " " + Roff(option.names);
  }
  text += "\n" + Roff(command.help) + "\n";
  const std::string footer = command.footer;
  if (!footer.empty()) text += ".PP\n" + Roff(footer) + "\n";
  text += Entries(program, command);
  if (command.examples.empty()) return text;
  text += ".PP\nExamples:\n.RS\n.nf\n";
  for (const std::string& example : command.examples) text += Roff(example) + "\n";
  return text + ".fi\n.RE\n";
}

}  // namespace

std::string ManualText(const Program& program) {
  const std::string name = Roff(program.main.name);
  std::string text = ".TH " + name +
                     " 1 \"\" \"starfocus " STARFOCUS_VERSION_STRING "\"\n.SH NAME\n" + name +
                     " \\- " + Roff(program.main.help) + "\n.SH SYNOPSIS\n" +
                     Bold(program.main.name) + " " + Italic("COMMAND") + " [" + Italic("OPTION") +
                     "...]\n.SH OPTIONS\n" + Entries(program, program.main) + ".SH COMMANDS\n";
  for (const Command& command : program.commands) text += Section(program, command);
  return text + ".SH EXIT STATUS\n" + Roff(kExitCodes);
}

namespace {

struct HelpOptions {
  std::string command;
  bool manual = false, completion = false;
};

Error Run(const Program& program, const HelpOptions& options) {
  if (options.manual || options.completion) {
    const std::string text = options.manual ? ManualText(program) : CompletionText(program);
    std::printf("%s", text.c_str());
    return {};
  }
  const Command* command = options.command.empty() ? &program.main : nullptr;
  std::vector<std::string> names;
  for (const Command& one : program.commands) {
    names.push_back(one.name);
    if (one.name == options.command) command = &one;
  }
  if (command != nullptr) {
    std::printf("%s", HelpText(program, *command).c_str());
    return {};
  }
  const std::string nearest = NearestName(options.command, names);
  return Error::Usage("COMMAND",
                      nearest.empty()
                          ? "a subcommand that `" + std::string(program.main.name) + " help` lists"
                          : "a subcommand (the most similar is " + nearest + ")",
                      options.command);
}

}  // namespace

Command HelpCommand(const Program* program) {
  const auto options = std::make_shared<HelpOptions>();
  const std::string name = program->main.name;
  return {
      "help",
      "Print the help of the program or of a command",
      {
          {"COMMAND", "NAME", "Command to describe; default: the whole program", &options->command},
          {"--man", nullptr, "Print the manual page of all commands, in the format of man",
           &options->manual},
          {"--bash", nullptr, "Print the completion script for bash", &options->completion,
           Use::kOptional, "--man"},
      },
      [program, options] { return Run(*program, *options); },
      {name + " help --man > " + name + ".1", name + " help --bash > " + name + ".bash"}};
}

}  // namespace starfocus
