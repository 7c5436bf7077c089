// SPDX-License-Identifier: Apache-2.0
// Comparison of errors with expected lines ("" for no error), and search for parts of texts.
#ifndef STARFOCUS_TESTS_SUPPORT_ERROR_LINE_H_
#define STARFOCUS_TESTS_SUPPORT_ERROR_LINE_H_

#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "platform/result.h"

namespace starfocus {

inline bool operator==(const Error& error, const std::string& line) { return error.line() == line; }
inline bool operator!=(const Error& error, const std::string& line) { return error.line() != line; }

inline bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
inline size_t Count(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}
inline bool Contains(const Error& error, const std::string& part) {
  return Contains(error.line(), part);
}

template <class T>
bool operator==(const Result<T>& result, const std::string& line) {
  return result.error() == line;
}
template <class T>
bool operator!=(const Result<T>& result, const std::string& line) {
  return result.error() != line;
}
template <class T>
bool Contains(const Result<T>& result, const std::string& part) {
  return Contains(result.error(), part);
}

// Returns the value that `result` holds. If the result is an error, throws a std::runtime_error.
template <class T>
T ValueOf(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().line());
  return std::move(*result);
}

// doctest prints errors and results with these operators.
inline std::ostream& operator<<(std::ostream& out, const Error& error) {
  return out << error.line();
}
template <class T>
std::ostream& operator<<(std::ostream& out, const Result<T>& result) {
  return out << result.error();
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_SUPPORT_ERROR_LINE_H_
