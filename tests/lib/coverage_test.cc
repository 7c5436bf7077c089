// SPDX-License-Identifier: Apache-2.0
// Tests given coverage, which takes precedence over a map that is wrong by several pixels, and thin
// structures, whose coverage is found. Pictures are compared with the mean over the lens of the
// light that a scene sends.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace coverage_test {
namespace {

constexpr int kWidth = 160, kHeight = 144;
constexpr double kNear = 6, kFar = -6;

// A subject in front of a wall: strands thinner than a pixel, whose map has the disparity at the
// centre of each pixel, or a comb of bars with given coverage, whose map is a solid block that is
// too small by kOff pixels.
enum class Subject { kStrands, kComb };
constexpr int kLeft = 50, kRight = 110, kTop = 40, kBottom = 104, kOff = 3;

// Returns the part of the pixel at (x, y) of the centre view that the strands cover. The strands,
// in the middle rows of the picture, lean to both sides.
double StrandsAt(double x, double y) {
  constexpr double kThick = 0.9;  // thickness of a strand in pixels
  double left = 1;
  for (int k = 0; k < 24; ++k) {
    const double lean = k % 2 == 0 ? 0.23 : -0.31, at = 44 + 3 * k + lean * (y - kHeight / 2.0);
    if (std::abs(y - kHeight / 2.0) > 44) continue;
    const double beside = std::abs(x - at) / std::sqrt(1 + lean * lean);
    left *= 1 - std::clamp((1 + kThick) / 2 - beside, 0.0, std::min(1.0, kThick));
  }
  return 1 - left;
}

// The last column of each bar is half covered.
double CombAt(double x, double y) {
  const int column = int(std::lround(x)), row = int(std::lround(y));
  if (column < kLeft || column >= kRight || row < kTop || row >= kBottom) return 0;
  const int k = (column - kLeft) % 9;
  return k < 4 ? 1 : k == 4 ? 0.5 : 0;
}

double CoverageAt(Subject subject, double x, double y) {
  return subject == Subject::kStrands ? StrandsAt(x, y) : CombAt(x, y);
}

// NearAt returns the light of the dark subject. WallAt returns the light of a bright wall with
// large soft waves.
double NearAt(int c) { return 60 - 12 * c; }
double WallAt(double x, double y, int c) {
  return 170 + 12 * c + 25 * std::sin(x / 19 + c) + 20 * std::cos(y / 23);
}

// Returns the light of a pixel that passes the lens at (u, v), if the lens is focused at the
// disparity `focus`.
double LightAt(Subject subject, int x, int y, int c, double u, double v, double focus) {
  const double near = kNear - focus, far = kFar - focus;
  const double coverage = CoverageAt(subject, x + u * near, y + v * near);
  return coverage * NearAt(c) + (1 - coverage) * WallAt(x + u * far, y + v * far, c);
}

test::Scene SceneOf(Subject subject, int views) {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, views, float(kFar), float(kNear));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int view = 0; view < views; ++view) {
        const starfocus_position at = scene.PositionOf(view);
        for (int c = 0; c < 3; ++c) {
          scene.Pixel(view, x, y)[c] =
              uint8_t(std::lround(LightAt(subject, x, y, c, at.u, at.v, 0)));
        }
      }
      const bool in_block =
          x >= kLeft + kOff && x < kRight - kOff && y >= kTop + kOff && y < kBottom - kOff;
      const bool near = subject == Subject::kComb ? in_block : StrandsAt(x, y) > 0.5;
      scene.Disparity(x, y) = float(near ? kNear : kFar);
      if (subject == Subject::kComb)
        scene.coverage.push_back(uint8_t(std::lround(255 * CombAt(x, y))));
    }
  }
  return scene;
}

test::Config ConfigOf(const test::Scene& scene, bool coverage = true) {
  test::Config config = test::ConfigFor(scene, kNear - kFar);
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.superblock = 64;
  if (!coverage) config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  return config;
}

