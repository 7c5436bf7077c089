// SPDX-License-Identifier: Apache-2.0
// Deep pictures: the light of pictures with more than 8 bits or with alpha, in memory of the
// library. Converts rows of all formats to and from deep codes.
#ifndef STARFOCUS_LIB_IO_DEEP_H_
#define STARFOCUS_LIB_IO_DEEP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/transfer.h"
#include "lib/io/image.h"

namespace starfocus {

// A deep code is light in 16 bits. Up to white, kLightWhite, the code is the light. A code beyond
// white is white plus the excess, whose unit is 2^kExcessBits levels of light. Colours are
// premultiplied with alpha. Alpha is stored as light: kLightWhite is opaque.
inline constexpr int kExcessBits = 6;
inline constexpr int32_t kMostExcess = (kLightWhite << 6 >> kExcessBits) - (kLightWhite >> 6);

// Returns the light of a deep code, at most 64 times white.
constexpr int32_t LightOfDeep(int32_t code) {
  return code <= kLightWhite ? code : kLightWhite + ((code - kLightWhite) << kExcessBits);
}

// Returns the deep code of light >= 0, rounded to the nearest. More than 64 times white is limited.
constexpr uint16_t DeepOfLight(int64_t light) {
  if (light <= kLightWhite) return static_cast<uint16_t>(light);
  const int64_t excess = (light - kLightWhite + (1 << kExcessBits >> 1)) >> kExcessBits;
  return static_cast<uint16_t>(kLightWhite + (excess < kMostExcess ? excess : kMostExcess));
}

// Returns true if a channel of a deep pixel is beyond white.
inline bool IsBeyondWhite(const uint16_t* rgb) {
  return Max(Max(rgb[0], rgb[1]), rgb[2]) > kLightWhite;
}

// Conversions of one sample, for an engine of one transfer function.
struct DeepTables {
  uint16_t decode[65536];       // Deep codes of 16-bit codes.
  uint16_t decode_bytes[256];   // Deep codes of 8-bit codes.
  uint16_t encode[65536];       // 16-bit codes of deep codes.
  uint16_t decode_half[65536];  // Deep codes of half floats; 0 for negative light and NaN.
  uint16_t encode_half[65536];  // Half floats of deep codes.
};

void FillDeepTables(int32_t transfer, DeepTables* tables);

// Returns true if pictures of a format may have light beyond white.
bool MayExceedWhite(const DeepTables& tables, int32_t format);

// Returns true if `count` pixels of an image, starting at (x, y), are known to be opaque and at
// most white.
bool IsPlain(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
             int32_t count);

// Reads `count` pixels of an image of any format, starting at (x, y). Sets alpha[n] to the alpha of
// pixel n, unless `alpha` is null. Negative half floats count as 0.
void ReadDeep(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
              int32_t count, uint16_t* rgb, uint16_t* alpha);

// A row of deep pixels; the alpha is opaque if `alpha` is null.
struct DeepRow {
  const uint16_t *rgb, *alpha;
};

// Writes the first `width` pixels of row y of an image of a deep RGB format.
void WriteDeep(const DeepTables& tables, const DeepRow& row, int32_t width, int32_t y,
               const ImageTarget& image);

// Writes to an image of a deep YUV format. rows[0] and rows[1] are rows y and y + 1 of the picture,
// of which the rows in `luma` get luma. Row y of an image gets the chroma of the mean of both rows;
// rows[1] is rows[0] if each row has its own chroma, and null if no chroma is written.
void WriteDeepYuv(const DeepTables& tables, const uint16_t* const rows[2], const Range& luma,
                  int32_t width, int32_t y, const ImageTarget& image);

// Converts `count` pixels of row y of the picture to 8-bit codes, from a column on that is a
// multiple of simd::kDitherColumns. Codes are dithered where the row is smooth, and rounded
// elsewhere. If `straight` is true, colours are divided by alpha.
void DitherRow(const DeepTables& tables, const DeepRow& row, int32_t y, int32_t count,
               bool straight, uint8_t* rgb);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_DEEP_H_
