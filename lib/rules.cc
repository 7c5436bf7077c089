#include "lib/rules.h"

namespace starfocus {
namespace {

// Lowest N / r_max without more aliasing than over-sampling has (Fig. 6).
constexpr double kUnderSampling = 0.787;

// Smallest blur radius that survives subsampling by two (Table I).
constexpr double kLayerRadius = 3.0;

int32_t Ceil(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value > whole ? whole + 1 : whole;
}

}  // namespace

int32_t ViewsByPaper(double r_max) {
  if (r_max < 4.0) return Ceil(r_max);
  if (r_max < 4.0 / kUnderSampling) return 4;
  return Ceil(kUnderSampling * r_max);
}

int32_t ViewsOfBenchmark(double r_max) { return 2 * Ceil(r_max); }

int32_t LayerByPaper(double r_min) {
  if (r_min >= 2 * kLayerRadius) return 2;
  return r_min >= kLayerRadius ? 1 : 0;
}

}  // namespace starfocus
