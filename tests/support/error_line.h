// SPDX-License-Identifier: Apache-2.0
// Comparing an error with its line, "" where there is none, as tests do.
#ifndef STARFOCUS_TESTS_SUPPORT_ERROR_LINE_H_
#define STARFOCUS_TESTS_SUPPORT_ERROR_LINE_H_

#include <ostream>
#include <string>

#include "platform/result.h"

namespace starfocus {

inline bool operator==(const Error& error, const std::string& line) { return error.line() == line; }
inline bool operator!=(const Error& error, const std::string& line) { return error.line() != line; }

// What doctest shows.
inline std::ostream& operator<<(std::ostream& out, const Error& error) {
  return out << error.line();
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_SUPPORT_ERROR_LINE_H_
