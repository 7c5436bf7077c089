// SPDX-License-Identifier: Apache-2.0
#include "lib/optics/rules.h"

#include <cstddef>

namespace starfocus {
namespace {

// Smallest N / r_max whose aliasing does not exceed the aliasing of over-sampling (Fig. 6).
constexpr double kUnderSampling = 0.787;

// Smallest blur radius that survives subsampling by two (Table I).
constexpr double kLayerRadius = 3.0;

int32_t Ceil(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value > whole ? whole + 1 : whole;
}

// The criterion of ViewsBySubaperture would allow N = 3 for radii up to 7 pixels, which saves 1 to
// 3 % of the instructions. With N = 3, the error grows by 0.2 dB against ground truth on wires, and
// 0.1 dB against benchmark mode on real maps. Using N = 4 up to 18 pixels would save 4 % of the
// instructions and cost 0.1 to 0.4 dB.
//
// Largest blur radius of each N. An N whose radius is that of N - 1 is not used.
constexpr double kSubapertureSteps[] = {0.5, 0.5, 0.5, 5.5, 11, 25,  34,
                                        49,  49,  68,  68,  83, 119, 128};
constexpr int32_t kMostSubapertures = 13;

// Smallest N of openings without fall-off. With N = 3 the error of such openings exceeds the
// threshold.
constexpr int32_t kEvenViews = 4;

// Smallest N above a blur radius of kMoreFrom pixels for openings with corners or narrow parts. The
// subapertures of such openings exceed the error limit if N is smaller. With N = 6 at smaller
// radii, the PSNR of the portrait scene against ground truth decreases by up to 0.3 dB.
constexpr int32_t kMoreViews = 6;
constexpr double kMoreFrom = 5.0;

// Smallest blur radii of layers 1 and 2. Subapertures have a smaller error than the paper's views,
// so the error that layers add must be smaller as well. On the portrait, using layer 2 from 8 or 16
// pixels on loses 0.2 to 0.35 dB and saves 4 % of the instructions. Using layer 1 from 5 pixels on
// loses 0.1 to 0.2 dB and saves up to 19 %. Layer 2 resolves silhouettes only to four pixels.
constexpr double kSubapertureLayerRadius = 7.0;
constexpr double kSubapertureCoarseRadius = 24.0;

// Smallest blur radii of layer 1 for each Demand, by the paper's rule and by the rule for
// subapertures. The smallest radii of layer 2 are proportional to the radii of layer 1.
constexpr double kPaperRadii[] = {kLayerRadius, 4, 5, 6};
constexpr double kSubapertureRadii[] = {kSubapertureLayerRadius, 12, 14, 16};

}  // namespace

int32_t ViewsByPaper(double r_max) {
  if (r_max < 4.0) return Ceil(r_max);
  if (r_max < 4.0 / kUnderSampling) return 4;
  return Ceil(kUnderSampling * r_max);
}

Demand DemandOf(const ApertureShape& opening) {
  if (opening.shape == STARFOCUS_SHAPE_RING) return Demand::kRing;
  if (opening.shape == STARFOCUS_SHAPE_POLYGON || opening.cats_eye > 0) return Demand::kPolygon;
  return opening.shape == STARFOCUS_SHAPE_DISC ? Demand::kDisc : Demand::kFallOff;
}

int32_t ViewsBySubaperture(double r_max, Demand demand) {
  int32_t n = 0;
  while (n < kMostSubapertures && r_max > kSubapertureSteps[n]) ++n;
  if (n == 0 || demand == Demand::kFallOff) return n;
  const int32_t least = demand != Demand::kDisc && r_max > kMoreFrom ? kMoreViews : kEvenViews;
  return n < least ? least : n;
}

int32_t ScaleViews(int32_t n, double scale) {
  // Doubles cannot represent scales such as 1.1 exactly. Subtracting kSlack before rounding up
  // ensures that 10 views times 1.1 gives 11 views, not 12.
  constexpr double kSlack = 1e-6;
  return n == 0 ? 0 : Ceil(n * scale - kSlack);
}

int32_t ViewsOfBenchmark(double r_max) { return 2 * Ceil(r_max); }

int32_t LayerByPaper(double r_min, Demand demand) {
  const double first = kPaperRadii[static_cast<size_t>(demand)];
  if (r_min >= 2 * first) return 2;
  return r_min >= first ? 1 : 0;
}

int32_t LayerBySubaperture(double r_min, bool depth_edges, Demand demand) {
  const double first = kSubapertureRadii[static_cast<size_t>(demand)];
  const double coarse = kSubapertureCoarseRadius * first / kSubapertureLayerRadius;
  if (r_min >= coarse && !depth_edges) return 2;
  return r_min >= first ? 1 : 0;
}

}  // namespace starfocus