// Returns parameters for block mode with a disc as the opening.
starfocus::Params ThroughDisc(double focus) {
  starfocus::Params params = test::Params(focus, 1, STARFOCUS_MODE_BLOCK);
  params.shape = STARFOCUS_SHAPE_DISC;
  return params;
}

// Returns the expected picture: the mean of LightAt over positions in a disc.
std::vector<double> TruthOf(Subject subject, double focus) {
  std::vector<double> truth(3 * kWidth * kHeight, 0.0);
  constexpr int kSteps = 7;
  double count = 0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      if (i * i + j * j > kSteps * kSteps) continue;
      ++count;
      for (size_t n = 0; n < truth.size(); ++n) {
        const int x = int(n / 3 % kWidth), y = int(n / 3 / kWidth);
        truth[n] +=
            LightAt(subject, x, y, int(n % 3), i / double(kSteps), j / double(kSteps), focus);
      }
    }
  }
  for (double& value : truth) value /= count;
  return truth;
}

// Returns the PSNR in dB of the inner part of the picture; near the rim, the views lack data.
double PsnrOf(const test::Output& out, const std::vector<double>& truth) {
  double sum = 0, count = 0;
  for (int y = 16; y < kHeight - 16; ++y) {
    for (int x = 16; x < kWidth - 16; ++x) {
      for (int c = 0; c < 3; ++c, ++count) {
        const double error = out.Pixel(x, y)[c] - truth[size_t(3 * (y * kWidth + x) + c)];
        sum += error * error;
      }
    }
  }
  return 10 * std::log10(255 * 255 * count / sum);
}

// Returns the largest difference between two pictures.
int LargestChange(const test::Output& a, const test::Output& b) {
  int most = 0;
  for (size_t n = 0; n < a.bytes.size(); ++n)
    most = std::max(most, std::abs(a.bytes[n] - b.bytes[n]));
  return most;
}

TEST_CASE("coverage: the PSNR is higher with coverage, at a sharp and at a blurred wall") {
  const struct {
    Subject subject;
    double focus, gain;  // smallest gain of PSNR, in dB
    std::vector<int> views;
  } kRows[] = {{Subject::kStrands, kFar, 6, {1, 5}},
               {Subject::kStrands, kNear, 10, {1, 5}},
               {Subject::kComb, kFar, 14, {1}}};
  for (const auto& row : kRows) {
    const std::vector<double> truth = TruthOf(row.subject, row.focus);
    const starfocus::Params params = ThroughDisc(row.focus);
    for (const int views : row.views) {
      const test::Scene scene = SceneOf(row.subject, views);
      const double with = PsnrOf(test::OutputOf(ConfigOf(scene), params, scene), truth);
      const double without = PsnrOf(test::OutputOf(ConfigOf(scene, false), params, scene), truth);
      CAPTURES(int(row.subject), views, row.focus);
      MESSAGE("PSNR without and with coverage ", without, " and ", with, " dB");
      CHECK(with > without + row.gain);
    }
  }
}

TEST_CASE("coverage: given coverage is ignored without the feature, and checked with it") {
  const test::Scene scene = SceneOf(Subject::kComb, 1);
  const starfocus::Params params = ThroughDisc(kFar);
  test::Scene bare = scene;
  bare.coverage.clear();
  CHECK((test::OutputOf(ConfigOf(scene, false), params, scene).bytes ==
         test::OutputOf(ConfigOf(scene, false), params, bare).bytes));
  test::Config config = ConfigOf(scene);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  starfocus_light_field field = scene.Field();
  int32_t consumed = 0;
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  REQUIRE(starfocus_stream_push(engine.get(), &field, 4, &consumed) == STARFOCUS_OK);
  field = scene.Field(4);
  field.coverage = nullptr;
  CHECK(starfocus_stream_push(engine.get(), &field, 4, &consumed) == STARFOCUS_ERROR_STATE);
  CHECK(consumed == 0);
  test::Output out(kWidth, kHeight);
  const auto refocus = [&](const uint8_t* coverage, size_t stride) {
    field = scene.Field();
    field.coverage = coverage;
    field.coverage_stride = stride;
    return test::RefocusRgb(engine.get(), &params, &field, out.bytes.data(), out.stride, nullptr);
  };
  CHECK(refocus(scene.coverage.data(), kWidth - 1) == STARFOCUS_ERROR_STRIDE);
  CHECK(refocus(out.bytes.data(), kWidth) == STARFOCUS_ERROR_OVERLAP);
}

