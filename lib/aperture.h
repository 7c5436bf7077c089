// The aperture (3) sampled on the grid of rendered views, as integer weights.
#ifndef STARFOCUS_LIB_APERTURE_H_
#define STARFOCUS_LIB_APERTURE_H_

#include <cstddef>
#include <cstdint>

namespace starfocus {

// cot^2(theta) with 16 fractional bits; theta in [0.05 pi, 0.45 pi] gives [0.025, 40].
uint32_t ApertureFallOff(double theta);

// Weights of the views (i, j), i^2 + j^2 <= N^2, as in a_{d,N} of (5). All views together sum to
// exactly 2^sum_bits, so that a constant picture comes out unchanged.
struct Aperture {
  int32_t n = 0;
  int sum_bits = 1;
  int32_t views = 1;
  double extent = 1;                  // of the outermost views of cells, see CellExtent
  const uint16_t* weights = nullptr;  // of 0 <= j <= i <= n at index i (i + 1) / 2 + j

  // Any i, j in [-n, n]; zero outside the disc.
  uint32_t Weight(int32_t i, int32_t j) const {
    if (i < 0) i = -i;
    if (j < 0) j = -j;
    const int32_t high = i > j ? i : j, low = i > j ? j : i;
    return weights[high * (high + 1) / 2 + low];
  }
};

// How far out on a lens of radius 1 views of N along it must lie, for their cells (squares of 1 /
// N) together to blur as much as the lens does, in the mean square: less than 1 where more of the
// cells lies beyond the disc than misses inside it (N = 5: 0.975). At most 1.
double CellExtent(int32_t n);

// Number of weights an Aperture of n stores.
constexpr size_t ApertureSize(int32_t n) {
  return (static_cast<size_t>(n) + 1) * (static_cast<size_t>(n) + 2) / 2;
}

// Fills weights[ApertureSize(n)]. fall_off as ApertureFallOff gives; n in [0, 256].
Aperture MakeAperture(int32_t n, uint32_t fall_off, uint16_t* weights);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_APERTURE_H_
