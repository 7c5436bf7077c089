// SPDX-License-Identifier: Apache-2.0
#include "lib/io/depth_map.h"

#include <cstring>
#include <limits>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

size_t DepthBytes(int32_t type) {
  return type == STARFOCUS_DEPTH_FLOAT ? sizeof(float)
         : type == STARFOCUS_DEPTH_U8  ? 1
                                       : sizeof(uint16_t);
}

const void* ValueAt(const starfocus_depth_map& map, int32_t x, int32_t y) {
  return static_cast<const uint8_t*>(map.data) + static_cast<size_t>(y) * map.stride +
         static_cast<size_t>(x) * DepthBytes(map.type);
}

simd::DepthRule RuleOf(const starfocus_depth_map& map, float low, float high) {
  const float invalid = map.has_invalid != 0 ? static_cast<float>(map.invalid) : kUnknown;
  return {static_cast<float>(map.scale),
          static_cast<float>(map.offset),
          invalid,
          map.meaning == STARFOCUS_DEPTH_RECIPROCAL,
          low,
          high};
}

void ReadDisparities(const starfocus_depth_map& map, int32_t x, int32_t y, int32_t count,
                     float* out) {
  const void* const values = ValueAt(map, x, y);
  const auto n = static_cast<size_t>(count);
  if (map.type == STARFOCUS_DEPTH_FLOAT) {
    std::memcpy(out, values, n * sizeof(float));
  } else if (map.type == STARFOCUS_DEPTH_U8) {
    simd::reference::BytesToDepth(static_cast<const uint8_t*>(values), n, out);
  } else if (map.type == STARFOCUS_DEPTH_U16) {
    simd::reference::WordsToDepth(static_cast<const uint16_t*>(values), n, out);
  } else if (map.type == STARFOCUS_DEPTH_DEPTH16) {
    simd::reference::Depth16ToDepth(static_cast<const uint16_t*>(values), n, out);
  } else {
    simd::reference::HalvesToDepth(static_cast<const uint16_t*>(values), n, out);
  }
  const simd::DepthRule rule = RuleOf(map, 0, 0);
  for (size_t k = 0; k < n; ++k) out[k] = simd::reference::DisparityOf(out[k], rule);
}

