// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/documentation/documentation.h"
#include "starfocus/version.h"

namespace starfocus {
namespace {

// Text as roff shows it: a hyphen would become another character, and a dot or an apostrophe at
// the beginning of a line would be a request.
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

// "-o, --output FILE"
std::string Head(const CLI::Option& option) {
  if (option.get_positional()) return Italic(option.get_name(true));
  std::string head;
  for (const std::string& name : option.get_snames()) head += Bold("-" + name) + ", ";
  for (const std::string& name : option.get_lnames()) head += Bold("--" + name) + ", ";
  head.resize(head.size() - 2);
  const bool flag = option.get_expected_max() == 0;
  return flag ? head : head + " " + Italic(option.get_type_name());
}

std::string Entry(const CLI::Option& option) {
  std::string text = ".TP\n" + Head(option) + "\n" + Roff(option.get_description());
  if (!option.get_default_str().empty())
    text += " (default: " + Roff(option.get_default_str()) + ")";
  if (option.get_required()) text += " (required)";
  return text + "\n";
}

std::string Command(const CLI::App& command) {
  std::string text = ".SS " + Roff(command.get_name());
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) text += " " + Roff(option->get_name(true));
  }
  text += "\n" + Roff(command.get_description()) + "\n";
  if (!command.get_footer().empty()) text += ".PP\n" + Roff(command.get_footer()) + "\n";
  for (const CLI::Option* option : command.get_options()) text += Entry(*option);
  return text;
}

}  // namespace

std::string ManualText(CLI::App* app) {
  const std::string& name = app->get_name();
  std::string text = ".TH STARFOCUS 1 \"\" \"starfocus " SF_VERSION_STRING "\"\n.SH NAME\n" + name +
                     " \\- refocus photographs after they were taken\n.SH SYNOPSIS\n" + Bold(name) +
                     " " + Italic("COMMAND") + " [" + Italic("OPTION") + "...]\n.SH DESCRIPTION\n" +
                     Roff(app->get_description()) + "\n.SH OPTIONS\n";
  for (const CLI::Option* option : app->get_options()) text += Entry(*option);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : app->get_subcommands({})) text += Command(*command);
  return text + ".SH EXIT STATUS\n" + Roff(app->get_footer());
}

}  // namespace starfocus
