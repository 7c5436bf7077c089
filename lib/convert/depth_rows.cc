// SPDX-License-Identifier: Apache-2.0
#include "lib/convert/depth_rows.h"

#include <limits>

#include "lib/base/features.h"
#include "lib/base/fixed.h"

namespace starfocus {
namespace {

static_assert(simd::kBlendStep == kSurfaceStep,
              "kernels and library use the same largest step within a surface");

// Largest numbers of map values and of pixels that are converted at once, in arrays on the stack.
// No map is larger than the picture, so interpolating n pixels reads at most n + 1 values.
constexpr int32_t kPiece = 256, kPixels = kPiece - 1;

// Converts `count` <= kPiece values of row y of the map, starting at column x. Returns
// simd::DepthFlags.
uint32_t ConvertValues(const simd::ImageKernels& kernels, const DepthSource& depth, int32_t x,
                       int32_t y, int32_t count, int16_t* out) {
  const starfocus_depth_map& map = depth.map;
  const auto values = static_cast<size_t>(count);
  const uint8_t* row = static_cast<const uint8_t*>(map.data) +
                       static_cast<size_t>(y - depth.first) * map.stride +
                       static_cast<size_t>(x) * DepthBytes(map.type);
  if (map.type == STARFOCUS_DEPTH_FLOAT) {
    return kernels.DepthToDisparity(reinterpret_cast<const float*>(row), values, depth.rule, out);
  }
  float z[kPiece];
  if (map.type == STARFOCUS_DEPTH_U8) {
    kernels.BytesToDepth(row, values, z);
  } else if (map.type == STARFOCUS_DEPTH_U16) {
    kernels.WordsToDepth(reinterpret_cast<const uint16_t*>(row), values, z);
  } else {
    kernels.HalvesToDepth(reinterpret_cast<const uint16_t*>(row), values, z);
  }
  return kernels.DepthToDisparity(z, values, depth.rule, out);
}

// Converts the middle of pixel k, in a line of `size` pixels, to a position in a line of `small`
// map values. Position 0 is the middle of the first value.
uint32_t PlaceOf(int64_t k, int64_t size, int64_t small) {
  constexpr int64_t kOne = simd::kColumnOne, kHalf = kOne / 2;
  const int64_t place = kHalf * (2 * k + 1) * small / size - kHalf, last = kOne * (small - 1);
  return static_cast<uint32_t>(place < 0 ? 0 : place > last ? last : place);
}

// Writes `count` <= kPixels pixels of a row, starting at column x. `place` is the vertical position
// of the row in the map.
uint32_t ReadPiece(const simd::ImageKernels& kernels, const DepthSource& depth, uint32_t place,
                   int32_t x, int32_t count, int16_t* out) {
  const uint32_t* columns = depth.columns + x;
  const uint32_t first = columns[0] >> simd::kColumnBits;
  const uint32_t last = columns[count - 1] >> simd::kColumnBits;
  const auto left = static_cast<int32_t>(first),
             upper = static_cast<int32_t>(place >> simd::kColumnBits);
  const int32_t values = Min(static_cast<int32_t>(last) + 2, depth.map.width) - left;
  const uint32_t share = place % simd::kColumnOne;
  int16_t rows[2][kPiece], row[kPiece + 1];
  uint32_t flags = ConvertValues(kernels, depth, left, upper, values, rows[0]);
  if (share != 0) flags |= ConvertValues(kernels, depth, left, upper + 1, values, rows[1]);
  kernels.BlendRows(rows[0], rows[share != 0 ? 1 : 0], static_cast<size_t>(values), share, row);
  row[values] = row[values - 1];
  int32_t pairs[kPiece];
  for (int32_t k = 0; k < values; ++k) {
    pairs[k] = static_cast<int32_t>(uint32_t{static_cast<uint16_t>(row[k])} |
                                    uint32_t{static_cast<uint16_t>(row[k + 1])} << 16);
  }
  kernels.SpreadRow(pairs, columns, static_cast<size_t>(count), first, out);
  return flags;
}

}  // namespace

void FillColumns(int32_t width, int32_t map_width, uint32_t* columns) {
  for (int32_t x = 0; x < width; ++x) columns[x] = PlaceOf(x, width, map_width);
}

DepthSource MakeDepthSource(const starfocus_config& config, const starfocus_depth_map& map,
                            const uint32_t* columns) {
  const float invalid = map.has_invalid != 0 ? static_cast<float>(map.invalid)
                                             : std::numeric_limits<float>::quiet_NaN();
  const simd::DepthRule rule = {static_cast<float>(map.scale),
                                static_cast<float>(map.offset),
                                invalid,
                                map.meaning == STARFOCUS_DEPTH_RECIPROCAL,
                                RangeOf(config).min,
                                RangeOf(config).max};
  return {map, rule, config.width, config.height, columns};
}

size_t DepthBytes(int32_t type) {
  return type == STARFOCUS_DEPTH_FLOAT ? sizeof(float)
         : type == STARFOCUS_DEPTH_U8  ? 1
                                       : sizeof(uint16_t);
}

uint32_t ReadDepthRow(const simd::ImageKernels& kernels, const DepthSource& depth, int32_t y,
                      int16_t* out) {
  const uint32_t place = PlaceOf(y, depth.height, depth.map.height);
  const bool is_row = depth.map.width == depth.width && place % simd::kColumnOne == 0;
  const int32_t most = is_row ? kPiece : kPixels;
  uint32_t flags = 0;
  for (int32_t x = 0; x < depth.width; x += most) {
    const int32_t count = Min(most, depth.width - x);
    flags |= is_row
                 ? ConvertValues(kernels, depth, x,
                                 static_cast<int32_t>(place >> simd::kColumnBits), count, out + x)
                 : ReadPiece(kernels, depth, place, x, count, out + x);
  }
  return flags;
}

}  // namespace starfocus
