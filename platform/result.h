// SPDX-License-Identifier: Apache-2.0
// Return types of functions that can fail: Error, and Result, which holds a value or an error.
#ifndef STARFOCUS_PLATFORM_RESULT_H_
#define STARFOCUS_PLATFORM_RESULT_H_

#include <string>
#include <system_error>
#include <utility>

namespace starfocus {

enum class ErrorKind {
  kNone,
  kInput,     // An unsuitable file or device, or insufficient memory.
  kUsage,     // Invalid command line.
  kInternal,  // Defect of starfocus.
};

// A one-line error message that names the file or option and the cause. An Error converts to true
// if the error is not success:
//   if (Error error = WriteFile(path, bytes)) return error;
class [[nodiscard]] Error {
 public:
  Error() = default;  // Creates an error that means success.
  // Replaces control characters such as line breaks in `line` by spaces. Messages may contain
  // control characters because they quote names and contents of files.
  Error(ErrorKind kind, std::string line);

  // Returns an error of the command line: "<option>: expected <expected>, found <found>".
  static Error Usage(const std::string& option, const std::string& expected,
                     const std::string& found);
  // Returns an error for a defect of starfocus.
  static Error Internal(const std::string& where, const std::string& expected,
                        const std::string& found);

  explicit operator bool() const { return kind_ != ErrorKind::kNone; }
  ErrorKind kind() const { return kind_; }
  const std::string& line() const { return line_; }

 private:
  ErrorKind kind_ = ErrorKind::kNone;
  std::string line_;
};

// Returns "<where>: expected <expected>, found <found>".
Error Expected(const std::string& where, const std::string& expected, const std::string& found);

// Returns "cannot <action> <path>: <reason>". A reason from the operating system is converted to
// start in lower case: "cannot read photo.jpg: permission denied".
Error Cannot(const std::string& action, const std::string& path, const std::string& reason);
Error Cannot(const std::string& action, const std::string& path, std::error_code reason);

// Returns "<where>: <format> is not supported: this program was built without <library>".
Error Unsupported(const std::string& where, const std::string& format, const std::string& library);

// Returns the error for insufficient memory: "<where>: out of memory, cannot <purpose>".
Error OutOfMemory(const std::string& where, const std::string& purpose);

// Holds a value or an error. A Result converts to true if it holds a value.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}      // NOLINT: implicit for return
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit for return

  explicit operator bool() const { return !error_; }
  const Error& error() const { return error_; }
  T& operator*() { return value_; }
  const T& operator*() const { return value_; }
  T* operator->() { return &value_; }
  const T* operator->() const { return &value_; }

  // Moves the value to `target` and returns success, or returns the error and leaves `target`
  // unchanged:
  //   if (Error error = ReadImage(path).MoveTo(&image)) return error;
  Error MoveTo(T* target) {
    if (!error_) *target = std::move(value_);
    return error_;
  }

 private:
  T value_ = {};
  Error error_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_RESULT_H_
