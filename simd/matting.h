// SPDX-License-Identifier: Apache-2.0
// SIMD kernels for pixels that mix two surfaces (lib/matting). FindBeyond, CoverPlaces and SumNear
// process a row of kSliceLanes pixels. SumVotes compares the colours of a row of kSliceLanes pixels
// with the colours of the surrounding pixels, and sums the similarities for nearer and farther
// surfaces. SmoothDisparity averages a noisy disparity map over neighbouring pixels on one surface.
#ifndef STARFOCUS_SIMD_MATTING_H_
#define STARFOCUS_SIMD_MATTING_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "simd/samples.h"

namespace starfocus::simd {

// Largest distance, in columns and rows, of the pixels that FindBeyond compares.
inline constexpr int32_t kBeyondReach = 3;

// Columns, rows and squared distances of these pixels, the nearest first.
struct BeyondOffsets {
  static constexpr int32_t kCount = (2 * kBeyondReach + 1) * (2 * kBeyondReach + 1) - 1;
  int8_t x[kCount] = {}, y[kCount] = {}, square[kCount] = {};

  constexpr BeyondOffsets() {
    int32_t count = 0;
    for (int32_t distance = 1; distance <= 2 * kBeyondReach * kBeyondReach; ++distance) {
      for (int32_t row = -kBeyondReach; row <= kBeyondReach; ++row) {
        for (int32_t column = -kBeyondReach; column <= kBeyondReach; ++column) {
          if (column * column + row * row != distance) continue;
          x[count] = static_cast<int8_t>(column);
          y[count] = static_cast<int8_t>(row);
          square[count++] = static_cast<int8_t>(distance);
        }
      }
    }
  }
};
inline constexpr BeyondOffsets kBeyondOffsets;

// Geometry of a view for CoverPlaces, which finds the nearer pixels that occlude far pixels in the
// view. All disparities must have the same scale; any scale is permitted.
struct CoverView {
  int16_t along;  // movement in the view per unit of disparity, 15 fractional bits
  // Movement in the view that places the near pixel onto the far pixel, in the scale of
  // disparities.
  int16_t place;
  int16_t within;  // Largest deviation from `place` at which the near pixel covers the far pixel.
  int16_t least;   // A near pixel covers far pixels only if it is nearer by more than `least`.
};

// Largest distance, in columns and rows, of the pixels that SumNear adds.
inline constexpr int32_t kNearReach = 2;

// The pixels around a row of kSliceLanes pixels. All pointers point to the first pixel of the row.
// Rows are `stride` samples apart.
struct NearRows {
  const int16_t* light[3];
  const int16_t* disparity;  // disparity of the near surface
  // Weight of the pixel in a mean of the near surface's light, [0, 256].
  const int16_t* weight;
  ptrdiff_t stride;
  int16_t step;  // largest difference between the disparities of one surface
};

// Output of SumNear: sums of light, and sums of weights with 15 fractional bits.
struct NearSums {
  int16_t light[3][kSliceLanes];
  int16_t weight[kSliceLanes];
};

// Filter coefficients of SumNear, by the distance in columns and rows. The coefficients of all
// pixels sum to 118, so that with weights of 256 the total is less than 1 (15 fractional bits).
inline constexpr int16_t kNearTaps[kNearReach + 1][kNearReach + 1] = {
    {10, 8, 4}, {8, 7, 3}, {4, 3, 2}};

// Largest number of samples in a row and in a column around a pixel, for SumVotes.
inline constexpr int32_t kMostVoteSide = 18;
// Largest trust of a sample and largest closeness. Closeness is given in 1/kClosenessUnit, so that
// the rounded product with 15 fractional bits is the weight of the sample.
inline constexpr int32_t kMostTrust = 64, kMostCloseness = 16;
inline constexpr int32_t kClosenessUnit = (1 << 15) / kMostTrust;

// The pixels around a row of kSliceLanes pixels. All pointers, except `closeness`, point to the
// first pixel of the row. Rows are `stride` samples apart.
struct VoteRows {
  const int16_t* colour[3];  // brightness and two differences of colour, [-383, 383]
  const int16_t* surface;    // disparity
  const int16_t* trust;      // [0, kMostTrust]
  const int16_t* middle;     // disparity above which a surface counts as nearer, for each pixel
  ptrdiff_t stride;
  int32_t reach, step;       // every step-th column and row from -reach to reach is a sample
  const int16_t* closeness;  // [0, kMostCloseness * kClosenessUnit], one for each sample, by rows
};

// Sums over the samples that are farther and nearer than the middle.
struct VoteSums {
  uint16_t similar[2][kSliceLanes];  // similarity * weight / 16, sums of rows rounded down
  uint16_t weight[2][kSliceLanes];
};

// Similarity of colours by the sum of the absolute differences of the planes `colour`: large up to
// a few codes (kTight), and small up to kWide.
inline constexpr int32_t kWide = 96, kTight = 24;
inline constexpr int32_t kMostSimilar = (kWide * kWide >> 9) + (kTight * kTight >> 2);
static_assert(kMostSimilar * kMostCloseness * kMostVoteSide <= UINT16_MAX, "sum of a row");
static_assert((kMostSimilar * kMostCloseness * kMostVoteSide >> 4) * kMostVoteSide <= UINT16_MAX,
              "sum of all rows");

// Returns the difference of two colours from the differences of their sums of red, green
// and blue, of red - green, and of green - blue. Hue
// and saturation have four times the weight of brightness, because shading changes the brightness
// of a surface.
inline int32_t ColourDifference(int32_t sum, int32_t red_green, int32_t green_blue) {
  const auto size = [](int32_t value) { return value < 0 ? -value : value; };
  return size(sum) / 4 + size(red_green) + size(green_blue) + size(red_green + green_blue);
}

// Largest number of rows over which a pixel is averaged.
inline constexpr size_t kMostSmoothRows = 7;
// Weight of a neighbour of equal colour. The weight of a neighbour decreases with the difference of
// the colours, down to 1.
inline constexpr int32_t kMostSmoothWeight = 64;

// A row of pixels (`own`) and the rows over which its pixels are averaged. Each pointer points to
// the first pixel of a row. `radius` more pixels at both ends of a row must be readable. A row has
// four planes, which are `plane` elements apart: disparity, and the members sum, red_green and
// green - blue.
struct SmoothRows {
  const int32_t* own;
  const int32_t* rows[kMostSmoothRows];
  size_t count;  // number of rows
  size_t plane;
  int32_t radius, step;  // Neighbours are in every `step`-th column within `radius`.
  int32_t tolerance;     // Largest difference of disparities within a surface.
};

// Returns the mean disparity over the neighbours of a pixel. `disparity` is the sum of the weighted
// disparities, below 2^27, and `weights` is the sum of the weights, below 2^13. Halves are rounded
// away from zero.
inline int16_t SmoothMean(int32_t disparity, int32_t weights) {
  const int32_t half = disparity < 0 ? -weights : weights;
  return static_cast<int16_t>((2 * disparity + half) / (2 * weights));
}

namespace reference {

// For each pixel n < kSliceLanes of a row, finds the nearest pixel within kBeyondReach columns and
// rows whose disparity differs by more than `step`. Among equally distant pixels, the one with the
// largest disparity is found, so that mirrored maps give mirrored results. Writes its disparity and
// its squared distance; without such a pixel, the disparity of pixel n and 0. Rows are `stride`
// samples apart.
STARFOCUS_REFERENCE void FindBeyond(const int16_t* row, ptrdiff_t stride, int16_t step,
                                    int16_t* beyond, int16_t* square) {
  for (ptrdiff_t n = 0; n < static_cast<ptrdiff_t>(kSliceLanes); ++n) {
    beyond[n] = row[n];
    square[n] = 0;
    for (int32_t y = -kBeyondReach; y <= kBeyondReach; ++y) {
      for (int32_t x = -kBeyondReach; x <= kBeyondReach; ++x) {
        const int16_t there = row[n + y * stride + x];
        const int32_t apart = there < row[n] ? row[n] - there : there - row[n];
        const int32_t distance = x * x + y * y;
        if (apart <= step || (square[n] != 0 && distance > square[n])) continue;
        if (distance == square[n] && there <= beyond[n]) continue;
        beyond[n] = there;
        square[n] = static_cast<int16_t>(distance);
      }
    }
  }
}

// For each n < kSliceLanes, raises covered[n] to coverage[n] if near pixel n (disparity near[n])
// occludes far pixel n (disparity far[n]) in the view. CoverPlaces never lowers covered[n].
STARFOCUS_REFERENCE void CoverPlaces(const int16_t* near, const uint8_t* coverage,
                                     const int16_t* far, const CoverView& view, int16_t* covered) {
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const int16_t nearer = Saturated(near[n] - far[n]);
    const int16_t beside = Saturated(Product15(nearer, view.along) - view.place);
    const bool covers = nearer > view.least && beside >= -view.within && beside <= view.within;
    if (covers && coverage[n] > covered[n]) covered[n] = coverage[n];
  }
}

// Sums the light around each pixel n < kSliceLanes. The sum includes the pixels within kNearReach
// whose near surface is the near surface of pixel n. The light of each pixel is multiplied by the
// pixel's weight and by a filter coefficient from kNearTaps. Each product is rounded half up.
STARFOCUS_REFERENCE void SumNear(const NearRows& rows, NearSums* sums) {
  *sums = {};
  for (int32_t y = -kNearReach; y <= kNearReach; ++y) {
    for (int32_t x = -kNearReach; x <= kNearReach; ++x) {
      const int16_t tap = kNearTaps[std::abs(y)][std::abs(x)];
      for (size_t n = 0; n < kSliceLanes; ++n) {
        const ptrdiff_t here = static_cast<ptrdiff_t>(n), there = here + y * rows.stride + x;
        const int16_t beyond = Saturated(rows.disparity[there] - rows.disparity[here]);
        if (beyond > rows.step || beyond < -rows.step) continue;
        const int32_t weight = rows.weight[there] * tap;
        sums->weight[n] = static_cast<int16_t>(sums->weight[n] + weight);
        for (int c = 0; c < 3; ++c) {
          const int16_t part = Product15(rows.light[c][there], weight);
          sums->light[c][n] = static_cast<int16_t>(sums->light[c][n] + part);
        }
      }
    }
  }
}

// Compares kSliceLanes pixels with the samples around them. The weight of a sample is the product
// of its trust and its closeness, rounded.
STARFOCUS_REFERENCE void SumVotes(const VoteRows& rows, VoteSums* sums) {
  *sums = {};
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const ptrdiff_t here = static_cast<ptrdiff_t>(n);
    const int16_t* closeness = rows.closeness;
    for (int32_t y = -rows.reach; y <= rows.reach; y += rows.step) {
      int32_t similar[2] = {0, 0};
      for (int32_t x = -rows.reach; x <= rows.reach; x += rows.step) {
        const ptrdiff_t there = here + y * rows.stride + x;
        int32_t difference = 0;
        for (const int16_t* colour : rows.colour)
          difference += std::abs(colour[there] - colour[here]);
        const int32_t wide = difference < kWide ? kWide - difference : 0;
        const int32_t tight = difference < kTight ? kTight - difference : 0;
        const int32_t weight = Product15(rows.trust[there], *closeness++);
        const int side = rows.surface[there] > rows.middle[here] ? 1 : 0;
        similar[side] += weight * ((wide * wide >> 9) + (tight * tight >> 2));
        sums->weight[side][n] = static_cast<uint16_t>(sums->weight[side][n] + weight);
      }
      for (int side = 0; side < 2; ++side) {
        sums->similar[side][n] =
            static_cast<uint16_t>(sums->similar[side][n] + (similar[side] >> 4));
      }
    }
  }
}

