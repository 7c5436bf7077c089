// SPDX-License-Identifier: Apache-2.0
#include "platform/result.h"

#include "platform/text.h"

namespace starfocus {
namespace {

std::string Line(const std::string& where, const std::string& expected, const std::string& found) {
  return where + ": expected " + expected + ", found " + found;
}

}  // namespace

Error::Error(ErrorKind kind, std::string line) : kind_(kind), line_(Printable(std::move(line))) {}

Error Error::Usage(const std::string& option, const std::string& expected,
                   const std::string& found) {
  return {ErrorKind::kUsage, Line(option, expected, found)};
}

Error Error::Internal(const std::string& where, const std::string& expected,
                      const std::string& found) {
  return {ErrorKind::kInternal, Line(where, expected, found)};
}

Error Expected(const std::string& where, const std::string& expected, const std::string& found) {
  return {ErrorKind::kInput, Line(where, expected, found)};
}

Error Cannot(const std::string& action, const std::string& path, const std::string& reason) {
  return {ErrorKind::kInput, "cannot " + action + " " + path + ": " + reason};
}

Error Cannot(const std::string& action, const std::string& path, std::error_code reason) {
  std::string text = reason.message();
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') {
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  }
  return Cannot(action, path, text);
}

Error Unsupported(const std::string& where, const std::string& format, const std::string& library) {
  return {ErrorKind::kInput,
          where + ": " + format + " is not supported: this program was built without " + library};
}

Error OutOfMemory(const std::string& where, const std::string& purpose) {
  return {ErrorKind::kInput, where + ": out of memory, cannot " + purpose};
}

}  // namespace starfocus
