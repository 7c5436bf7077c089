#include "lib/aperture.h"

#include <cmath>

#include "lib/fixed.h"

namespace starfocus {
namespace {

// (3) relative to its centre, (c / (rho^2 + c))^2 with rho^2 = square / n^2, with 20 fractional
// bits. Integers only, so that every machine makes the same weights.
uint64_t Relative(uint64_t square, uint64_t n_square, uint64_t fall_off) {
  const uint64_t denominator = (square << 16) + fall_off * n_square;   // < 2^39
  const uint64_t ratio = ((fall_off * n_square) << 24) / denominator;  // 2^24 at the centre
  return (ratio * ratio) >> 28;
}

constexpr int64_t Max64(int64_t a, int64_t b) { return a > b ? a : b; }

// How many of the views (+-i, +-j), (+-j, +-i) differ.
uint32_t Orbit(int32_t i, int32_t j) {
  if (i == 0) return 1;
  return j == 0 || i == j ? 4 : 8;
}

// Calls visit(i, j) for 0 <= j <= i <= n inside the disc, the centre last.
template <class Visit>
void ForEachOrbit(int32_t n, const Visit& visit) {
  for (int32_t i = n; i >= 0; --i) {
    for (int32_t j = i; j >= 0; --j) {
      if (i * i + j * j <= n * n) visit(i, j);
    }
  }
}

}  // namespace

uint32_t ApertureFallOff(double theta) {
  const double tangent = std::tan(theta);
  return static_cast<uint32_t>(65536.0 / (tangent * tangent) + 0.5);
}

double CellExtent(int32_t n) {
  // The mean of x^2 is 1 / 4 over a disc, 1 / 12 over a cell.
  int64_t views = 0, squares = 0;
  ForEachOrbit(n, [&](int32_t i, int32_t j) {
    views += Orbit(i, j);
    squares += int64_t{Orbit(i, j)} * (i * i + j * j);
  });
  const auto wanted = static_cast<double>(3 * views * n * n);
  const double extent = std::sqrt(wanted / static_cast<double>(6 * squares + views));
  return n == 0 || extent > 1 ? 1 : extent;
}

Aperture MakeAperture(int32_t n, uint32_t fall_off, uint16_t* weights) {
  Aperture aperture;
  aperture.n = n;
  aperture.extent = CellExtent(n);
  aperture.weights = weights;
  const uint64_t n_square = n == 0 ? 1 : static_cast<uint64_t>(n) * static_cast<uint64_t>(n);
  uint64_t total = 0;
  aperture.views = 0;
  for (size_t index = 0; index < ApertureSize(n); ++index) weights[index] = 0;
  ForEachOrbit(n, [&](int32_t i, int32_t j) {
    total += Orbit(i, j) * Relative(static_cast<uint64_t>(i * i + j * j), n_square, fall_off);
    aperture.views += static_cast<int32_t>(Orbit(i, j));
  });
  // The largest sum for which the centre's weight, with a margin for the rounding of the others,
  // fits 15 bits.
  const uint64_t centre = Relative(0, n_square, fall_off);
  int bits = kMaxWeightBits;
  while (bits > 1 && (centre << bits) / total > static_cast<uint64_t>(kMaxWeight - 8)) --bits;
  aperture.sum_bits = bits;
  // Each orbit takes up the rounding error of those before it; the centre, alone in its orbit,
  // leaves none.
  uint64_t wanted = 0;
  int64_t given = 0;
  ForEachOrbit(n, [&](int32_t i, int32_t j) {
    const int64_t orbit = Orbit(i, j);
    wanted += static_cast<uint64_t>(orbit) *
              Relative(static_cast<uint64_t>(i * i + j * j), n_square, fall_off);
    const auto target = static_cast<int64_t>((wanted << bits) / total);  // < 2^63
    const int64_t weight = Max64(0, (target - given + orbit / 2) / orbit);
    weights[i * (i + 1) / 2 + j] = static_cast<uint16_t>(Checked(ranges::kWeight, weight));
    given += weight * orbit;
  });
  Checked(ranges::kRemainder, given - (int64_t{1} << bits));
  return aperture;
}

}  // namespace starfocus
