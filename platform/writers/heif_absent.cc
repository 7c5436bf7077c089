// SPDX-License-Identifier: Apache-2.0
// Reports that AVIF and HEIC are not supported in builds without libheif.
#include "platform/writers/heif.h"

namespace starfocus {

Error CheckHeifEncoder(const std::string& path, bool is_avif) {
  return Unsupported(path, is_avif ? "AVIF" : "HEIC", "libheif (Debian: libheif-dev)");
}

Result<Bytes> EncodeHeif(const std::string& path, const DeepImage&, const Metadata&, int,
                         bool is_avif) {
  return CheckHeifEncoder(path, is_avif);
}

}  // namespace starfocus
