// SPDX-License-Identifier: Apache-2.0
// Decides which pixels of a given map the sweeps process. The sweeps process the pixels around
// steps and noise of the map, and around pixels that the views contradict. Pixels that are not
// swept keep the disparity of the map.
#ifndef STARFOCUS_LIB_DEPTH_SWEPT_H_
#define STARFOCUS_LIB_DEPTH_SWEPT_H_

#include <cstdint>
#include <cstring>

#include "lib/depth/maps.h"

namespace starfocus {

// Largest distance in pixels between a pixel that is swept and a pixel in doubt. Trusted pixels
// farther away hardly influence a pixel's prior (simd::kMostPrior).
inline constexpr int32_t kSweptRadius = 5;

// Converts the given disparities of a tile to fixed point (kDisparityBits). Disparities that are
// not finite become kNoSurface. Initialises the maps of both sweeps with the converted disparities.
void ReadGiven(const SweepSetup& setup, const starfocus_light_field& light_field, const Rect& tile,
               const EstimateMemory& memory);

// Copies the trusted pixels of a tile to `trusted`, and sets all other pixels to kNoSurface. A
// pixel is trusted if its 3x3 neighbourhood is known and belongs to one surface. The slopes of
// blurred or scaled maps and the pixels of noisy maps are therefore not trusted.
void FindTrusted(const SweepSetup& setup, const Rect& tile, const int16_t* given, int16_t* trusted);

// Marks the pixels of a tile that are in doubt. Requires memory.trusted for the tile.
void FindDoubts(const SweepSetup& setup, const starfocus_light_field& light_field, const Rect& tile,
                const EstimateMemory& memory);

// Marks the pixels of a tile that are swept. Requires the marks that FindDoubts sets for all tiles.
// `scratch` has one byte for each pixel of the tile extended by kSweptRadius pixels.
void FindSwept(const SweepSetup& setup, const Rect& tile, uint8_t* scratch,
               const EstimateMemory& memory);

// Writes the certainty of the pixels of a tile that were not swept. The certainty is the difference
// between the pixel and its neighbours in the centre view, along the row and the column. With a
// wrong disparity, the views fit a pixel worse by approximately the difference between the pixel
// and its neighbours.
void RateUnswept(const SweepSetup& setup, const Plane<const uint8_t>& centre, const Rect& tile,
                 const EstimateMemory& memory);

// Calls act(begin, end) for each run of swept pixels of row y in [from, to), from left to right. If
// `swept` is null, all pixels are one run.
template <class Act>
void ForSwept(const SweepSetup& setup, const uint8_t* swept, int32_t y, int32_t from, int32_t to,
              const Act& act) {
  if (swept == nullptr) return act(from, to);
  const uint8_t* row = swept + setup.At(0, y);
  const auto find = [&](int32_t x, int value) {
    const void* at = std::memchr(row + x, value, static_cast<size_t>(to - x));
    return at == nullptr ? to : static_cast<int32_t>(static_cast<const uint8_t*>(at) - row);
  };
  for (int32_t x = from; x < to;) {
    const int32_t begin = find(x, 1);
    if (begin == to) return;
    x = find(begin, 0);
    act(begin, x);
  }
}

// Calls act(x, y) for each pixel of a rectangle that is swept.
template <class Act>
void ForSwept(const SweepSetup& setup, const uint8_t* swept, const Rect& rect, const Act& act) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    ForSwept(setup, swept, y, rect.x, rect.x + rect.width, [&](int32_t begin, int32_t end) {
      for (int32_t x = begin; x < end; ++x) act(x, y);
    });
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SWEPT_H_