// Returns the scene at twice the size, with doubled disparities. Each pixel becomes 2x2 pixels,
// which vary in coverage.
test::Scene Doubled(const test::Scene& scene) {
  test::Scene doubled = test::EmptyScene(2 * kWidth, 2 * kHeight, 1, 2 * scene.disparity_min,
                                         2 * scene.disparity_max);
  for (int y = 0; y < doubled.height; ++y) {
    for (int x = 0; x < doubled.width; ++x) {
      std::copy_n(scene.Pixel(0, x / 2, y / 2), 3, doubled.Pixel(0, x, y));
      doubled.Disparity(x, y) = 2 * scene.Disparity(x / 2, y / 2);
      const int mean = scene.coverage[size_t(y / 2 * kWidth + x / 2)];
      const int more = mean < 5 || mean > 250 ? 0 : 5 * (x % 2 == y % 2 ? 1 : -1);
      doubled.coverage.push_back(uint8_t(mean + more));
    }
  }
  return doubled;
}

TEST_CASE("coverage: each preview pixel has the mean coverage of 2x2 pixels") {
  const test::Scene scene = SceneOf(Subject::kComb, 1), doubled = Doubled(scene);
  test::Config config = ConfigOf(doubled);
  config.max_blur = 4 * kNear;
  config.previews = 1;
  test::Engine engine(config);
  test::PreparedMemory memory(engine);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), doubled.Field());
  starfocus::Params params = ThroughDisc(2 * kFar);
  test::Output preview(kWidth, kHeight);
  REQUIRE(test::PreviewRgb(engine.get(), &params, prepared, 1, preview.bytes.data(), preview.stride,
                           nullptr) == STARFOCUS_OK);
  params.focus = kFar;
  CHECK((preview.bytes == test::OutputOf(ConfigOf(scene), params, scene).bytes));
}

TEST_CASE("coverage: without blur, the picture does not change even if the coverage is random") {
  test::Scene scene = SceneOf(Subject::kComb, 1);
  test::Random random(3);
  for (uint8_t& coverage : scene.coverage) coverage = random.Byte();
  starfocus::Params params = ThroughDisc(0);
  params.aperture = 0.001;
  CHECK((test::OutputOf(ConfigOf(scene), params, scene).bytes == scene.pictures[0]));
}

// Returns the scene of strands with colours on both sides of every limit: from right to left, the
// wall gets the colour of the strands, and the pixels have grain.
test::Scene Grainy(int views, test::Random* random) {
  test::Scene scene = SceneOf(Subject::kStrands, views);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (scene.Disparity(x, y) > 0) scene.Disparity(x, y) += float(random->Real(-0.5, 0));
      for (int view = 0; view < views; ++view) {
        const double grain = random->Real(-25, 25);
        for (int c = 0; c < 3; ++c) {
          uint8_t& code = scene.Pixel(view, x, y)[c];
          code = uint8_t(std::lround(NearAt(c) + (code - NearAt(c)) * x / kWidth + grain));
        }
      }
    }
  }
  return scene;
}

