// SPDX-License-Identifier: Apache-2.0
// Reports that TIFF is not supported in builds without libtiff.
#include "platform/decoders/tiff.h"

namespace starfocus {

Result<Samples> DecodeTiff(const std::string& where, bool, const Bytes&) {
  return Unsupported(where, "TIFF", "libtiff (Debian: libtiff-dev)");
}

Result<DecodedPicture> DecodeTiffPicture(const std::string& where, const Bytes&) {
  return Unsupported(where, "TIFF", "libtiff (Debian: libtiff-dev)");
}

}  // namespace starfocus
