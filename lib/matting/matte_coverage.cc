// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "lib/io/matte_rows.h"
#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

static_assert(kMatteRadius == kGivenRadius + kRampRadius, "the search reads kMatteRadius pixels");

// Disparities are first read in blocks, because most blocks contain no edge.
constexpr int32_t kBlock = 4 * kCoverageTile;
constexpr int32_t kBlockSide = kBlock + 2 * kMatteRadius;

// Places around a pixel at which the matte and the map are compared: rings of eight places.
constexpr int8_t kPlaces[][2] = {
    {0, 0},    {3, 0},     {2, 2},     {0, 3},    {-2, 2},  {-3, 0},  {-2, -2},
    {0, -3},   {2, -2},    {7, 3},     {3, 7},    {-3, 7},  {-7, 3},  {-7, -3},
    {-3, -7},  {3, -7},    {7, -3},    {16, 0},   {11, 11}, {0, 16},  {-11, 11},
    {-16, 0},  {-11, -11}, {0, -16},   {11, -11}, {24, 10}, {10, 24}, {-10, 24},
    {-24, 10}, {-24, -10}, {-10, -24}, {10, -24}, {24, -10}};

constexpr int32_t kMostPlaces = sizeof(kPlaces) / sizeof(kPlaces[0]);

// Difference of alpha between the surfaces of an outline of the subject. With kDoubted or less, the
// map decides; with kTrusted or more, the matte (docs/constants.md).
constexpr int32_t kDoubted = 64, kTrusted = 128;

// Inserts a value into `count` values in ascending order.
void Insert(uint8_t value, uint8_t* values, int32_t* count) {
  int32_t k = (*count)++;
  for (; k > 0 && values[k - 1] > value; --k) values[k] = values[k - 1];
  values[k] = value;
}

// Coverage of the pixels of a tile.
class TileCoverage {
 public:
  TileCoverage(const starfocus_matte& matte, const DepthSource& depth, const Rect& tile,
               const GivenDisparities& around)
      : matte_(matte), around_(around), search_(around) {
    const auto step = static_cast<size_t>(Max(1, matte.pixel_stride));
    for (int32_t k = 0; k < kSide; ++k) {
      columns_[k] = step * SampleOf(tile.x + k - kMatteRadius, depth.width, matte.width);
      rows_[k] = matte.stride * SampleOf(tile.y + k - kMatteRadius, depth.height, matte.height);
    }
  }

  // Returns the coverage of pixel (x, y) of the tile, whose alpha is `alpha`.
  int32_t At(int32_t x, int32_t y, int32_t alpha) const {
    const int32_t at = GivenDisparities::At(x, y);
    Surfaces surfaces;
    if (!search_.FindSurfaces(at, &surfaces)) return 255;
    const int32_t implied = surfaces.IsNear(around_.disparity[at]) ? 255 : 0;
    if (alpha == implied) return implied;
    // The alpha of both surfaces around the pixel. Places of objects in front of the near surface
    // are left out.
    uint8_t near[kMostPlaces], far[kMostPlaces];
    int32_t nears = 0, fars = 0;
    const int32_t highest = surfaces.high + (surfaces.high - surfaces.low) / 2;
    for (const auto& offset : kPlaces) {
      const int32_t there = at + offset[1] * kSide + offset[0];
      const int32_t disparity = around_.disparity[there];
      if (disparity > highest) continue;
      const uint8_t value = matte_.data[rows_[there / kSide] + columns_[there % kSide]];
      const bool is_near = surfaces.IsNear(disparity);
      Insert(value, is_near ? near : far, is_near ? &nears : &fars);
    }
    if (nears == 0 || fars == 0) return implied;
    // Quantiles ignore places on the wrong side of outlines that the map displaces. Most places on
    // a map's closed outline of hair lie between strands, so the near surface needs a high
    // quantile.
    const int32_t most = near[(nears - 1) * 9 / 10], least = far[(fars - 1) / 4];
    const int32_t trust = Clamp(most - least - kDoubted, 0, kTrusted - kDoubted);
    if (trust == 0) return implied;
    // Where a false part of the matte surrounds the outline, `least` is the alpha of this part.
    const int32_t matte = Clamp((alpha - least) * 255 / (most - least), 0, 255);
    return implied + (matte - implied) * trust / (kTrusted - kDoubted);
  }

 private:
  static constexpr int32_t kSide = GivenDisparities::kSide;

  // Returns the sample of the matte at the middle of a pixel, along one axis.
  static size_t SampleOf(int32_t pixel, int32_t pixels, int32_t samples) {
    return static_cast<size_t>((2 * int64_t{Clamp(pixel, 0, pixels - 1)} + 1) * samples /
                               (2 * pixels));
  }

  const starfocus_matte& matte_;
  const GivenDisparities& around_;
  const SurfaceSearch search_;
  size_t columns_[kSide], rows_[kSide];
};

// Widens the range from *least to *greatest by disparities. Pixels may have two surfaces only if
// the range is larger than kThinStep.
void Widen(const int16_t* disparities, int32_t count, int16_t* least, int16_t* greatest) {
  for (int32_t k = 0; k < count; ++k) {
    if (disparities[k] < *least) *least = disparities[k];
    if (disparities[k] > *greatest) *greatest = disparities[k];
  }
}

