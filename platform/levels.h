// SPDX-License-Identifier: Apache-2.0
// Grey levels of depth pictures: PNG, PGM, PPM and JPEG, with all bits that the file has. The
// readers of depth photos call it. A picture in colours is an error, since colours have no order.
#ifndef STARFOCUS_PLATFORM_LEVELS_H_
#define STARFOCUS_PLATFORM_LEVELS_H_

#include <string>

#include "platform/file.h"
#include "platform/pfm.h"
#include "platform/result.h"

namespace starfocus {

struct Samples {
  FloatMap map;  // samples as the file has them, 0 to `largest`; NaN where alpha says transparent
  int largest = 0;  // the sample of white
};

// Decodes the samples. `where` only names the file in errors; `bytes` may be changed. With
// `use_alpha`, pixels less than half opaque (alpha channel or tRNS) are NaN.
Error DecodeSamples(const std::string& where, bool use_alpha, Bytes* bytes, Samples* samples);

// Decodes coverage as samples of a PNG file's alpha channel, or of another picture's grey levels.
Error DecodeCoverage(const std::string& where, Bytes* bytes, Samples* samples);

// Decodes the levels, 0 to 1; NaN where the picture is transparent.
Error DecodeLevels(const std::string& where, Bytes* bytes, FloatMap* levels);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_LEVELS_H_
