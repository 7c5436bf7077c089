// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/documentation/documentation.h"
#include "starfocus/version.h"

namespace starfocus {
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

}  // namespace starfocus
