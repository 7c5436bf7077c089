// SPDX-License-Identifier: Apache-2.0
#include "platform/depth_file.h"

#include <algorithm>

#include "platform/container.h"
#include "platform/decoders/npy.h"
#include "platform/decoders/tiff.h"
#include "platform/decoders/webp.h"

namespace starfocus {
namespace {

bool IsPfm(const Bytes& bytes) {
  return bytes.size() >= 2 && bytes[0] == 'P' && (bytes[1] == 'f' || bytes[1] == 'F');
}

}  // namespace

Result<Samples> DecodeDepthFile(const std::string& where, bool use_alpha, const Bytes& bytes) {
  if (IsPfm(bytes)) {
    Samples samples;
    samples.larger_is_nearer = true;
    if (Error error = DecodePfm(where, bytes).MoveTo(&samples.map)) return error;
    return samples;
  }
  if (IsNpy(bytes)) return DecodeNpy(where, bytes);
  if (IsTiff(bytes)) return DecodeTiff(where, bytes);
  if (MayBePicture(bytes)) return DecodeSamples(where, use_alpha, bytes);
  return Expected(where, "a depth picture (PFM, NPY, TIFF, PNG, PGM, PPM, JPEG or WebP)",
                  DescribeFile(bytes) + " (convert the map to PFM or NPY, or to PNG of 16 bits)");
}

}  // namespace starfocus
