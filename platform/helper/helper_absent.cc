// SPDX-License-Identifier: Apache-2.0
// Builds without libseccomp, and for systems other than Linux, decode in the program itself.
#include "platform/helper/helper.h"

namespace starfocus {

void ConfineDecoders() {}

void ConfineProgram() {}

bool DecodersAreConfined() { return false; }

Error RunHelper(const std::string& where, const HelperLimits&, const std::function<void()>&,
                const std::function<void(Channel*)>&) {
  return Error::Internal(where, "a build with helper processes", "none");
}

}  // namespace starfocus
