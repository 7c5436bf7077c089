// SPDX-License-Identifier: Apache-2.0
// What a function that can fail returns: an error, or a value or else an error.
#ifndef STARFOCUS_PLATFORM_RESULT_H_
#define STARFOCUS_PLATFORM_RESULT_H_

#include <string>
#include <system_error>
#include <utility>

namespace starfocus {

enum class ErrorKind {
  kNone,
  kInput,     // a file, a device or the memory is not as needed
  kUsage,     // the command line is wrong
  kInternal,  // starfocus itself is wrong
};

// One line that names the file or option and the cause; true where there is an error:
//   if (Error error = WriteFile(path, bytes)) return error;
class [[nodiscard]] Error {
 public:
  Error() = default;  // success
  // Line breaks and other control characters of `line`, which names and contents of files may have,
  // become spaces.
  Error(ErrorKind kind, std::string line);

  // The command line asks for what cannot be: "<option>: expected <expected>, found <found>".
  static Error Usage(const std::string& option, const std::string& expected,
                     const std::string& found);
  // starfocus itself is wrong.
  static Error Internal(const std::string& where, const std::string& expected,
                        const std::string& found);

  explicit operator bool() const { return kind_ != ErrorKind::kNone; }
  ErrorKind kind() const { return kind_; }
  const std::string& line() const { return line_; }

 private:
  ErrorKind kind_ = ErrorKind::kNone;
  std::string line_;
};

// "<where>: expected <expected>, found <found>".
Error Expected(const std::string& where, const std::string& expected, const std::string& found);

// "cannot <action> <path>: <reason>". A system's reason begins in lower case: "cannot read
// photo.jpg: permission denied".
Error Cannot(const std::string& action, const std::string& path, const std::string& reason);
Error Cannot(const std::string& action, const std::string& path, std::error_code reason);

// The error of whoever caught std::bad_alloc: "<where>: expected enough memory to <purpose>, ...".
Error OutOfMemory(const std::string& where, const std::string& purpose);

// A value, or the error why there is none; true where there is a value.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}      // NOLINT: so that functions return values
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: so that functions return errors

  explicit operator bool() const { return !error_; }
  const Error& error() const { return error_; }
  T& operator*() { return value_; }
  const T& operator*() const { return value_; }
  T* operator->() { return &value_; }
  const T* operator->() const { return &value_; }

  // Moves the value to `target`, which stays as it is where there is none. Returns the error:
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