TEST_CASE("coverage: a change of colours or coverage by one code changes no pixel by more than 8") {
  test::Random random(18);
  std::vector<test::Scene> before, after;
  for (const int views : {1, 5}) {
    before.push_back(Grainy(views, &random));
    after.push_back(before.back());
    for (auto& picture : after.back().pictures) {
      for (uint8_t& code : picture) code = uint8_t(code + std::lround(random.Real(-1.5, 1.5)));
    }
  }
  for (const int shift : {-1, 1}) {
    before.push_back(SceneOf(Subject::kComb, 1));
    for (uint8_t& coverage : before.back().coverage) {
      coverage = uint8_t(std::clamp(coverage + random.Int(-9, 9), 1, 254));
    }
    after.push_back(before.back());
    for (uint8_t& coverage : after.back().coverage) coverage = uint8_t(coverage + shift);
  }
  for (size_t k = 0; k < before.size(); ++k) {
    for (const double focus : {kFar, 0.0, kNear}) {
      const starfocus::Params params = ThroughDisc(focus);
      const test::Output one = test::OutputOf(ConfigOf(before[k]), params, before[k]);
      const test::Output other = test::OutputOf(ConfigOf(after[k]), params, after[k]);
      CAPTURES(k, focus);
      CHECK(LargestChange(one, other) <= 8);
    }
  }
}

TEST_CASE("coverage: the wall ends where coverage ends, even deep inside a silhouette") {
  constexpr int kEdge = 88, kRadius = 40, kDark = 30, kBright = 200;
  test::Scene scene = test::EmptyScene(192, 96, 1, 0, kRadius);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      scene.coverage.push_back(x < kEdge ? 255 : 0);
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(x < kEdge ? kDark : kBright));
      // The disparities form a ramp inside the near surface, as in maps of neural networks.
      const double near = std::clamp((kEdge - kOff - x) / 8.0, 0.0, 1.0);
      scene.Disparity(x, y) = float(near * kRadius);
    }
  }
  test::Config config = ConfigOf(scene);
  config.max_blur = kRadius;
  const test::Output out = test::OutputOf(config, ThroughDisc(0), scene);
  double most = 0;
  for (int x = kEdge - kRadius; x < kEdge; ++x) {
    const double to_edge = kEdge - 0.5 - x, angle = std::acos(to_edge / kRadius);
    const double wall = (angle - std::sin(angle) * std::cos(angle)) / std::acos(-1.0);
    const double truth = kDark + wall * (kBright - kDark);
    most = std::max(most, std::fabs(out.Pixel(x, scene.height / 2)[1] - truth));
  }
  CHECK(most < 2);
}

TEST_CASE("coverage: coverage that is too small leaves hardly an outline at far focus") {
  constexpr int kEdge = 80;
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 1, 0, 6);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      // The last far column shows the dark near surface, but its coverage is only a quarter.
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(x >= kEdge - 1 ? 20 : 200));
      scene.Disparity(x, y) = x >= kEdge ? 6 : 0;
      scene.coverage.push_back(x >= kEdge ? 255 : x == kEdge - 1 ? 64 : 0);
    }
  }
  // Without the larger share, the far surface would have level 23 in the last far column.
  test::Config config = test::ConfigFor(scene, 32);
  config.tuning.gather = config.tuning.max_layer = 0;
  config.transfer = STARFOCUS_TRANSFER_NONE;
  const test::Output out = test::OutputOf(config, test::Params(0, 1, STARFOCUS_MODE_BLOCK), scene);
  const auto level = [&](int x) { return int{*out.Pixel(x, kHeight / 2)}; };
  CHECK(level(kEdge - 1) >= 55);
  CHECK(level(kEdge) <= level(kEdge - 1) + 15);
}

// Side of the square picture; the surface covers the columns and rows from kSurfaceFirst to
// kSurfaceLast - 1.
constexpr int kSide = 160, kSurfaceFirst = 40, kSurfaceLast = 120;
// Length in pixels of the hairs above the surface.
constexpr int kHair = 10;

