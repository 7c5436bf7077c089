// SPDX-License-Identifier: Apache-2.0
#include "simd/samples.h"
#include "simd/yuv.h"

namespace starfocus::simd::reference {
namespace {

uint8_t Clamped(int32_t value) {
  return static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value);
}

// Returns the sum of colour c over pixels 2 n and 2 n + 1 of both rows.
int32_t SumOfFour(const uint8_t* upper, const uint8_t* lower, size_t count, size_t n, size_t c) {
  const size_t left = 3 * (2 * n) + c, right = 2 * n + 1 < count ? left + 3 : left;
  return upper[left] + upper[right] + lower[left] + lower[right];
}

}  // namespace

void YuvToRgb(const uint8_t* y, const uint8_t* u, const uint8_t* v, size_t count,
              const YuvMatrix& m, uint8_t* rgb) {
  for (size_t n = 0; n < count; ++n, rgb += 3) {
    const int32_t luma = Product15(128 * (y[n] - m.black), m.y) + 32;
    const int32_t du = 256 * (u[n / 2] - 128), dv = 256 * (v[n / 2] - 128);
    rgb[0] = Clamped((luma + Product15(dv, m.rv)) >> 6);
    rgb[1] = Clamped((luma + Product15(du, m.gu) + Product15(dv, m.gv)) >> 6);
    rgb[2] = Clamped((luma + Product15(du, m.bu)) >> 6);
  }
}

void RgbToLuma(const uint8_t* rgb, size_t count, const YuvMatrix& m, uint8_t* y) {
  for (size_t n = 0; n < count; ++n, rgb += 3) {
    const int32_t sum = Product15(128 * rgb[0], m.yr) + Product15(128 * rgb[1], m.yg) +
                        Product15(128 * rgb[2], m.yb);
    y[n] = static_cast<uint8_t>(m.black + ((sum + 64) >> 7));
  }
}

void RgbToChroma(const uint8_t* upper, const uint8_t* lower, size_t count, const YuvMatrix& m,
                 uint8_t* u, uint8_t* v) {
  for (size_t n = 0; 2 * n < count; ++n) {
    const int32_t r = 32 * SumOfFour(upper, lower, count, n, 0);
    const int32_t g = 32 * SumOfFour(upper, lower, count, n, 1);
    const int32_t b = 32 * SumOfFour(upper, lower, count, n, 2);
    const int32_t of_u = Product15(r, m.ur) + Product15(g, m.ug) + Product15(b, m.ub);
    const int32_t of_v = Product15(r, m.vr) + Product15(g, m.vg) + Product15(b, m.vb);
    u[n] = Clamped(128 + ((of_u + 64) >> 7));
    v[n] = Clamped(128 + ((of_v + 64) >> 7));
  }
}

void SplitPairs(const uint8_t* pairs, size_t count, uint8_t* first, uint8_t* second) {
  for (size_t n = 0; n < count; ++n) {
    first[n] = pairs[2 * n];
    second[n] = pairs[2 * n + 1];
  }
}

void JoinPairs(const uint8_t* first, const uint8_t* second, size_t count, uint8_t* pairs) {
  for (size_t n = 0; n < count; ++n) {
    pairs[2 * n] = first[n];
    pairs[2 * n + 1] = second[n];
  }
}

}  // namespace starfocus::simd::reference