// Reads disparities of a rectangle that is at most kBlockSide pixels wide.
void Read(const simd::ImageKernels& kernels, const DepthSource& depth, const Rect& rect,
          const Plane<int16_t>& out) {
  uint32_t columns[kBlockSide];
  FillColumns(depth.width, depth.map.width, rect.x, rect.width, columns);
  DepthSource part = depth;
  part.columns = columns;
  part.first_column = rect.x;
  ReadDepth(kernels, part, rect, out);
}

// Returns true if the map has an edge in the block or within kMatteRadius pixels of the block.
bool HasEdge(const simd::ImageKernels& kernels, const DepthSource& depth, const Rect& block) {
  constexpr int32_t kRows = 8;
  const Rect all =
      Clipped(Extended(block, {kMatteRadius, kMatteRadius, kMatteRadius, kMatteRadius}),
              depth.width, depth.height);
  int16_t least = INT16_MAX, greatest = INT16_MIN;
  for (int32_t y = 0; y < all.height && greatest - least <= kThinStep; y += kRows) {
    int16_t disparities[kRows * kBlockSide];
    const Rect rect = {all.x, all.y + y, all.width, Min(kRows, all.height - y)};
    Read(kernels, depth, rect, {disparities, static_cast<size_t>(all.width), 0, rect.y});
    Widen(disparities, rect.width * rect.height, &least, &greatest);
  }
  return greatest - least > kThinStep;
}

// Reads the disparities around a tile. Beyond the picture, the outermost pixels are repeated.
// Returns true if they have an edge.
bool ReadAround(const simd::ImageKernels& kernels, const DepthSource& depth, const Rect& tile,
                GivenDisparities* around) {
  constexpr int32_t kSide = GivenDisparities::kSide;
  const int32_t left = tile.x - kMatteRadius, top = tile.y - kMatteRadius;
  const Rect rect = Clipped({left, top, kSide, kSide}, depth.width, depth.height);
  const int32_t x = rect.x - left, y = rect.y - top;
  int16_t* const disparity = around->disparity;
  Read(kernels, depth, rect, {disparity + y * kSide + x, kSide, 0, rect.y});
  for (int32_t row = y; row < y + rect.height; ++row) {
    int16_t* const to = disparity + row * kSide;
    for (int32_t k = 0; k < x; ++k) to[k] = to[x];
    for (int32_t k = x + rect.width; k < kSide; ++k) to[k] = to[x + rect.width - 1];
  }
  for (int32_t row = 0; row < kSide; ++row) {
    const int32_t from = Clamp(row, y, y + rect.height - 1);
    if (row == from) continue;
    std::memcpy(disparity + row * kSide, disparity + from * kSide, kSide * sizeof(*disparity));
  }
  int16_t least = INT16_MAX, greatest = INT16_MIN;
  Widen(disparity, kSide * kSide, &least, &greatest);
  return greatest - least > kThinStep;
}

// Writes the coverage of a block. `rows` reads the matte at the columns of the block.
void WriteBlock(const simd::ImageKernels& kernels, const starfocus_matte& matte,
                const DepthSource& depth, const Rect& block, MatteRows* rows,
                const Plane<uint8_t>& out) {
  const bool has_edge = HasEdge(kernels, depth, block);
  const int32_t bottom = block.y + block.height;
  for (int32_t top = block.y; top < bottom; top += kCoverageTile) {
    const int32_t height = Min(kCoverageTile, bottom - top);
    uint8_t alpha[kCoverageTile][kBlock];
    for (int32_t y = 0; y < height; ++y) {
      if (has_edge) rows->Read(top + y, alpha[y]);
      std::memset(out.Row(top + y), 255, static_cast<size_t>(block.width));
    }
    for (int32_t x = 0; has_edge && x < block.width; x += kCoverageTile) {
      const Rect tile = {block.x + x, top, Min(kCoverageTile, block.width - x), height};
      GivenDisparities around;
      if (!ReadAround(kernels, depth, tile, &around)) continue;
      const TileCoverage coverage(matte, depth, tile, around);
      ForPixels({0, 0, tile.width, height}, [&](int32_t k, int32_t y) {
        out.Row(top + y)[x + k] = static_cast<uint8_t>(coverage.At(k, y, alpha[y][x + k]));
      });
    }
  }
}

}  // namespace

void MatteCoverage(const simd::ImageKernels& kernels, const starfocus_matte& matte,
                   const DepthSource& depth, const Rect& area, const Plane<uint8_t>& out) {
  for (int32_t x = 0; x < area.width; x += kBlock) {
    const int32_t width = Min(kBlock, area.width - x), left = area.x + x;
    MatteRows rows(matte, depth.width, depth.height, left, width);
    for (int32_t y = 0; y < area.height; y += kBlock) {
      const int32_t top = area.y + y;
      WriteBlock(kernels, matte, depth, {left, top, width, Min(kBlock, area.height - y)}, &rows,
                 {out.Row(top) + x, out.stride, 0, top});
    }
  }
}

}  // namespace starfocus
