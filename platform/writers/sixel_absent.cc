// SPDX-License-Identifier: Apache-2.0
// Reports that sixels are not supported in builds without libsixel.
#include "platform/writers/sixel.h"

namespace starfocus {

Result<std::string> EncodeSixel(const std::string& where, const Image&) {
  return Unsupported(where, "sixel", "libsixel (Debian: libsixel-dev)");
}

}  // namespace starfocus
