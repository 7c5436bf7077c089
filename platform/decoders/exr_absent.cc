// SPDX-License-Identifier: Apache-2.0
// Reports that OpenEXR is not supported in builds without OpenEXR.
#include "platform/decoders/exr.h"

namespace starfocus {
namespace {

Error WithoutOpenExr(const std::string& where) {
  return Unsupported(where, "OpenEXR", "OpenEXR (Debian: libopenexr-dev)");
}

}  // namespace

Result<DecodedPicture> DecodeExr(const std::string& where, const Bytes&) {
  return WithoutOpenExr(where);
}

Result<Samples> DecodeExrSamples(const std::string& where, bool, const Bytes&) {
  return WithoutOpenExr(where);
}

bool HasExrDistances(const Bytes&) { return false; }

}  // namespace starfocus
