// SPDX-License-Identifier: Apache-2.0
// Matrices of 3 x 3 numbers, which convert colours, and the chromatic adaptation of ICC profiles.
#ifndef STARFOCUS_PLATFORM_MATRIX_H_
#define STARFOCUS_PLATFORM_MATRIX_H_

#include <array>
#include <cstddef>

namespace starfocus {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  // rows

// Returns the determinant of a matrix.
inline double Determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Returns the inverse of a matrix whose determinant is not 0.
inline Matrix Inverse(const Matrix& m) {
  const double factor = 1 / Determinant(m);
  Matrix inverse;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const size_t r = (j + 1) % 3, s = (j + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
      inverse[i][j] = factor * (m[r][p] * m[s][q] - m[r][q] * m[s][p]);
    }
  }
  return inverse;
}

inline Vector Product(const Matrix& m, const Vector& v) {
  Vector result;
  for (size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

inline Matrix Product(const Matrix& a, const Matrix& b) {
  Matrix result = {};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      for (size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

// Returns a matrix that multiplies the i-th coordinate by factors[i].
inline Matrix Diagonal(const Vector& factors) {
  return {{{factors[0], 0, 0}, {0, factors[1], 0}, {0, 0, factors[2]}}};
}

// White of the profile connection space (ICC.1:2022, 7.2.16).
inline constexpr Vector kD50 = {0.9642, 1, 0.8249};

// Returns the matrix that adapts XYZ from `white` to D50 by the linear Bradford transform
// (ICC.1:2022, annex E). Numbers are infinite if a cone response to `white` is 0.
inline Matrix AdaptationToD50(const Vector& white) {
  constexpr Matrix kBradford = {
      {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Vector from = Product(kBradford, white), to = Product(kBradford, kD50);
  const Vector gain = {to[0] / from[0], to[1] / from[1], to[2] / from[2]};
  return Product(Inverse(kBradford), Product(Diagonal(gain), kBradford));
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_MATRIX_H_
