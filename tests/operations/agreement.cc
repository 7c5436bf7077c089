// SPDX-License-Identifier: Apache-2.0
// Families of refocusings that must agree with each other.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "starfocus/starfocus.hpp"
#include "tests/operations/families.h"
#include "tests/operations/rig.h"
#include "tests/operations/setup.h"
#include "tests/support/config.h"
#include "tests/support/symmetry.h"
#include "tests/support/transfer_curve.h"

namespace starfocus::stress {
namespace {

// The following limits apply if the focus or the aperture of a flat scene changes by a small step.
// Each limit is the largest change of a pixel, in 255ths of white. The limit kSmoothJump applies if
// neither the layer nor N by (9) changes. With constant layer and N, the weights of the views
// change gradually.
constexpr int kSmoothJump = 12;
// Limit for steps of the lens that change N, which is given by equation (9) or by the benchmark
// mode. At r = 1, five views become thirteen, and the two PSFs differ by 1e-2 (Fig. 6 below N = 4).
// The difference is larger if theta puts all weight in the middle or on the rim.
constexpr int kViewsJump = 64;
// Limit for steps of the lens that change the layer. With the theta of Table I, a subsampled blur
// differs from the ideal blur by 6.7e-4.
constexpr int kLayerJump = 24;
// Limit for steps of the lens that change the layer, with any theta other than that of Table I. The
// filters are not optimised for other values of theta, so the blurs differ more, especially for
// apertures with a bright rim.
constexpr int kLayerJumpOfTheta = 48;
// Limit for the blur mode, whose PSFs exist only for radii that are at least 1/8 pixel apart.
constexpr int kLadderJump = 48;

// Returns the layer of a flat scene, in which all blocks have the same layer.
int LayerOf(const test::Report& report) {
  return report.layers[2].pixels > 0 ? 2 : report.layers[1].pixels > 0 ? 1 : 0;
}

// Returns true if each rendered view stands for a wide subaperture. The result is not valid for the
// blur mode, which has no views.
bool UsesSubapertures(const Setup& setup) {
  const starfocus::Params& params = setup.params;
  if (params.study.mode != STARFOCUS_MODE_FRAME || setup.config.views == 1)
    return params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN;
  return params.study.renderer == STARFOCUS_RENDERER_SLICES;
}

int MostJump(const Setup& setup, const test::Report& a, const test::Report& b) {
  const starfocus::Params& params = setup.params;
  if (params.study.mode == STARFOCUS_MODE_BLUR) return kLadderJump;
  int most = kSmoothJump;
  if (LayerOf(a) != LayerOf(b)) {
    most = params.theta == test::Params(0).theta ? kLayerJump : kLayerJumpOfTheta;
  }
  return a.n != b.n && !UsesSubapertures(setup) ? std::max(most, kViewsJump) : most;
}

// Returns the largest difference of light, in 255ths of white.
double LargestDifference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b,
                         int transfer) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    largest =
        std::max(largest, std::fabs(test::LightOf(a[i], transfer) - test::LightOf(b[i], transfer)));
  }
  return largest;
}

}  // namespace

