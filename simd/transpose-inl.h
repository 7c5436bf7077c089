// SPDX-License-Identifier: Apache-2.0
// Vector code of transpose.h. Included once per target.
#if defined(STARFOCUS_SIMD_TRANSPOSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_TRANSPOSE_INL_H_
#undef STARFOCUS_SIMD_TRANSPOSE_INL_H_
#else
#define STARFOCUS_SIMD_TRANSPOSE_INL_H_
#endif

#include "simd/compat-inl.h"
#include "simd/transpose.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

using reference::Transpose;

#else

// Transposes 4 x 4 pixels at once; a pixel is 4 bytes wide on the way.
inline void Transpose(const uint8_t* HWY_RESTRICT in, size_t in_stride, size_t rows, size_t columns,
                      uint8_t* HWY_RESTRICT out, size_t out_stride) {
  const hn::FixedTag<uint8_t, 16> d8;
  const hn::Repartition<uint32_t, decltype(d8)> d32;
  const hn::Repartition<uint64_t, decltype(d8)> d64;
  alignas(16) static constexpr uint8_t kWiden[16] = {0, 1, 2, 2, 3, 4,  5,  5,
                                                     6, 7, 8, 8, 9, 10, 11, 11};
  alignas(16) static constexpr uint8_t kNarrow[16] = {0,  1,  2,  4,  5,  6,  8,  9,
                                                      10, 12, 13, 14, 15, 15, 15, 15};
  const auto widen = hn::Load(d8, kWiden), narrow = hn::Load(d8, kNarrow);
  const auto load = [&](const uint8_t* at) HWY_ATTR {
    return hn::BitCast(d32, hn::TableLookupBytes(hn::LoadU(d8, at), widen));
  };
  for (size_t row = 0; row < rows; row += 4) {
    // The last row stands for rows that are not there.
    const uint8_t* at[4];
    for (size_t k = 0; k < 4; ++k) {
      at[k] = in + (row + k < rows ? row + k : rows - 1) * in_stride;
    }
    for (size_t column = 0; column < columns; column += 4) {
      const auto r0 = load(at[0] + 3 * column), r1 = load(at[1] + 3 * column);
      const auto r2 = load(at[2] + 3 * column), r3 = load(at[3] + 3 * column);
      const auto low01 = hn::BitCast(d64, hn::InterleaveLower(d32, r0, r1));
      const auto low23 = hn::BitCast(d64, hn::InterleaveLower(d32, r2, r3));
      const auto high01 = hn::BitCast(d64, hn::InterleaveUpper(d32, r0, r1));
      const auto high23 = hn::BitCast(d64, hn::InterleaveUpper(d32, r2, r3));
      uint8_t* to = out + column * out_stride + 3 * row;
      const auto store = [&](size_t k, auto pixels) HWY_ATTR {
        if (column + k >= columns) return;
        hn::StoreU(hn::TableLookupBytes(hn::BitCast(d8, pixels), narrow), d8, to + k * out_stride);
      };
      store(0, hn::InterleaveLower(d64, low01, low23));
      store(1, hn::InterleaveUpper(d64, low01, low23));
      store(2, hn::InterleaveLower(d64, high01, high23));
      store(3, hn::InterleaveUpper(d64, high01, high23));
    }
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