inline int32_t SmoothWeight(const int32_t* own, const int32_t* other, size_t plane) {
  const auto differs = [&](size_t k) { return own[k * plane] - other[k * plane]; };
  const int32_t difference = ColourDifference(differs(1), differs(2), differs(3));
  return difference < kMostSmoothWeight ? kMostSmoothWeight - difference : 1;
}

// Sets smooth[n] to the weighted mean disparity over neighbours of pixel n, for n < count. The mean
// includes pixel n and all neighbours whose disparity differs from the disparity of pixel n by at
// most `tolerance`.
STARFOCUS_REFERENCE void SmoothDisparity(const SmoothRows& rows, size_t count, int16_t* smooth) {
  for (size_t n = 0; n < count; ++n) {
    const int32_t* own = rows.own + n;
    int32_t disparity = 0, weights = 0;
    for (size_t k = 0; k < rows.count; ++k) {
      for (int32_t x = -rows.radius; x <= rows.radius; x += rows.step) {
        const int32_t* other = rows.rows[k] + static_cast<ptrdiff_t>(n) + x;
        const int32_t apart = *other < *own ? *own - *other : *other - *own;
        if (apart > rows.tolerance) continue;
        const int32_t weight = SmoothWeight(own, other, rows.plane);
        disparity += weight * *other;
        weights += weight;
      }
    }
    smooth[n] = SmoothMean(disparity, weights);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MATTING_H_