// Mirroring, rotating or transposing a light field of whole blocks must mirror, rotate or transpose
// the result. With wide subapertures, light fields are not transposed, since views are rendered
// along rows first.
Outcome Mirrors(test::Random* random) {
  Setup setup = RandomSetup({20, 6, 4, 6}, random);
  const float low = setup.scene.disparity_min, high = setup.scene.disparity_max;
  setup.scene =
      test::EmptyScene(32, random->Int(0, 3) == 0 ? 64 : 32, setup.scene.views(), low, high);
  SetDepth(static_cast<Depth>(random->Int(0, 4)), &setup.scene, random);
  SetColours(static_cast<Colours>(random->Int(0, 2)), &setup.scene, random);
  setup.config.width = setup.scene.width;
  setup.config.height = setup.scene.height;
  setup.config.superblock = 32;
  // subsampling starts at the left and the top, so layers are not symmetric
  setup.config.tuning.max_layer = 0;
  // Among equally near pixels, coverage uses the first pixel in row order, which is not symmetric.
  // With the disparity range of strands, several pixels are often at the same smallest distance.
  if (setup.strands) setup.config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  // Polygons and cat's eyes are not symmetric.
  starfocus::Params& lens = setup.params;
  if (lens.shape == STARFOCUS_SHAPE_POLYGON) lens.shape = STARFOCUS_SHAPE_DISC;
  lens.cats_eye = 0;
  test::Symmetry symmetry = {random->Int(0, 1) == 1, random->Int(0, 1) == 1,
                             random->Int(0, 1) == 1};
  if (setup.params.study.mode != STARFOCUS_MODE_BLUR && UsesSubapertures(setup))
    symmetry.transpose = false;
  const std::vector<uint8_t> plain = Refocused(setup, RandomVariant(random));
  Setup other = setup;
  other.scene = test::Move(symmetry, setup.scene);
  other.config.width = other.scene.width;
  other.config.height = other.scene.height;
  const std::vector<uint8_t> moved = Refocused(other, RandomVariant(random));
  Outcome outcome;
  outcome.error =
      test::Compare(symmetry, setup.scene.width, setup.scene.height, plain.data(), moved.data())
          .largest;
  if (outcome.error > 0) {
    return Fail(setup, "the picture of the moved light field (transposed " +
                           std::to_string(symmetry.transpose) + ", mirrored " +
                           std::to_string(symmetry.mirror_x) + " " +
                           std::to_string(symmetry.mirror_y) + ") differs by " +
                           std::to_string(int(outcome.error)));
  }
  return outcome;
}

// A scene without depth edges has no holes, so the side views must not affect the result.
Outcome SideViews(test::Random* random) {
  Setup setup = FlatSetup(random->Int(1, 40), random->Int(1, 30), RandomRadius(8, random), random);
  SetColours(static_cast<Colours>(random->Int(0, 2)), &setup.scene, random);
  const std::vector<uint8_t> plain = Refocused(setup, RandomVariant(random));
  for (size_t view = 1; view < setup.scene.pictures.size(); ++view) {
    for (uint8_t& sample : setup.scene.pictures[view]) sample = random->Byte();
  }
  const std::vector<uint8_t> other = Refocused(setup, RandomVariant(random));
  if (plain != other) return Fail(setup, "the side views affect the picture of a flat scene");
  return {0, ""};
}

// Changes the focus or the aperture by a small step. Outcome::error is the largest change of a
// pixel.
Outcome Continuity(test::Random* random) {
  Setup setup = FlatSetup(random->Int(8, 40), random->Int(8, 30), RandomRadius(8, random), random);
  SetColours(random->Int(0, 1) == 0 ? Colours::kSmooth : Colours::kNoise, &setup.scene, random);
  const bool focus = random->Int(0, 1) == 0;
  Setup other = setup;
  if (focus) {
    other.params.focus += other.params.focus < 0 ? -1.0 / 64 : 1.0 / 64;
  } else {
    setup.params.aperture = random->Real(0.1, 1);
    other.params.aperture = setup.params.aperture * (1 - 1.0 / 256);
  }
  FitBlur(&setup);
  FitBlur(&other);
  test::Report report_a, report_b;
  const std::vector<uint8_t> a = Refocused(setup, RandomVariant(random), &report_a);
  const std::vector<uint8_t> b = Refocused(other, RandomVariant(random), &report_b);
  const double jump = LargestDifference(a, b, setup.config.transfer);
  const int most = MostJump(setup, report_a, report_b);
  if (jump > most) {
    return Fail(setup, "a small step of the lens changes a pixel by " + std::to_string(jump) +
                           ", N " + std::to_string(report_a.n) + " to " +
                           std::to_string(report_b.n) + ", L " + std::to_string(LayerOf(report_a)) +
                           " to " + std::to_string(LayerOf(report_b)));
  }
  return {jump, ""};
}

}  // namespace starfocus::stress
