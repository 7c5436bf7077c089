// SPDX-License-Identifier: Apache-2.0
// Prints the lines of the programs. All lines on stderr go through this module, so that a line
// never continues the progress line, and so that names and contents of files cannot control the
// terminal. All functions are thread-safe.
#ifndef STARFOCUS_PLATFORM_CONSOLE_H_
#define STARFOCUS_PLATFORM_CONSOLE_H_

#include <string>

namespace starfocus {

// Prints a line on stderr, for example a note or an error. Replaces control characters (Printable).
// If a progress line is shown, the line appears above the progress line.
void TellLine(const std::string& line);

// Prints a line of the result on stdout. Replaces control characters.
void PrintLine(const std::string& line);

// Returns true if stderr is a terminal that can show a progress line.
bool CanShowProgress();

// Shows a progress line on stderr, in place of the previous progress line. If `label` and `state`
// are together wider than the terminal, cuts the end of `label`.
void ShowProgress(const std::string& label, const std::string& state);

// Erases the progress line, if one is shown.
void EraseProgress();

// Returns the text of a progress line that is at most `columns` wide.
std::string ProgressText(const std::string& label, const std::string& state, int columns);

// Returns `text` if the text is at most `columns` wide, otherwise a beginning of `text` and "...".
// The text is UTF-8. Wide characters count as two columns, and combining characters as none.
std::string FitColumns(const std::string& text, int columns);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CONSOLE_H_
