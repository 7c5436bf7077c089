// SPDX-License-Identifier: Apache-2.0
// Decodes the grey levels of depth pictures (PNG, PGM, PPM, JPEG and WebP) at full precision, for
// the readers of depth photos. Rejects colour pictures, because colours do not define an order of
// depth.
#ifndef STARFOCUS_PLATFORM_LEVELS_H_
#define STARFOCUS_PLATFORM_LEVELS_H_

#include <string>

#include "platform/file.h"
#include "platform/pfm.h"
#include "platform/result.h"

namespace starfocus {

struct Samples {
  FloatMap map;                   // Sample values, 0 to `largest`; NaN for transparent pixels.
  int largest = 0;                // Sample value of white; 0 for floats, which have no limits.
  bool larger_is_nearer = false;  // True if the format defines that larger values are nearer.
};

// Decodes the samples of a depth picture. `where` appears only in error messages. If `use_alpha` is
// true, the samples of pixels that are less than half opaque (alpha channel or tRNS) are NaN.
Result<Samples> DecodeSamples(const std::string& where, bool use_alpha, const Bytes& bytes);

// Decodes coverage, which is the alpha channel of a PNG file, or the grey levels of a picture
// without alpha channel.
Result<Samples> DecodeCoverage(const std::string& where, const Bytes& bytes);

// Decodes the grey levels of a depth picture and scales them to the range from 0 (black) to 1
// (white). The levels of transparent pixels are NaN.
Result<FloatMap> DecodeLevels(const std::string& where, const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_LEVELS_H_
