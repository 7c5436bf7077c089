// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/tiff.h"

#include <cstring>

namespace starfocus {

bool IsTiff(const Bytes& bytes) {
  // The byte order, and the number 42 for TIFF or 43 for BigTIFF.
  for (const char* signature : {"II*\0", "MM\0*", "II+\0", "MM\0+"}) {
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), signature, 4) == 0) return true;
  }
  return false;
}

}  // namespace starfocus
