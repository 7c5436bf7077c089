// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/webp.h"

#include <algorithm>

namespace starfocus {

bool IsWebp(const Bytes& bytes) {
  constexpr char kRiff[] = "RIFF", kWebp[] = "WEBP";
  return bytes.size() >= 12 && std::equal(kRiff, kRiff + 4, bytes.begin()) &&
         std::equal(kWebp, kWebp + 4, bytes.begin() + 8);
}

}  // namespace starfocus
