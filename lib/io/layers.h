// SPDX-License-Identifier: Apache-2.0
// Subsampled layers (paper, III-D and III-E). The centre view is downsampled once per stripe, and
// refocused blocks are upsampled to the picture.
#ifndef STARFOCUS_LIB_IO_LAYERS_H_
#define STARFOCUS_LIB_IO_LAYERS_H_

#include <cstddef>
#include <cstdint>

#include "lib/io/input.h"
#include "simd/kernels.h"

namespace starfocus {

// Half-band filters sinc(n / 2) with a 7-tap Kaiser window and simd::kTapBits fractional bits. The
// gain of each filter is exactly 1: the taps of the downsampling filter, and the taps of each
// upsampling phase, sum to 2^14.
inline constexpr simd::HalfBand kDownFilter = {8476, 5192, -1238};  // beta_D = 1.28.
inline constexpr simd::HalfBand kUpFilter = {16384, 9544, -1352};   // beta_U = 2.17.
static_assert(kDownFilter.centre + 2 * (kDownFilter.near + kDownFilter.far) == 1 << simd::kTapBits);
static_assert(2 * (kUpFilter.near + kUpFilter.far) == 1 << simd::kTapBits);

// One layer of the centre view around a stripe.
struct LayerPlane {
  int32_t width = 0, height = 0;  // Size of the whole layer.
  Range rows = {0, 0};            // Stored rows.
  // The rows before `known` have already been computed in the columns that the previous stripe
  // read.
  int32_t known = 0;
  Plane<int16_t> samples;  // simd::kLayerBits, clamped to the range of samples
};

// Flags of a column of a layer: kNeeded if the current stripe reads the column, and kNeededBefore
// if the previous stripe read the column.
inline constexpr uint8_t kNeeded = 1, kNeededBefore = 2;

// Layers 1 and 2 around a stripe, and the flags for each of their columns of superblocks.
struct StripeLayers {
  LayerPlane planes[STARFOCUS_LAYERS];
  uint8_t* needed[STARFOCUS_LAYERS];
};

// Number of source pixels that the 7 filter taps read before the two source pixels of a layer's
// pixel. After the two source pixels, the taps read kDownBorder - 1 pixels.
inline constexpr int32_t kDownBorder = 3;

// Returns the number of source pixels that the filter reads along an axis to compute `pixels`
// pixels of a layer.
constexpr int32_t TapsOfLayer(int32_t pixels) { return 2 * pixels + 2 * kDownBorder - 1; }

// Scratch memory of a worker for subsampling at most C columns and R rows of layer 1 at once.
struct ResampleScratch {
  int16_t *even, *odd;  // Even and odd pixels of a line: 3 (C + 3) samples each.
  int16_t* half;        // Subsampled along x only: 3 C TapsOfLayer(R) samples.
  int16_t* above;       // Source of layer 2: 3 C R samples of layer 1.
};

// Computes some columns of all rows of `to`, which is layer 1 or 2, from the centre view. Layer 2
// is computed from TapsOfLayer columns and rows of layer 1.
void DownsamplePicture(const simd::Kernels& kernels, const Input& picture, int32_t layer,
                       const Range& columns, const ResampleScratch& scratch, const LayerPlane& to);

// Computes some columns of all rows of `to`, which is layer 2, from the whole layer 1. The result
// is the same as with DownsamplePicture.
void DownsampleLayer(const simd::Kernels& kernels, const LayerPlane& from,
                     const simd::HalfBand& filter, const Range& columns,
                     const ResampleScratch& scratch, const LayerPlane& to);

// Samples of a rectangle of a layer.
struct LayerRect {
  int16_t* samples;       // Packed rows of 3 * width samples.
  int32_t width, height;  // Size in pixels.
};

// Scratch memory for UpsampleByTwo, whose input is `in`.
struct UpsampleScratch {
  int16_t* line;     // 3 * in.width samples.
  int16_t* between;  // 3 * in.width samples.
  int16_t* even;     // 3 * in.width samples.
};

// Upsamples `in` to `out` and clamps the result to the range of samples. Pixel (0, 0) of `out` is
// pixel (first, first) of `in`. `in` must contain one pixel before and two pixels after the area of
// `out` (kUpBorder). The function may write one sample past the end of `out`.
void UpsampleByTwo(const simd::Kernels& kernels, const LayerRect& in, int32_t first,
                   const UpsampleScratch& scratch, const LayerRect& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_LAYERS_H_
