// SPDX-License-Identifier: Apache-2.0
// What went wrong in a program, and whose it is.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_ERROR_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_ERROR_H_

#include <string>
#include <utility>

namespace starfocus {

// What a program returns to its caller. The number of an internal error is that of sysexits.h.
enum class ExitCode { kSuccess = 0, kFailed = 1, kUsage = 2, kInternal = 70 };

// An error line with its exit code; empty for success.
class Error {
 public:
  Error() = default;
  // A line of platform/: the work failed, by a file or for want of memory.
  Error(std::string line)  // NOLINT: functions return lines of platform/ as they are
      : Error(std::move(line), ExitCode::kFailed) {}
  Error(const char* line) : Error(std::string(line)) {}  // NOLINT: so that "" is success

  // The command line asks for what cannot be: "<option>: expected <expected>, found <found>".
  static Error Usage(const std::string& option, const std::string& expected,
                     const std::string& found);
  // starfocus itself is wrong.
  static Error Internal(const std::string& where, const std::string& expected,
                        const std::string& found);

  bool empty() const { return line_.empty(); }
  const std::string& line() const { return line_; }
  ExitCode code() const { return code_; }

 private:
  Error(std::string line, ExitCode code)
      : line_(std::move(line)), code_(line_.empty() ? ExitCode::kSuccess : code) {}

  std::string line_;
  ExitCode code_ = ExitCode::kSuccess;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_ERROR_H_
