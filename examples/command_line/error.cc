// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/error.h"

#include "platform/file.h"

namespace starfocus {

Error Error::Usage(const std::string& option, const std::string& expected,
                   const std::string& found) {
  return Error(Expected(option, expected, found), ExitCode::kUsage);
}

Error Error::Internal(const std::string& where, const std::string& expected,
                      const std::string& found) {
  return Error(Expected(where, expected, found), ExitCode::kInternal);
}

}  // namespace starfocus
