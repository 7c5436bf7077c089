// SPDX-License-Identifier: Apache-2.0
// Tables of a program's subcommands and their options, for the parser, the help, the manual page
// and the completion script. Strings must outlive the table that contains them. The first level of
// the help (--help) contains the options that most users need, and the second level (--help-all)
// contains all options.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_COMMAND_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_COMMAND_H_

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Parses a text into a variable. Returns an empty string on success, otherwise a description of the
// expected value.
using Reader = std::function<std::string(const std::string& text)>;

// The variable that an option sets: a flag, one text, several texts, or a parsed value (options.h).
// --help and --version set no variable.
struct Target {
  Target() = default;
  Target(bool* target) : flag(target) {}                       // NOLINT: implicit for tables
  Target(std::string* target) : text(target) {}                // NOLINT: implicit for tables
  Target(std::vector<std::string>* target) : texts(target) {}  // NOLINT: implicit for tables
  explicit Target(Reader reader, std::string shown_default = "")
      : read(std::move(reader)), shown(std::move(shown_default)) {}

  bool* flag = nullptr;
  std::string* text = nullptr;
  std::vector<std::string>* texts = nullptr;
  Reader read = nullptr;
  std::string shown = "";  // default value that the help shows for `read`; empty: none
};

enum class Use {
  kOptional,
  kDefault,  // optional; the help shows the initial value of the variable
  kRequired,
  kCommaSeparated,  // optional; one argument contains all values, separated by commas
};

struct Option {
  const char* names;  // "-o,--output"; a name without dashes is a positional argument.
  const char* type;   // Type of the value in the help: "FILE"; null for a flag.
  const char* help;
  Target target;
  Use use = Use::kOptional;
  const char* excludes = nullptr;  // An earlier option that cannot be combined with this option.
  const char* default_text = nullptr;  // Default that the help shows if `use` is kOptional.
};

inline const Option kHelpOption = {"-h,--help", nullptr, "Print this help and exit", {}};
inline const Option kHelpAllOption = {
    "--help-all", nullptr, "Print the help of all options and exit", {}};
inline const Option kVersionOption = {"--version", nullptr, "Print the version and exit", {}};

// An option, positional argument or command in the first level of the help.
struct HelpLine {
  const char* name;            // One of its names, such as "--output".
  const char* text = nullptr;  // Short description; null: the description in its table.
};

struct HelpGroup {
  const char* title;
  std::vector<HelpLine> lines;
};

struct Command {
  const char* name;
  const char* help;
  std::vector<Option> options;
  std::function<Error()> run;
  std::vector<std::string> examples = {};  // Complete command lines, shown at the end of the help.
  const char* footer = "";                 // Notes between the options and the examples.
  // First level of the help, which --help prints; empty: --help prints all options. The last group
  // of a program contains its options, and the other groups contain its commands.
  std::vector<HelpGroup> basics = {};
  // Returns true if the parsed options make the command start other programs; null: never. Other
  // commands give up the right to start programs.
  std::function<bool()> starts_programs = nullptr;
};

struct Program {
  Command main;                   // Options of the program without a subcommand.
  std::vector<Command> commands;  // Subcommands, one of which the user must choose; may be empty.
  std::vector<std::string> lab_commands = {};  // Names of subcommands of starfocus-lab.
};

// Last lines of a program's help.
inline constexpr char kExitCodes[] =
    "Exit codes: 0 for success, 1 when a file or the work failed, 2 when the command\n"
    "line is wrong, 70 for an error in the program itself.\n";

// Appends `options` to a command.
void AddOptions(std::initializer_list<Option> options, Command* command);

// Returns all options of a command in the order of the help, including --help and, for the program
// itself, --version.
std::vector<Option> AllOptions(const Program& program, const Command& command);

// Returns the names of an option, including their dashes.
std::vector<std::string> NamesOf(const Option& option);

bool IsPositional(const Option& option);

// Returns the default that the help shows for an option, or an empty string if the option has none.
std::string DefaultOf(const Option& option);

// Returns the first level of the help of a program or of one of its commands.
std::string BasicHelp(const Program& program, const Command& command);

// Returns the first lines of the help of a program, up to the list of its commands.
std::string FirstLinesOfHelp(const Program& program);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_COMMAND_H_
