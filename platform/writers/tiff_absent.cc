// SPDX-License-Identifier: Apache-2.0
// Reports that TIFF is not supported in builds without libtiff.
#include "platform/writers/tiff.h"

namespace starfocus {

Error CheckTiffEncoder(const std::string& path) {
  return Unsupported(path, "TIFF", "libtiff (Debian: libtiff-dev)");
}

Result<Bytes> EncodeTiff(const std::string& path, const DeepImage&, const Metadata&) {
  return CheckTiffEncoder(path);
}

}  // namespace starfocus
