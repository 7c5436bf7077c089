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

struct CellStep {
  double r_max;
  int32_t n;
};
constexpr CellStep kCellSteps[] = {{0.5, 0}, {11, 4},  {24, 6},   {32, 8},   {45, 10},
                                   {59, 12}, {81, 14}, {109, 16}, {120, 18}, {128, 20}};

// With cells the rest of the error is smaller, and so must that of layers be. Against truth on the
// portrait layer 2 from 6 up costs 0.35 dB; layer 1 from 3 up costs nothing where there is no depth
// edge, and saves up to 13 % of the instructions.
constexpr double kCellLayerRadius = 4.0;
constexpr double kEdgeLayerRadius = 5.0;

int32_t LayerFrom(double r_min, double radius) {
  if (r_min >= 2 * radius) return 2;
  return r_min >= radius ? 1 : 0;
}

}  // namespace

int32_t ViewsByPaper(double r_max) {
  if (r_max < 4.0) return Ceil(r_max);
  if (r_max < 4.0 / kUnderSampling) return 4;
  return Ceil(kUnderSampling * r_max);
}

int32_t ViewsByCells(double r_max) {
  int32_t n = 0;
  for (const CellStep& step : kCellSteps) {
    n = step.n;
    if (r_max <= step.r_max) break;
  }
  return n;
}

int32_t ScaleViews(int32_t n, double scale) {
  // 1.1 has no exact double: 10 views are to become 11, not 12.
  constexpr double kSlack = 1e-6;
  return n == 0 ? 0 : Ceil(n * scale - kSlack);
}

int32_t ViewsOfBenchmark(double r_max) { return 2 * Ceil(r_max); }

int32_t LayerByPaper(double r_min) { return LayerFrom(r_min, kLayerRadius); }

int32_t LayerByCells(double r_min, bool depth_edges) {
  const int32_t layer = LayerFrom(r_min, kCellLayerRadius);
  // Layer 2 rounds a silhouette to four pixels of the picture: 0.4 to 0.9 dB against truth on the
  // portrait; layer 1 below kEdgeLayerRadius costs 0.6 dB on the wires, and saves 3 % elsewhere.
  if (depth_edges) return r_min >= kEdgeLayerRadius ? 1 : 0;
  return layer == 0 && r_min >= kLayerRadius ? 1 : layer;
}

}  // namespace starfocus
