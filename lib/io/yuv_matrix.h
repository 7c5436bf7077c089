// SPDX-License-Identifier: Apache-2.0
// Coefficients that convert RGB to luma and chroma and back, as defined in starfocus/image.h.
#ifndef STARFOCUS_LIB_IO_YUV_MATRIX_H_
#define STARFOCUS_LIB_IO_YUV_MATRIX_H_

#include <cstdint>

#include "simd/pixels.h"
#include "starfocus/image.h"

namespace starfocus {

constexpr int16_t RoundCoefficient(double value) {
  return static_cast<int16_t>(value < 0 ? value - 0.5 : value + 0.5);
}

// Computes the YUV coefficients from the shares kr and kb of red and blue in luma.
constexpr simd::YuvMatrix MakeYuvMatrix(double kr, double kb, bool full) {
  const double kg = 1 - kr - kb;
  const double p = full ? 1 : 255.0 / 219, q = full ? 1 : 255.0 / 224;
  const double red = 2 - 2 * kr, blue = 2 - 2 * kb;
  simd::YuvMatrix m = {};
  m.black = full ? 0 : 16;
  m.y = RoundCoefficient((1 << 14) * p);
  m.rv = RoundCoefficient((1 << 13) * q * red);
  m.gu = RoundCoefficient(-(1 << 13) * q * blue * kb / kg);
  m.gv = RoundCoefficient(-(1 << 13) * q * red * kr / kg);
  m.bu = RoundCoefficient((1 << 13) * q * blue);
  const double w = (1 << 15) / p, h = (1 << 15) / q / 2;
  m.yr = RoundCoefficient(w * kr);
  m.yb = RoundCoefficient(w * kb);
  m.yg = static_cast<int16_t>(static_cast<int32_t>(w + 0.5) - m.yr - m.yb);
  m.ub = RoundCoefficient(h);
  m.ur = RoundCoefficient(-h * kr / (1 - kb));
  m.ug = static_cast<int16_t>(-m.ur - m.ub);
  m.vr = RoundCoefficient(h);
  m.vb = RoundCoefficient(-h * kb / (1 - kr));
  m.vg = static_cast<int16_t>(-m.vr - m.vb);
  return m;
}

// YUV coefficients, indexed by starfocus_matrix and starfocus_range.
inline constexpr simd::YuvMatrix kYuvMatrices[2][2] = {
    {MakeYuvMatrix(0.299, 0.114, false), MakeYuvMatrix(0.299, 0.114, true)},
    {MakeYuvMatrix(0.2126, 0.0722, false), MakeYuvMatrix(0.2126, 0.0722, true)},
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_YUV_MATRIX_H_
