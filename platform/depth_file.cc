// SPDX-License-Identifier: Apache-2.0
#include "platform/depth_file.h"

#include <algorithm>
#include <cctype>

#include "platform/container.h"
#include "platform/decoders/exr.h"
#include "platform/decoders/npy.h"
#include "platform/decoders/npz.h"
#include "platform/decoders/tiff.h"
#include "platform/decoders/webp.h"
#include "platform/decoders/zip.h"

namespace starfocus {
namespace {

// Returns true if the bytes start with `beginning`.
bool StartsWith(const Bytes& bytes, const std::string& beginning) {
  return bytes.size() >= beginning.size() &&
         std::equal(beginning.begin(), beginning.end(), bytes.begin(),
                    [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

// Returns true if the bytes start with a magic number of two letters and white space or a comment,
// as PFM, PGM and PPM files do. A text may start with the same letters.
bool HasMagic(const Bytes& bytes, const std::string& magic) {
  return StartsWith(bytes, magic) && bytes.size() > 2 &&
         (bytes[2] == '#' || std::isspace(bytes[2]) != 0);
}

bool IsPfm(const Bytes& bytes) { return HasMagic(bytes, "Pf") || HasMagic(bytes, "PF"); }

bool IsPicture(const Bytes& bytes) {
  return IsPng(bytes) || StartsWith(bytes, "\xff\xd8") || IsWebp(bytes) || HasMagic(bytes, "P5") ||
         HasMagic(bytes, "P6");
}

}  // namespace

Result<Samples> DecodeDepthFile(const std::string& where, Alpha alpha, const Bytes& bytes) {
  if (IsPfm(bytes)) {
    Samples samples;
    samples.larger_is_nearer = true;
    if (Error error = DecodePfm(where, bytes).MoveTo(&samples.map)) return error;
    return samples;
  }
  const bool is_matte = alpha == Alpha::kTaken;
  if (IsNpy(bytes)) return DecodeNpy(where, is_matte, bytes);
  if (IsZip(bytes)) return DecodeNpz(where, is_matte, bytes);
  if (IsTiff(bytes)) return DecodeTiff(where, is_matte, bytes);
  if (IsExr(bytes)) return DecodeExrSamples(where, is_matte, bytes);
  if (IsPicture(bytes)) return DecodeSamples(where, alpha, bytes);
  return Expected(
      where,
      std::string(is_matte ? "a matte" : "a depth picture") +
          " (PFM, TIFF, OpenEXR, NPY, NPZ, PNG, PGM, PPM, JPEG or WebP)",
      DescribeFile(bytes) + (is_matte ? " (convert the matte to PNG)"
                                      : " (convert the map to PFM or NPY, or to PNG of 16 bits)"));
}

}  // namespace starfocus
