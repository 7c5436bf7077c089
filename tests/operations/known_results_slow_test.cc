// SPDX-License-Identifier: Apache-2.0
// Random pictures whose result is known or bounded.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "starfocus/experimental.h"
#include "tests/operations/cases.h"
#include "tests/operations/random_cases.h"
#include "tests/support/refocused.h"
#include "tests/support/shapes.h"
#include "tests/support/symmetry.h"
#include "tests/support/transfer_curve.h"

namespace known_results_slow_test {
namespace {

using namespace properties;
using test::Random;

test::Output Refocused(const Case& of, test::Report* report = nullptr) {
  return test::OutputOf(of.config, of.params, of.scene, report);
}

bool MayResample(const Case& of) {
  return of.params.study.mode == STARFOCUS_MODE_BLOCK && of.config.tuning.max_layer > 0;
}

// Returns the number of samples of a picture of one colour that differ from this colour by more
// than `most` codes.
int CountChanged(const Case& of, const uint8_t colour[3], int most = 0) {
  Case constant = of;
  SetColour(colour, &constant.scene);
  const test::Output out = Refocused(constant);
  int changed = 0;
  for (size_t i = 0; i < out.bytes.size(); ++i) {
    changed += std::abs(out.bytes[i] - colour[i % 3]) > most;
  }
  return changed;
}

// Every filter has a gain of exactly 1. If `rounds`, dark codes may change by one code, since
// partial coverage is rounded to 15 bits: in thin structures, most views show parts of several
// surfaces.
void CheckConstant(const Case& of, bool rounds, Random* random) {
  const int most = random->Int(0, 1) == 0 ? 40 : 255;  // dark codes are few levels of light
  const uint8_t colour[3] = {uint8_t(random->Int(0, most)), uint8_t(random->Int(0, most)),
                             uint8_t(255 * random->Int(0, 1))};
  const bool dark = std::min(colour[0], colour[1]) <= 40;
  CAPTURES(of.Text(), int(colour[0]), int(colour[1]), int(colour[2]));
  CHECK(CountChanged(of, colour, rounds && dark ? 1 : 0) == 0);
}

// Wrong coverage, given or found, would make the light of near surfaces darker or lighter than in
// any view.
void ForgetCoverage(Case* of) {
  of->scene.coverage.clear();
  of->config.features &= ~STARFOCUS_FEATURE_COVERAGE;
}

// Inverted views give the inverted picture, except for the rounding of halves. Rounding occurs once
// per pixel at layer 0, and a few times more at other layers. If all weights are positive, no
// sample may lie outside the levels of the views.
void CheckInversion(const Case& of, Random*) {
  constexpr int kMost = 2;
  CAPTURE(of.Text());
  const test::Output plain = Refocused(of);
  int low = 255, high = 0;
  Case inverted = of;
  for (int view = 0; view < of.scene.views(); ++view) {
    for (int y = 0; y < of.scene.height; ++y) {
      uint8_t* row = inverted.scene.Pixel(view, 0, y);
      for (int x = 0; x < 3 * of.scene.width; ++x) {
        low = std::min<int>(low, row[x]);
        high = std::max<int>(high, row[x]);
        row[x] = uint8_t(255 - row[x]);
      }
    }
  }
  if (!MayResample(of)) {
    const auto ends = std::minmax_element(plain.bytes.begin(), plain.bytes.end());
    CHECK(*ends.first >= low);
    CHECK(*ends.second <= high);
  }
  // Codes are not proportional to light, so the inverse of a picture is not the inverse of its
  // light.
  if (of.config.transfer != STARFOCUS_TRANSFER_NONE) return;
  const test::Output other = Refocused(inverted);
  int largest = 0;
  for (size_t i = 0; i < plain.bytes.size(); ++i) {
    largest = std::max(largest, std::abs(plain.bytes[i] + other.bytes[i] - 255));
  }
  // Deblocking compares rounded differences with a threshold, so a picture and its inverse may be
  // deblocked differently.
  const bool deblocked = MayResample(of) && of.config.tuning.deblocking > 0;
  CHECK(largest <= kMost + (deblocked ? int(of.config.tuning.deblocking) : 0));
}

void CheckEither(const Case& of, Random* random) {
  return random->Int(0, 1) == 0 ? CheckConstant(of, true, random) : CheckInversion(of, random);
}

TEST_CASE("constant: a picture of any level is unchanged") {
  for (int level = 0; level < 256; ++level) {
    Case of;
    Random random(uint64_t(level) + 1);
    of.scene = test::EmptyScene(19, 11, test::kStars[level % 4], -2, 3);
    SetDepth(Depth::kPiecewise, &of.scene, &random);
    of.config = test::ConfigFor(of.scene);
    const uint8_t colour[3] = {uint8_t(level), uint8_t(level), uint8_t(level)};
    for (const int transfer : {STARFOCUS_TRANSFER_NONE, STARFOCUS_TRANSFER_SRGB}) {
      of.config.transfer = transfer;
      CAPTURES(level, transfer);
      CHECK(CountChanged(of, colour) == 0);
    }
  }
}

TEST_CASE("constant: pictures of one colour are unchanged by random lenses") {
  ForRandomCases(600, [](Random* random) {
    CheckConstant(RandomCase({40, 8, 8}, random), false, random);
  });
}

// With wide apertures and few views, subapertures are wider than three pixels, and slices are
// spread in separate memory. With N = 4, subapertures extend beyond the blur radius.
TEST_CASE("constant: pictures of one colour are unchanged by wide subapertures") {
  ForRandomCases(60, [](Random* random) {
    Case of;
    const auto radius = float(random->Real(10, 50));
    of.scene = test::EmptyScene(64, 64, test::kStars[random->Int(0, 1)], -radius, radius);
    SetDepth(Depth::kLevels, &of.scene, random);
    RandomLens(radius, &of, random);
    const auto mode = random->Int(0, 1) == 0 ? STARFOCUS_MODE_BLOCK : STARFOCUS_MODE_FRAME;
    of.params = test::Params(0, 1, mode, STARFOCUS_RENDERER_SLICES);
    of.config.tuning.n_scale = random->Real(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE);
    of.config.max_blur = double(radius);
    CheckConstant(of, true, random);
  });
}

// If an opening is much brighter in the middle, most views have small weights, and dark codes are
// few levels of light. The engine therefore scales the weights up and adds the products in several
// parts. Slices that cover parts of a pixel still cause a rounding error, of one code, which
// affects up to three pixels of a few pictures. In thin structures, it affects more pixels, because
// most views show parts of several surfaces there.
TEST_CASE("constant: openings with a steep fall-off hardly change pictures of dark codes") {
  int pictures = 0;  // pictures with a changed pixel
  ForRandomCases(300, [&](Random* random) {
    Case of;
    const auto radius = float(random->Real(1.5, 12));
    of.scene = test::EmptyScene(64, 64, 5, -radius, radius);
    SetDepth(Depth::kLevels, &of.scene, random);
    of.config = test::ConfigFor(of.scene, double{radius});
    const auto mode = random->Int(0, 1) == 0 ? STARFOCUS_MODE_BLOCK : STARFOCUS_MODE_FRAME;
    of.params = test::Params(0, 1, mode, STARFOCUS_RENDERER_SLICES);
    of.params.theta = random->Real(0.9, STARFOCUS_MAX_THETA);
    const bool thin = random->Int(0, 1) == 0;
    test::SetFeature(STARFOCUS_FEATURE_COVERAGE, thin, &of.config.features);
    const auto code = uint8_t(random->Int(1, 39));
    const uint8_t colour[3] = {code, code, code};
    CAPTURES(of.Text(), int(code), thin);
    CHECK(CountChanged(of, colour, 1) == 0);
    const int changed = thin ? 0 : CountChanged(of, colour);
    CHECK(changed <= 9);
    pictures += changed > 0;
  });
  CHECK(pictures <= 2);
}

// A random choice of two levels: in squares, stripes or a rectangle of a few pixels, or at random.
void DrawTwoLevels(int low, int high, Random* random, test::Scene* scene) {
  const int kind = random->Int(0, 3), side_x = random->Int(1, 12), side_y = random->Int(1, 12);
  const bool alike = random->Int(0, 2) > 0;
  for (int view = 0; view < scene->views(); ++view) {
    for (int y = 0; y < scene->height; ++y) {
      for (int x = 0; x < scene->width; ++x) {
        bool bright = random->Int(0, 1) == 1;
        if (kind == 1) bright = (x / side_x + y / side_y) % 2 == 1;
        if (kind == 2) bright = x >= side_x && x < 2 * side_x && y >= side_y && y < 3 * side_y;
        if (kind == 3) bright = x % (side_x + 1) == 0 || y % (side_y + 1) == 0;
        std::fill_n(scene->Pixel(view, x, y), 3, uint8_t(bright ? high : low));
      }
    }
    if (alike && view > 0) scene->pictures[size_t(view)] = scene->pictures[0];
  }
}

// starfocus.h states by how much pictures of STARFOCUS_MODE_BLOCK may exceed the levels of the
// views; those of other modes may not.
TEST_CASE("levels: pictures exceed the levels of the views by no more than starfocus.h states") {
  double largest[2] = {};  // overshoot of each renderer as a share of the contrast
  ForRandomCases(700, [&](Random* random) {
    Case of;
    const double range = random->Int(0, 1) * random->Real(0, 4), radius = random->Real(1, 40);
    of.scene = test::EmptyScene(random->Int(8, 64), random->Int(8, 48),
                                test::kStars[random->Int(0, 3)], 0, float(range));
    SetDepth(Depth::kPiecewise, &of.scene, random);
    const int low = random->Int(0, 120), high = random->Int(low + 1, 255);
    DrawTwoLevels(low, high, random, &of.scene);
    const auto mode = random->Int(0, 2) > 0    ? STARFOCUS_MODE_BLOCK
                      : random->Int(0, 1) == 0 ? STARFOCUS_MODE_FRAME
                                               : STARFOCUS_MODE_BENCHMARK;
    const int lines = random->Int(0, 1);
    of.params = test::Params(random->Int(0, 1) == 0 ? range + radius : -radius, 1, mode,
                             test::kRenderers[1 - lines]);
    of.config = test::ConfigFor(of.scene, radius + range + 1);
    of.config.transfer = random->Int(0, 1);
    const int opening = random->Int(0, 2);
    if (opening == 1) {
      of.params.theta = random->Int(0, 1) == 0
                            ? STARFOCUS_MAX_THETA
                            : random->Real(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA);
    }
    if (opening == 2) test::RandomShape(&of.params, random);
    test::ReserveFor(of.params, &of.config);
    CAPTURES(of.Text(), low, high);
    const test::Output out = Refocused(of);
    const auto ends = std::minmax_element(out.bytes.begin(), out.bytes.end());
    const int below = low - *ends.first, above = *ends.second - high;
    if (mode != STARFOCUS_MODE_BLOCK) {
      CHECK(std::max(below, above) <= 0);
      return;
    }
    // One level is the error of rounding.
    const auto light = [&](int level) { return test::LightOf(level, of.config.transfer); };
    const double beyond = std::max(below > 0 ? light(low) - light(low - below + 1) : 0,
                                   above > 0 ? light(high + above - 1) - light(high) : 0);
    const double contrast = beyond / (light(high) - light(low));
    largest[lines] = std::max(largest[lines], contrast);
    CHECK(contrast <= (lines == 0 ? 0.04 : opening == 0 ? 0.13 : 0.5));
  });
  MESSAGE("largest overshoot with slices ", largest[0], ", with the line scan ", largest[1]);
}

TEST_CASE("inversion: inverted squares give the inverted picture") {
  ForRandomCases(400, [](Random* random) {
    Case of = RandomCase({40, 8, 8}, random);
    ForgetCoverage(&of);
    DrawTwoLevels(0, 255, random, &of.scene);
    CheckInversion(of, random);
  });
}

TEST_CASE(
    "inversion: inverted pictures of sizes and radii near thresholds give inverted pictures") {
  constexpr int kSides[] = {1, 15, 16, 17, 31, 32, 33, 47, 48, 49, 63, 64, 65};
  ForRandomCases(400, [&](Random* random) {
    const int width = kSides[random->Int(0, random->Int(2, 12))];
    const int height = kSides[random->Int(0, random->Int(2, 6))];
    Case of = FlatCase(width, height, RandomRadius(8, random), random);
    SetColours(static_cast<Colours>(random->Int(0, 2)), &of.scene, random);
    CheckInversion(of, random);
  });
}

TEST_CASE("inversion: inverted noise of noisy depth gives inverted pictures") {
  ForRandomCases(400, [](Random* random) {
    Case of = RandomCase({32, 8, 16}, random);
    ForgetCoverage(&of);
    SetDepth(Depth::kNoisy, &of.scene, random);
    SetColours(Colours::kNoise, &of.scene, random);
    CheckInversion(of, random);
  });
}

// Noise must not decide how a picture is refocused, not even in front of hair.
TEST_CASE("noise: in frame mode, one code of noise changes no pixel by more than a few codes") {
  ForRandomCases(300, [](Random* random) {
    Case of = RandomCase({40, 8, 12}, random);
    of.scene.coverage.clear();
    SetStrands(&of.scene, random);
    of.config.transfer = STARFOCUS_TRANSFER_NONE;
    of.params.study.mode = STARFOCUS_MODE_FRAME;
    of.params.study.renderer = STARFOCUS_RENDERER_LINE_SCAN;
    CAPTURE(of.Text());
    const test::Output plain = Refocused(of);
    for (std::vector<uint8_t>& picture : of.scene.pictures) {
      for (uint8_t& value : picture)
        value = uint8_t(std::clamp(value + random->Int(-1, 1), 0, 255));
    }
    const test::Output noisy = Refocused(of);
    int largest = 0;
    for (size_t i = 0; i < plain.bytes.size(); ++i) {
      largest = std::max(largest, std::abs(plain.bytes[i] - noisy.bytes[i]));
    }
    CHECK(largest <= 8);
  });
}

// Makes a case of the whole range of disparities and an aperture so narrow that the blur is small.
Case RangeCase(int size, float low, float high, double radius, Random* random) {
  Case of;
  of.scene = test::EmptyScene(random->Int(1, size), random->Int(1, size),
                              test::kStars[random->Int(0, 3)], low, high);
  SetDepth(static_cast<Depth>(random->Int(0, 4)), &of.scene, random);
  SetColours(static_cast<Colours>(random->Int(0, 2)), &of.scene, random);
  RandomLens(radius, &of, random);
  return of;
}

TEST_CASE("limits: the largest blurs keep constants and inversions") {
  ForRandomCases(80, [](Random* random) {
    // In benchmark mode, the number of views grows with the square of the radius. Cases in
    // benchmark mode are therefore rare and have one pixel.
    const int kind = random->Int(0, 63), side = kind == 0 ? 1 : kind < 4 ? 2 : 5;
    const auto spread = float(random->Int(0, 1) * random->Real(0, 200));
    const double radius = kind == 0 ? 16 : kind < 4 ? STARFOCUS_MAX_BLUR : random->Int(13, 30);
    Case of = RangeCase(side, -spread, spread, radius, random);
    of.params.study.mode = kind == 0 ? int{STARFOCUS_MODE_BENCHMARK} : random->Int(0, 1) + 2;
    of.config.superblock = 32;
    if (of.Radius() > STARFOCUS_MAX_BLUR)
      of.params.aperture *= STARFOCUS_MAX_BLUR / of.Radius() * 0.999999;
    FitBlur(&of);
    CheckEither(of, random);
  });
}

TEST_CASE("limits: the largest disparities keep constants and inversions") {
  ForRandomCases(400, [](Random* random) {
    const auto most = float(STARFOCUS_MAX_DISPARITY);
    const int kind = random->Int(0, 2);
    const float low = kind == 0 ? most - 1.0f / 64 * float(random->Int(0, 300)) : -most;
    const float high = kind == 1 ? -most + 1.0f / 64 * float(random->Int(0, 300)) : most;
    Case of = RangeCase(24, low, high, RandomRadius(8, random), random);
    ForgetCoverage(&of);
    CheckEither(of, random);
  });
}

TEST_CASE("limits: a focus of any distance keeps constants and inversions") {
  ForRandomCases(400, [](Random* random) {
    Case of = RandomCase({24, 6, random->Int(0, 1) == 0 ? 2.0F : 100.0F}, random);
    const double distance = std::pow(10.0, random->Real(1, 5.9));
    const bool in_front = random->Int(0, 1) == 0;
    SetFocus(in_front ? distance : -distance, in_front, &of.params, random);
    of.params.aperture = 1;
    of.params.aperture = std::min(1.0, random->Real(0.01, 6) / of.Radius());
    FitBlur(&of);
    RandomMode(&of, random);
    CheckEither(of, random);
  });
}

// Returns by how much the mean brightness of a periodic picture changes. The second half of each
// period of the content is the inverse of the first half around an integer level. Rounding errors
// of both halves cancel, so the mean must not change.
double MeanChange(int mean, int amplitude, double radius, Case* of, Random* random) {
  constexpr int kPeriod = 16;
  const int margin = static_cast<int>(radius) + 16, side = 2 * margin + kPeriod;
  // Without a transfer function, codes are averaged.
  of->config.transfer = STARFOCUS_TRANSFER_NONE;
  int pattern[kPeriod][kPeriod];
  for (auto& row : pattern) {
    for (int x = 0; x < kPeriod / 2; ++x) {
      row[x] = mean + random->Int(-amplitude, amplitude);
      row[x + kPeriod / 2] = 2 * mean - row[x];
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      std::fill_n(of->scene.Pixel(0, x, y), 3, uint8_t(pattern[y % kPeriod][x % kPeriod]));
    }
  }
  const test::Output out = Refocused(*of);
  double sum = 0;
  for (int y = margin; y < margin + kPeriod; ++y) {
    for (int x = margin; x < margin + kPeriod; ++x) sum += *out.Pixel(x, y) - mean;
  }
  return sum / (kPeriod * kPeriod);
}

TEST_CASE("energy: a blur does not change the mean brightness") {
  ForRandomCases(120, [](Random* random) {
    const double radius = RandomRadius(random->Int(0, 3) == 0 ? 7 : 4, random);
    const int side = 2 * (int(radius) + 16) + 16, mean = random->Int(20, 235);
    Case of = FlatCase(side, side, radius, random);
    // The range of levels leaves room for the overshoot of the filters of layers, so that nothing
    // is clipped.
    const int amplitude = std::max(1, int(std::min(mean, 255 - mean) / 1.8));
    CAPTURES(of.Text(), mean);
    CHECK(std::fabs(MeanChange(mean, amplitude, radius, &of, random)) <= 0.05);
  });
}

// Views that are shifted by half a pixel have the largest rounding errors.
TEST_CASE("energy: pictures are neither brighter nor darker on average") {
  for (const starfocus_mode mode : test::kModes) {
    for (const double radius : {0.5, 1.0, 1.5, 3.03125, 4.5, 6.25}) {
      constexpr int kRounds = 40;
      double sum = 0;
      for (int round = 0; round < kRounds; ++round) {
        Random random(uint64_t(round) + 1);
        const int side = 2 * (int(radius) + 16) + 16;
        Case of;
        of.scene = test::EmptyScene(side, side, 1, 0, 0);
        of.config = test::ConfigFor(of.scene, 7);
        of.params = test::Params(radius, 1, mode);
        sum += MeanChange(108 + round, 60, radius, &of, &random);
      }
      CAPTURES(mode, radius);
      CHECK(std::fabs(sum / kRounds) < 0.02);
    }
  }
}

// Returns the largest overshoot of a step as a share of the step. Overshoot exists because the
// resampling filters have negative lobes. Without blur, subsampling by two layers and upsampling
// again overshoots by 0.144. Blur removes most of the overshoot, and removes more from radius 4
// than from radius 3. Apertures steeper than the default are nearly pinholes, whose blur does not
// remove the overshoot.
double MostOvershoot(const Case& of) {
  const bool steep = of.params.theta > test::Params(0).theta;
  if (of.params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN && of.Radius() >= 4)
    return steep ? 0.1 : 0.02;
  return steep ? 0.144 : 0.03;
}

TEST_CASE("steps: a blurred step between two levels is monotone and hardly overshoots") {
  ForRandomCases(400, [](Random* random) {
    const int length = random->Int(8, 72), across = random->Int(1, 20);
    const bool upright = random->Int(0, 1) == 1;
    Case of = FlatCase(upright ? across : length, upright ? length : across,
                       RandomRadius(10, random), random);
    const int low = random->Int(0, 120), high = random->Int(low + 1, 255);
    const int edge = random->Int(1, length - 1);
    for (int y = 0; y < of.scene.height; ++y) {
      for (int x = 0; x < of.scene.width; ++x) {
        std::fill_n(of.scene.Pixel(0, x, y), 3, uint8_t((upright ? y : x) < edge ? low : high));
      }
    }
    CAPTURES(of.Text(), low, high, edge, upright);
    const test::Output out = Refocused(of);
    const bool positive = !MayResample(of);
    const auto light = [&](int code) { return test::LightOf(code, of.config.transfer); };
    double over = 0;  // overshoot in light, minus the rounding error of one code
    int below = 0, outside = 0;
    for (int k = 0; k < length; ++k) {
      const auto at = [&](int along) {
        return int{*out.Pixel(upright ? 0 : along, upright ? along : 0)};
      };
      outside += at(k) < low || at(k) > high;
      below += k > 0 && at(k) < at(k - 1);
      over = std::max({over, light(low) - light(at(k) + 1), light(at(k) - 1) - light(high)});
    }
    CHECK((!positive || (outside == 0 && below == 0)));
    CHECK(over <= MostOvershoot(of) * (light(high) - light(low)));
  });
}

// A scene without depth edges has no holes, so the side views must not affect the result.
TEST_CASE("side views: the side views do not affect the picture of a flat scene") {
  ForRandomCases(150, [](Random* random) {
    Case of = FlatCase(random->Int(1, 40), random->Int(1, 30), RandomRadius(8, random), random);
    SetColours(static_cast<Colours>(random->Int(0, 2)), &of.scene, random);
    const test::Output plain = Refocused(of);
    for (size_t view = 1; view < of.scene.pictures.size(); ++view) {
      for (uint8_t& sample : of.scene.pictures[view]) sample = random->Byte();
    }
    CAPTURE(of.Text());
    CHECK((Refocused(of).bytes == plain.bytes));
  });
}

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
bool UsesSubapertures(const Case& of) {
  const starfocus::Params& params = of.params;
  if (params.study.mode != STARFOCUS_MODE_FRAME || of.config.views == 1)
    return params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN;
  return params.study.renderer == STARFOCUS_RENDERER_SLICES;
}

int MostJump(const Case& of, const test::Report& a, const test::Report& b) {
  const starfocus::Params& params = of.params;
  if (params.study.mode == STARFOCUS_MODE_BLUR) return kLadderJump;
  int most = kSmoothJump;
  if (LayerOf(a) != LayerOf(b)) {
    most = params.theta == test::Params(0).theta ? kLayerJump : kLayerJumpOfTheta;
  }
  return a.n != b.n && !UsesSubapertures(of) ? std::max(most, kViewsJump) : most;
}

TEST_CASE("continuity: a small step of the lens changes no pixel much") {
  ForRandomCases(400, [](Random* random) {
    Case of = FlatCase(random->Int(8, 40), random->Int(8, 30), RandomRadius(8, random), random);
    SetColours(random->Int(0, 1) == 0 ? Colours::kSmooth : Colours::kNoise, &of.scene, random);
    const bool focus = random->Int(0, 1) == 0;
    Case other = of;
    if (focus) {
      other.params.focus += other.params.focus < 0 ? -1.0 / 64 : 1.0 / 64;
    } else {
      of.params.aperture = random->Real(0.1, 1);
      other.params.aperture = of.params.aperture * (1 - 1.0 / 256);
    }
    FitBlur(&of);
    FitBlur(&other);
    test::Report report_a, report_b;
    const test::Output a = Refocused(of, &report_a), b = Refocused(other, &report_b);
    double jump = 0;
    for (size_t i = 0; i < a.bytes.size(); ++i) {
      jump = std::max(jump, std::fabs(test::LightOf(a.bytes[i], of.config.transfer) -
                                      test::LightOf(b.bytes[i], of.config.transfer)));
    }
    CAPTURES(of.Text(), report_a.n, report_b.n, LayerOf(report_a), LayerOf(report_b));
    CHECK(jump <= MostJump(of, report_a, report_b));
  });
}

// Mirroring, rotating or transposing a light field of whole blocks mirrors, rotates or transposes
// the result.
TEST_CASE("symmetry: mirrored, rotated or transposed light fields give such pictures") {
  ForRandomCases(300, [](Random* random) {
    Case of = RandomCase({20, 6, 6}, random);
    const bool strands = of.strands;
    of.scene = test::EmptyScene(32 * random->Int(1, 3), random->Int(0, 3) == 0 ? 64 : 32,
                                of.scene.views(), of.scene.disparity_min, of.scene.disparity_max);
    SetDepth(static_cast<Depth>(random->Int(0, 4)), &of.scene, random);
    SetColours(static_cast<Colours>(random->Int(0, 2)), &of.scene, random);
    of.config.width = of.scene.width;
    of.config.height = of.scene.height;
    of.config.superblock = 32;
    // subsampling starts at the left and the top, so layers are not symmetric
    of.config.tuning.max_layer = 0;
    // Among equally near pixels, coverage uses the first pixel in row order, which is not
    // symmetric. With the disparity range of strands, several pixels are often at the same smallest
    // distance.
    if (strands) of.config.features &= ~STARFOCUS_FEATURE_COVERAGE;
    // Polygons and cat's eyes are not symmetric.
    if (of.params.shape == STARFOCUS_SHAPE_POLYGON) of.params.shape = STARFOCUS_SHAPE_DISC;
    of.params.cats_eye = 0;
    const test::Symmetry symmetry = {random->Int(0, 1) == 1, random->Int(0, 1) == 1,
                                     random->Int(0, 1) == 1};
    Case other = of;
    other.scene = test::Move(symmetry, of.scene);
    other.config.width = other.scene.width;
    other.config.height = other.scene.height;
    const test::Output plain = Refocused(of), moved = Refocused(other);
    const test::Distance distance = test::Compare(symmetry, of.scene.width, of.scene.height,
                                                  plain.bytes.data(), moved.bytes.data());
    CAPTURES(of.Text(), symmetry.transpose, symmetry.mirror_x, symmetry.mirror_y);
    // With wide subapertures, all views are rendered along rows first. On a single surface, the
    // order of rows and columns affects only the rounding. Next to a depth edge, the order of rows
    // and columns determines which surface is visible.
    const bool wide = of.params.study.mode != STARFOCUS_MODE_BLUR && UsesSubapertures(of);
    if (!wide || !symmetry.transpose) {
      CHECK(distance.samples == 0);
      return;
    }
    const auto ends = std::minmax_element(of.scene.disparity.begin(), of.scene.disparity.end());
    if (*ends.first == *ends.second) {
      CHECK(distance.largest <= 1);
      CHECK(distance.mean < 0.06);
    }
  });
}

}  // namespace
}  // namespace known_results_slow_test
