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
inline constexpr int32_t kBeyondRadius = 3;

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
inline constexpr int32_t kNearRadius = 2;

// Filter coefficients of SumNear, by the distance in columns and rows. The coefficients of all
// pixels sum to 118, so that with weights of 256 the total is less than 1 (15 fractional bits).
inline constexpr int16_t kNearTaps[kNearRadius + 1][kNearRadius + 1] = {
    {10, 8, 4}, {8, 7, 3}, {4, 3, 2}};

// Largest number of samples in a row and in a column around a pixel, for SumVotes.
inline constexpr int32_t kMostVoteSide = 18;
// Largest trust of a sample and largest closeness. Closeness is given in 1/kClosenessUnit, so that
// the rounded product with 15 fractional bits is the weight of the sample.
inline constexpr int32_t kMostTrust = 64, kMostCloseness = 16;
inline constexpr int32_t kClosenessUnit = (1 << 15) / kMostTrust;

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

// Returns the mean disparity over the neighbours of a pixel. `disparity` is the sum of the weighted
// disparities, below 2^27, and `weights` is the sum of the weights, below 2^13. Halves are rounded
// away from zero.
inline int16_t SmoothMean(int32_t disparity, int32_t weights) {
  const int32_t half = disparity < 0 ? -weights : weights;
  return static_cast<int16_t>((2 * disparity + half) / (2 * weights));
}

namespace reference {

// For each pixel n < kSliceLanes of a row, finds the nearest pixel within kBeyondRadius columns and
// rows whose disparity differs by more than `step`. Among equally distant pixels, the one with the
// largest disparity is found, so that mirrored maps give mirrored results. Writes its disparity and
// its squared distance; without such a pixel, the disparity of pixel n and 0. Rows are `stride`
// samples apart.
STARFOCUS_REFERENCE void FindBeyond(const int16_t* row, ptrdiff_t stride, int16_t step,
                                    int16_t* beyond, int16_t* square) {
  for (ptrdiff_t n = 0; n < static_cast<ptrdiff_t>(kSliceLanes); ++n) {
    beyond[n] = row[n];
    square[n] = 0;
    for (int32_t y = -kBeyondRadius; y <= kBeyondRadius; ++y) {
      for (int32_t x = -kBeyondRadius; x <= kBeyondRadius; ++x) {
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

// Sums the light around each pixel n < kSliceLanes of a row. The sum includes the pixels within
// kNearRadius whose near surface is the near surface of pixel n: `disparity`, which is the
// disparity of the near surface, differs by at most `step`. The light of each pixel is multiplied
// by the pixel's weight, in [0, 256], and by a filter coefficient from kNearTaps. Each product is
// rounded half up. sums[c][n] is the sum of colour c, and sums[3][n] the sum of the weights with 15
// fractional bits. The inputs point to the first pixel of the row; rows are `stride` samples apart.
STARFOCUS_REFERENCE void SumNear(const int16_t* const light[3], const int16_t* disparity,
                                 const int16_t* weight, ptrdiff_t stride, int16_t step,
                                 int16_t sums[4][kSliceLanes]) {
  for (size_t k = 0; k < 4; ++k) {
    for (size_t n = 0; n < kSliceLanes; ++n) sums[k][n] = 0;
  }
  for (int32_t y = -kNearRadius; y <= kNearRadius; ++y) {
    for (int32_t x = -kNearRadius; x <= kNearRadius; ++x) {
      const int16_t tap = kNearTaps[std::abs(y)][std::abs(x)];
      for (size_t n = 0; n < kSliceLanes; ++n) {
        const ptrdiff_t here = static_cast<ptrdiff_t>(n), there = here + y * stride + x;
        const int16_t beyond = Saturated(disparity[there] - disparity[here]);
        if (beyond > step || beyond < -step) continue;
        const int32_t part = weight[there] * tap;
        sums[3][n] = static_cast<int16_t>(sums[3][n] + part);
        for (int c = 0; c < 3; ++c) {
          sums[c][n] = static_cast<int16_t>(sums[c][n] + Product15(light[c][there], part));
        }
      }
    }
  }
}

// Compares kSliceLanes pixels of a row with the samples around them: the pixels of every step-th
// column and row, from -reach to reach. `colour` are the planes of brightness and of two
// differences of colour, in [-383, 383], and `surface` are disparities. A sample counts as nearer
// if its surface is above middle[n], the disparity given for pixel n. The weight of a sample is the
// product of its trust, in [0, kMostTrust], and its closeness, rounded. `closeness` has one element
// for each sample, by rows, in [0, kMostCloseness * kClosenessUnit]. All other inputs point to the
// first pixel of the row, and rows are `stride` samples apart.
STARFOCUS_REFERENCE void SumVotes(const int16_t* const colours[3], const int16_t* surface,
                                  const int16_t* trust, const int16_t* middle, ptrdiff_t stride,
                                  int32_t reach, int32_t step, const int16_t* closeness,
                                  VoteSums* sums) {
  *sums = {};
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const ptrdiff_t here = static_cast<ptrdiff_t>(n);
    const int16_t* close = closeness;
    for (int32_t y = -reach; y <= reach; y += step) {
      int32_t similar[2] = {0, 0};
      for (int32_t x = -reach; x <= reach; x += step) {
        const ptrdiff_t there = here + y * stride + x;
        int32_t difference = 0;
        for (size_t c = 0; c < 3; ++c) {
          difference += std::abs(colours[c][there] - colours[c][here]);
        }
        const int32_t wide = difference < kWide ? kWide - difference : 0;
        const int32_t tight = difference < kTight ? kTight - difference : 0;
        const int32_t weight = Product15(trust[there], *close++);
        const int side = surface[there] > middle[here] ? 1 : 0;
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

// Sets smooth[n] to the weighted mean disparity over neighbours of pixel n of the row `own`, for
// n < count. The neighbours are the pixels of the `height` rows `rows`, in every `step`-th column
// within `radius` columns. The mean includes pixel n and all neighbours whose disparity differs
// from the disparity of pixel n by at most `tolerance`.
//
// A row has four planes, which are `plane` elements apart: disparity, and the sum of red, green and
// blue, red - green, and green - blue. `radius` more pixels at both ends of a row must be readable.
STARFOCUS_REFERENCE void SmoothDisparity(const int32_t* own, const int32_t* const* rows,
                                         size_t height, size_t plane, int32_t radius, int32_t step,
                                         int32_t tolerance, size_t count, int16_t* smooth) {
  for (size_t n = 0; n < count; ++n) {
    const int32_t* here = own + n;
    int32_t disparity = 0, weights = 0;
    for (size_t k = 0; k < height; ++k) {
      for (int32_t x = -radius; x <= radius; x += step) {
        const int32_t* other = rows[k] + static_cast<ptrdiff_t>(n) + x;
        if (std::abs(*other - *here) > tolerance) continue;
        const int32_t weight = SmoothWeight(here, other, plane);
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