namespace {

static_assert(simd::kBlendStep == kSurfaceStep,
              "kernels and library use the same largest step within a surface");

// Largest number of map values that are converted at once. No map is larger than the picture, so
// interpolating kDepthPiece pixels reads at most kDepthPiece + 1 values.
constexpr int32_t kPiece = kDepthPiece + 1;

// Converts `count` <= kPiece values of row y of the map, starting at column x. Returns
// the flags (simd::kUnknownDepth).
uint32_t ConvertValues(const simd::ImageKernels& kernels, const DepthSource& depth, int32_t x,
                       int32_t y, int32_t count, int16_t* out) {
  const auto values = static_cast<size_t>(count);
  const void* const row = ValueAt(depth.map, x, y - depth.first);
  const int32_t type = depth.map.type;
  if (type == STARFOCUS_DEPTH_FLOAT) {
    return kernels.DepthToDisparity(static_cast<const float*>(row), values, depth.rule, out);
  }
  float z[kPiece];
  if (type == STARFOCUS_DEPTH_U8) {
    kernels.BytesToDepth(static_cast<const uint8_t*>(row), values, z);
  } else if (type == STARFOCUS_DEPTH_U16) {
    kernels.WordsToDepth(static_cast<const uint16_t*>(row), values, z);
  } else if (type == STARFOCUS_DEPTH_DEPTH16) {
    kernels.Depth16ToDepth(static_cast<const uint16_t*>(row), values, z);
  } else {
    kernels.HalvesToDepth(static_cast<const uint16_t*>(row), values, z);
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

// Returns the position of row y of the picture in the map: kColumnOne times the index of the map
// row above, plus the share of the map row below.
uint32_t PlaceOfRow(const DepthSource& depth, int32_t y) {
  return PlaceOf(y, depth.height, depth.map.height);
}

// Interpolates `count` <= kDepthPiece columns of the rows of a picture, starting at column x. Keeps
// the last two converted rows of the map, which neighbouring rows of the picture share.
uint32_t ReadPiece(const simd::ImageKernels& kernels, const DepthSource& depth, int32_t x,
                   int32_t count, const Range& rows, const Plane<int16_t>& out) {
  const uint32_t* const columns = depth.columns + (x - depth.first_column);
  const auto left = static_cast<int32_t>(columns[0] >> simd::kColumnBits);
  const auto last = static_cast<int32_t>(columns[count - 1] >> simd::kColumnBits);
  const int32_t values = Min(last + 2, depth.map.width) - left;
  // Room for the values, a copy of the last value, and what UpsampleRow may read.
  constexpr int32_t kRoom = kPiece + 1 + simd::kUpsampleSpare;
  int16_t converted[2][kRoom], blended[kRoom];
  int32_t held[2] = {-1, -1};
  uint32_t flags = 0;
  // Returns the converted values of a row of the map, followed by a copy of the last value. The
  // result is valid until another row with the same parity is read.
  const auto row_at = [&](int32_t y) {
    int16_t* const row = converted[y % 2];
    if (held[y % 2] != y) {
      held[y % 2] = y;
      flags |= ConvertValues(kernels, depth, left, y, values, row);
      row[values] = row[values - 1];
    }
    return row;
  };
  for (int32_t y = rows.first; y < rows.last; ++y) {
    const uint32_t place = PlaceOfRow(depth, y), share = place % simd::kColumnOne;
    const auto upper = static_cast<int32_t>(place >> simd::kColumnBits);
    const int16_t* row = row_at(upper);
    if (share != 0) {
      // The copy of the last value is blended, too.
      kernels.BlendRows(row, row_at(upper + 1), static_cast<size_t>(values) + 1, share, blended);
      row = blended;
    }
    kernels.UpsampleRow(row, columns, static_cast<size_t>(count), static_cast<uint32_t>(left),
                        out.Row(y));
  }
  return flags;
}

bool HasPictureSize(const DepthSource& depth) {
  return depth.map.width == depth.width && depth.map.height == depth.height;
}

}  // namespace

void FillColumns(int32_t width, int32_t map_width, int32_t first_column, int32_t count,
                 uint32_t* columns) {
  for (int32_t k = 0; k < count; ++k) columns[k] = PlaceOf(first_column + k, width, map_width);
}

uint32_t ReadDepth(const simd::ImageKernels& kernels, const DepthSource& depth, const Rect& rect,
                   const Plane<int16_t>& out) {
  const Range rows = {rect.y, rect.y + rect.height};
  uint32_t flags = 0;
  for (int32_t x = 0; x < rect.width; x += kDepthPiece) {
    const int32_t count = Min(kDepthPiece, rect.width - x);
    Plane<int16_t> piece = out;
    piece.data += x;
    if (!HasPictureSize(depth)) {
      flags |= ReadPiece(kernels, depth, rect.x + x, count, rows, piece);
      continue;
    }
    for (int32_t y = rows.first; y < rows.last; ++y) {
      flags |= ConvertValues(kernels, depth, rect.x + x, y, count, piece.Row(y));
    }
  }
  return flags;
}

uint32_t CheckDepth(const simd::ImageKernels& kernels, const DepthSource& depth,
                    const Range& rows) {
  // A row that lies between two map rows depends on both of them.
  const uint32_t first = PlaceOfRow(depth, rows.first), last = PlaceOfRow(depth, rows.last - 1);
  const auto end = static_cast<int32_t>((last + simd::kColumnOne - 1) / simd::kColumnOne) + 1;
  uint32_t flags = 0;
  for (auto y = static_cast<int32_t>(first / simd::kColumnOne); y < end; ++y) {
    for (int32_t x = 0; x < depth.map.width; x += kPiece) {
      int16_t unused[kPiece];
      flags |= ConvertValues(kernels, depth, x, y, Min(kPiece, depth.map.width - x), unused);
    }
  }
  return flags;
}

}  // namespace starfocus
