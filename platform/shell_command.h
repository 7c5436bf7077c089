// SPDX-License-Identifier: Apache-2.0
// Runs a command of the shell with a time limit.
#ifndef STARFOCUS_PLATFORM_SHELL_COMMAND_H_
#define STARFOCUS_PLATFORM_SHELL_COMMAND_H_

#include <string>

#include "platform/result.h"

namespace starfocus {

// Returns `text` as one word of the shell.
std::string ShellQuoted(const std::string& text);

// Runs `command` by /bin/sh and waits for its end. The input of the command is empty, and its
// output is written to the file `log`. After the end of the shell, after `seconds`, or if a signal
// ends the program, all processes that the command started in its process group are killed.
//
// @return success if the exit code of the command is 0. Error messages start with `where` and
//     contain the exit code, or the signal or time limit that ended the command, and the last lines
//     of the log.
Error RunShellCommand(const std::string& where, const std::string& command, int seconds,
                      const std::string& log);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_SHELL_COMMAND_H_
