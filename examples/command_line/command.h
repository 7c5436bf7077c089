// SPDX-License-Identifier: Apache-2.0
// Tables of what a program takes: its subcommands and their options. The parser, the manual page
// and the completion script read these tables. Strings in a table outlive it.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_COMMAND_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_COMMAND_H_

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Reads a text into a variable, and returns what was expected: empty where the text is that.
using Reader = std::function<std::string(const std::string& text)>;

// The variable that an option sets: of a flag, of one text, of several texts, or of a value that is
// read (options.h). None for --help and --version.
struct Target {
  Target() = default;
  Target(bool* target) : flag(target) {}                       // NOLINT: for tables
  Target(std::string* target) : text(target) {}                // NOLINT: for tables
  Target(std::vector<std::string>* target) : texts(target) {}  // NOLINT: for tables
  explicit Target(Reader reader, std::string shown_default = "")
      : read(std::move(reader)), shown(std::move(shown_default)) {}

  bool* flag = nullptr;
  std::string* text = nullptr;
  std::vector<std::string>* texts = nullptr;
  Reader read = nullptr;
  std::string shown = "";  // the default, if `read` has one
};

enum class Use {
  kOptional,
  kDefault,  // optional, and the help shows the value that the variable has
  kRequired,
  kCommaSeparated,  // optional, and one argument has all values
};

struct Option {
  const char* names;  // "-o,--output"; a name without dashes: a positional argument
  const char* type;   // of the value, as the help shows it: "FILE"; null for a flag
  const char* help;
  Target target;
  Use use = Use::kOptional;
  const char* excludes = nullptr;      // an earlier option that cannot stand beside this one
  const char* default_text = nullptr;  // what the help shows as the default of kOptional
};

inline const Option kHelpOption = {"-h,--help", nullptr, "Print this help and exit", {}};
inline const Option kVersionOption = {"--version", nullptr, "Print the version and exit", {}};

struct Command {
  const char* name;
  const char* help;
  std::vector<Option> options;
  std::function<Error()> run;
  std::vector<std::string> examples = {};  // complete command lines, shown at the end of the help
  const char* footer = "";                 // notes between the options and the examples
};

struct Program {
  Command main;                                // options without a subcommand
  std::vector<Command> commands;               // one of them must be chosen, if there are any
  std::vector<std::string> lab_commands = {};  // names of subcommands of starfocus-lab
};

// The last lines of a program's help.
inline constexpr char kExitCodes[] =
    "Exit codes: 0 for success, 1 when a file or the work failed, 2 when the command line is\n"
    "wrong, 70 for an error in the program itself.\n";

// Appends to a command's options.
void AddOptions(std::initializer_list<Option> options, Command* command);

// All options of a command, --help and, of the program itself, --version among them, in the order
// of the help.
std::vector<Option> AllOptions(const Program& program, const Command& command);

// The names of an option, each with its dashes.
std::vector<std::string> NamesOf(const Option& option);

bool IsPositional(const Option& option);

// What the help shows as the default of an option; empty for none.
std::string DefaultOf(const Option& option);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_COMMAND_H_