// Green of the surface and of the wall behind it. Light of the wall raises the surface's green.
constexpr uint8_t kSurfaceGreen = 40, kWallGreen = 250;

enum class Outline {
  kSharp,  // a square
  kHairy,  // a square with hairs, whose coverage is found
  kGiven   // a square with hairs, whose coverage is given
};

struct Surface {
  double jitter, slope;  // of the disparities, in pixels and in pixels per column
  Outline outline;
};

// Returns the share of a pixel that the surface covers. Every other column above the surface is a
// hair, and the columns between hairs are covered in part.
double CoverageAt(int x, int y, Outline outline) {
  if (x < kSurfaceFirst || x >= kSurfaceLast || y < kSurfaceFirst - kHair || y >= kSurfaceLast)
    return 0;
  if (y >= kSurfaceFirst) return 1;
  if (outline == Outline::kSharp) return 0;
  return x % 2 == 0 ? 0.7 : 0.3;
}

// Returns a surface of random red and constant green in front of a wall.
test::Scene SurfaceBefore(const Surface& surface, int views, uint64_t seed) {
  test::Scene scene = test::EmptyScene(kSide, kSide, views, -6, 8);
  test::Random random(seed);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double coverage = CoverageAt(x, y, surface.outline);
      const double disparity =
          2 + surface.slope * (x - kSurfaceFirst) + random.Real(-surface.jitter, surface.jitter);
      const auto mixed = [&](double near, double far) {
        return uint8_t(coverage * near + (1 - coverage) * far + 0.5);
      };
      scene.Disparity(x, y) = float(coverage > 0.5 ? disparity : -6);
      const uint8_t red = mixed(random.Real(0, 255), 250);
      for (int view = 0; view < views; ++view) {
        uint8_t* const pixel = scene.Pixel(view, x, y);
        pixel[0] = red;
        pixel[1] = mixed(kSurfaceGreen, kWallGreen);
        pixel[2] = mixed(40, 250);
      }
      if (surface.outline == Outline::kGiven) scene.coverage.push_back(mixed(255, 0));
    }
  }
  return scene;
}

// Returns the largest difference from the green of the surface in the area that the blur of other
// colours does not reach.
int MostLeaked(const test::Output& out, int blur) {
  int most = 0;
  for (int y = kSurfaceFirst + blur; y < kSurfaceLast - blur; ++y) {
    for (int x = kSurfaceFirst + blur; x < kSurfaceLast - blur; ++x) {
      most = std::max(most, std::abs(out.Pixel(x, y)[1] - kSurfaceGreen));
    }
  }
  return most;
}

TEST_CASE("coverage: a surface with noisy or sloping disparities lets no light through") {
  // Steps between neighbours are up to twice the jitter plus the slope: at most 3/4 pixel.
  int seed = 0;
  for (const double jitter : {0.05, 0.12, 0.24, 0.34}) {
    for (const double slope : {0.0, 0.02}) {
      for (const Outline outline : {Outline::kSharp, Outline::kHairy, Outline::kGiven}) {
        for (const int views : {1, 5}) {
          const test::Scene scene =
              SurfaceBefore({jitter, slope, outline}, views, uint64_t(++seed));
          test::Config config = test::ConfigFor(scene, 16);
          config.features |= STARFOCUS_FEATURE_COVERAGE;
          test::Engine engine(config);
          for (const double focus : {-6.0, -2.0, 2.5, 5.0, 9.0}) {
            for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
              CAPTURES(jitter, slope, int(outline), views, seed, focus, mode);
              starfocus::Params params = test::Params(focus, 1, mode, STARFOCUS_RENDERER_SLICES);
              const test::Output out = test::OutputOf(&engine, params, scene);
              const int blur = int(std::max(std::abs(focus - 2), std::abs(focus - 4))) + 9;
              CHECK(MostLeaked(out, blur) <= 1);
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace coverage_test
