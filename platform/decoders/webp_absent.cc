// SPDX-License-Identifier: Apache-2.0
// Reports that WebP is not supported in builds without libwebp.
#include "platform/decoders/webp.h"

namespace starfocus {

Result<DecodedPicture> DecodeWebp(const std::string& where, const Bytes&) {
  return Unsupported(where, "WebP", "libwebp (Debian: libwebp-dev)");
}

}  // namespace starfocus
