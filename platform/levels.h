// SPDX-License-Identifier: Apache-2.0
// Decodes the grey levels of depth pictures, and the alpha channel or the grey levels of mattes
// (PNG, PGM, PPM, JPEG and WebP) at full precision, for the readers of depth photos.
#ifndef STARFOCUS_PLATFORM_LEVELS_H_
#define STARFOCUS_PLATFORM_LEVELS_H_

#include <string>

#include "platform/file.h"
#include "platform/pfm.h"
#include "platform/result.h"

namespace starfocus {

struct Samples {
  FloatMap map;           // Sample values, 0 to `largest`; NaN for transparent pixels.
  int largest = 0;        // Sample value of white; 0 for floats, which have no limits.
  bool is_wide = false;   // True if values have more than 16 bits, so that white is unknown.
  bool is_alpha = false;  // True if the values are an alpha channel.
  bool larger_is_nearer = false;  // True if the format defines that larger values are nearer.
};

// Treatment of the alpha channel (or tRNS) of a picture.
enum class Alpha {
  kIgnored,
  kTransparent,  // Depth pictures: samples of pixels that are less than half opaque are NaN.
  kTaken  // Mattes and coverage: the samples are the alpha channel, unless it is opaque everywhere.
};

// Decodes the grey levels or the alpha channel of a picture. Returns an error if grey levels are
// requested from a colour picture. `where` appears only in error messages.
Result<Samples> DecodeSamples(const std::string& where, Alpha alpha, const Bytes& bytes);

// Decodes the grey levels of a depth picture and scales them to the range from 0 (black) to 1
// (white). The levels of transparent pixels are NaN.
Result<FloatMap> DecodeLevels(const std::string& where, const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_LEVELS_H_
