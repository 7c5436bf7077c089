// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in colours.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_COLOURS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_COLOURS_INL_H_
#undef STARFOCUS_SIMD_COLOURS_INL_H_
#else
#define STARFOCUS_SIMD_COLOURS_INL_H_
#endif

#include "simd/colours.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Masks of the columns and rows of the window for each pixel of the block. A mask is all ones if
// the column or row is out of reach of the pixel, and 0 otherwise.
struct OutOfReach {
  uint16_t column[kColourWindow][kSliceLanes], row[kColourWindow][kSliceLanes];

  constexpr OutOfReach() : column(), row() {
    for (int k = 0; k < kColourWindow; ++k) {
      for (int n = 0; n < static_cast<int>(kSliceLanes); ++n) {
        const int across = k - n % kColourBlock, down = k - n / kColourBlock;
        column[k][n] = across < 0 || across > 2 * kColourReach ? UINT16_MAX : 0;
        row[k][n] = down < 0 || down > 2 * kColourReach ? UINT16_MAX : 0;
      }
    }
  }
};

// Colours of the 16 pixels of a block, one array for each member of ColourSample.
struct BlockColours {
  int16_t sum[kSliceLanes], red_green[kSliceLanes], green_blue[kSliceLanes];
};

HWY_INLINE BlockColours ColoursOf(const ColourSample* block, size_t stride) {
  BlockColours colours;
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const ColourSample& sample = block[n / kColourBlock * stride + n % kColourBlock];
    colours.sum[n] = sample.sum;
    colours.red_green[n] = sample.red_green;
    colours.green_blue[n] = sample.green_blue;
  }
  return colours;
}

inline void CompareColours(const ColourSample* HWY_RESTRICT window, size_t stride,
                           uint16_t* HWY_RESTRICT least) {
  static constexpr OutOfReach kOut;
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  const BlockColours own = ColoursOf(window + kColourReach * (stride + 1), stride);
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto sum = hn::LoadU(d16, own.sum + n);
    const auto red_green = hn::LoadU(d16, own.red_green + n);
    const auto green_blue = hn::LoadU(d16, own.green_blue + n);
    const ColourSample* row = window;
    for (int32_t y = 0; y < kColourWindow; ++y, row += stride) {
      const auto row_out = hn::LoadU(du16, kOut.row[y] + n);
      for (int32_t x = 0; x < kColourWindow; ++x) {
        const ColourSample& other = row[x];
        if (other.key == kNoColourKey) continue;
        const auto brightness = hn::Abs(hn::Sub(sum, hn::Set(d16, other.sum)));
        const auto a = hn::Sub(red_green, hn::Set(d16, other.red_green));
        const auto b = hn::Sub(green_blue, hn::Set(d16, other.green_blue));
        const auto hue = hn::Add(hn::Add(hn::Abs(a), hn::Abs(b)), hn::Abs(hn::Add(a, b)));
        const auto difference = hn::Min(hn::Add(hn::ShiftRight<2>(brightness), hue),
                                        hn::Set(d16, kMostColourDifference));
        const auto key = hn::Add(hn::BitCast(du16, hn::ShiftLeft<kColourKeyBits>(difference)),
                                 hn::Set(du16, other.key));
        const auto out = hn::Or(row_out, hn::LoadU(du16, kOut.column[x] + n));
        uint16_t* of_group = least + other.place + n;
        hn::StoreU(hn::Min(hn::LoadU(du16, of_group), hn::Or(key, out)), du16, of_group);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
