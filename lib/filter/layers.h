// SPDX-License-Identifier: Apache-2.0
// Subsampled layers (paper, III-D and III-E): the centre view down once per stripe, and the
// refocused blocks up again.
#ifndef STARFOCUS_LIB_FILTER_LAYERS_H_
#define STARFOCUS_LIB_FILTER_LAYERS_H_

#include <cstddef>
#include <cstdint>

#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

// Half-band filters sinc(n / 2) with a 7-tap Kaiser window, taps with simd::kTapBits. Unit gain
// exactly: the taps of the downsampling filter and those of each upsampling phase sum to 2^14.
inline constexpr simd::HalfBand kDownFilter = {8476, 5192, -1238};  // beta_D = 1.28
inline constexpr simd::HalfBand kUpFilter = {16384, 9544, -1352};   // beta_U = 2.17
static_assert(kDownFilter.centre + 2 * (kDownFilter.near + kDownFilter.far) == 1 << simd::kTapBits);
static_assert(2 * (kUpFilter.near + kUpFilter.far) == 1 << simd::kTapBits);

// Pixels of a layer along an axis of `size` pixels: one more than those inside the picture, so that
// upsampling finds the colour of the edge itself beyond it.
constexpr int32_t LayerSize(int32_t size, int32_t layer) {
  return layer == 0 ? size : (LayerSize(size, layer - 1) + 1) / 2 + 1;
}

// One layer of the centre view around a stripe.
struct LayerPlane {
  int32_t width = 0, height = 0;  // of the whole layer
  RowRange rows = {0, 0};         // what is stored
  int32_t known = 0;              // rows before it are there, in columns the last stripe needed
  Plane<int16_t> samples;         // simd::kLayerBits, in range
};

// Pixels beyond what two by two become one that the 7 taps of a filter read: one less after them.
inline constexpr int32_t kDownBorder = 3;

// Pixels along an axis of what `pixels` of a layer are made of.
constexpr int32_t TapsOfLayer(int32_t pixels) { return 2 * pixels + 2 * kDownBorder - 1; }

// Memory of a worker for subsampling at most C columns and R rows of layer 1 at once.
struct ResampleScratch {
  int16_t *even, *odd;  // a line parted into its even and its odd pixels: 3 (C + 3) samples each
  int16_t* half;        // subsampled along x only: 3 C TapsOfLayer(R) samples
  int16_t* above;       // what layer 2 is made of: 3 C R samples of layer 1
};

// Columns [begin, end) of layer 1 or 2, in the rows of its plane.
struct LevelTarget {
  int32_t layer, begin, end;
  const LayerPlane* plane;
};

// Subsamples the pixels of `to` from the centre view. Of layer 2 these are made of TapsOfLayer as
// many columns and rows of layer 1.
void DownsamplePicture(const simd::Kernels& kernels, const Window& picture,
                       const ResampleScratch& scratch, const LevelTarget& to);

// Samples of a rectangle of a layer.
struct LayerRect {
  int16_t* samples;       // rows packed, 3 * width
  int32_t width, height;  // pixels
};

// Memory for UpsampleByTwo: two lines of `in`.
struct UpsampleScratch {
  int16_t* line;     // 3 * width of in
  int16_t* between;  // 3 * width of in
  int16_t* even;     // 3 * width of in
};

// Doubles `in` into `out`, whose pixel (0, 0) is in's pixel (first, first), clamped to the range
// of samples. in reaches at least one pixel before and two after what out covers (kUpBorder); a
// sample past the end of out may be written.
void UpsampleByTwo(const simd::Kernels& kernels, const LayerRect& in, int32_t first,
                   const UpsampleScratch& scratch, const LayerRect& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_LAYERS_H_
