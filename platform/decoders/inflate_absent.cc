// SPDX-License-Identifier: Apache-2.0
// Reports that compressed files of ZIP archives are not supported in builds without libdeflate.
#include "platform/decoders/zip.h"

namespace starfocus {

Error Inflate(const std::string& where, const uint8_t*, size_t, Bytes*) {
  return Unsupported(where, "compressed NPZ", "libdeflate (Debian: libdeflate-dev)");
}

}  // namespace starfocus
