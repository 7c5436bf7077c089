// SPDX-License-Identifier: Apache-2.0
// Reports that OpenEXR is not supported in builds without OpenEXR.
#include "platform/writers/exr.h"

namespace starfocus {

Error CheckExrEncoder(const std::string& path) {
  return Unsupported(path, "OpenEXR", "OpenEXR (Debian: libopenexr-dev)");
}

Result<Bytes> EncodeExr(const std::string& path, const DeepImage&, const ColourDescription&) {
  return CheckExrEncoder(path);
}

}  // namespace starfocus
