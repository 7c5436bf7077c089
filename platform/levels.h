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

// Decodes the samples. `where` only names the file in errors. With `use_alpha`, pixels less than
// half opaque (alpha channel or tRNS) are NaN.
Result<Samples> DecodeSamples(const std::string& where, bool use_alpha, const Bytes& bytes);

// Decodes coverage as samples of a PNG file's alpha channel, or of another picture's grey levels.
Result<Samples> DecodeCoverage(const std::string& where, const Bytes& bytes);

// Decodes the levels, 0 to 1; NaN where the picture is transparent.
Result<FloatMap> DecodeLevels(const std::string& where, const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_LEVELS_H_
