// The engine against the double-precision reference: at most one gray level apart anywhere.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/reference.h"
#include "tests/test_scene.h"
#ifdef STARFOCUS_PROGRAM
#include "platform/light_field.h"
#endif

namespace {

constexpr double kMeanLimit = 0.3;
// Smaller pictures are judged by the mean over all of them: one level in one sample of a single
// pixel is a third on average.
constexpr size_t kEnoughSamples = 300;

struct Distance {
  int largest = 0;       // of bytes
  double unrounded = 0;  // largest, engine's byte to the reference's value
  double sum = 0;        // of bytes
  double samples = 0;
  double worst_mean = 0;  // of a picture with enough samples

  double mean() const { return samples == 0 ? 0 : sum / samples; }

  void Add(const Distance& other) {
    largest = std::max(largest, other.largest);
    unrounded = std::max(unrounded, other.unrounded);
    if (other.samples >= kEnoughSamples) worst_mean = std::max(worst_mean, other.mean());
    sum += other.sum;
    samples += other.samples;
  }

  void Print(const char* name) const {
    std::printf("%s: %.0f samples, largest difference %d (%.3f unrounded), mean %.4f, worst %.4f\n",
                name, samples, largest, unrounded, mean(), worst_mean);
  }
};

Distance Compare(const std::vector<uint8_t>& bytes, const std::vector<double>& exact) {
  REQUIRE(bytes.size() == exact.size());
  Distance distance;
  for (size_t i = 0; i < bytes.size(); ++i) {
    const int difference = std::abs(int(bytes[i]) - int(std::floor(exact[i] + 0.5)));
    distance.largest = std::max(distance.largest, difference);
    distance.unrounded = std::max(distance.unrounded, std::fabs(bytes[i] - exact[i]));
    distance.sum += difference;
  }
  distance.samples = double(bytes.size());
  return distance;
}

// Refocuses with both and checks their distance.
Distance Check(const test::Scene& scene, const sf_params& params, int block, double theta) {
  sf_config config = test::ConfigFor(scene, 16);
  config.largest_block = block;
  config.theta = theta;
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  test::Output out(scene.width, scene.height);
  sf_report report;
  REQUIRE(test::Refocus(&engine, params, scene, &out, nullptr, nullptr, &report) == SF_OK);
  const reference::Result expected = reference::Refocus(scene, params, theta, block);
  CAPTURE(scene.width);
  CAPTURE(scene.height);
  CAPTURE(scene.views());
  CAPTURE(scene.disparity_min);
  CAPTURE(scene.disparity_max);
  CAPTURE(params.mode);
  CAPTURE(params.focus);
  CAPTURE(params.aperture);
  CAPTURE(block);
  CHECK(report.n == expected.n);
  CHECK(report.rendered_views == expected.views);
  const Distance distance = Compare(out.Tight(), expected.rgb);
  CHECK(distance.largest <= 1);
  if (distance.samples >= kEnoughSamples) CHECK(distance.mean() < kMeanLimit);
  return distance;
}

Distance Check(const test::Scene& scene, const sf_params& params, int block = 32) {
  return Check(scene, params, block, 0.26 * 3.14159265358979323846);
}

enum class Depth { kConstant, kPiecewise, kSlanted, kNoisy };
enum class Colours { kRandom, kExtreme, kSmooth };

void SetDepth(Depth depth, test::Scene* scene, test::Random* random) {
  const double low = scene->disparity_min, high = scene->disparity_max;
  if (depth == Depth::kPiecewise) return test::RandomDisparity(scene, random);
  if (depth == Depth::kNoisy) return test::NoisyDisparity(scene, random);
  const double base = random->Real(low, high);
  const double dx = depth == Depth::kConstant ? 0 : random->Real(-0.3, 0.3);
  const double dy = depth == Depth::kConstant ? 0 : random->Real(-0.3, 0.3);
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) {
      scene->Disparity(x, y) =
          std::clamp(float(base + dx * x + dy * y), scene->disparity_min, scene->disparity_max);
    }
  }
}

void SetColours(Colours colours, test::Scene* scene, test::Random* random) {
  for (auto& picture : scene->pictures) {
    int level = random->Int(0, 255);
    for (uint8_t& sample : picture) {
      level = std::clamp(level + random->Int(-9, 9), 0, 255);
      sample = colours == Colours::kRandom    ? random->Byte()
               : colours == Colours::kExtreme ? uint8_t(random->Int(0, 1) * 255)
                                              : uint8_t(level);
    }
  }
}

struct Range {
  float low, high;
};

// The reference is slow, and an emulator needs twenty times as long.
constexpr int kSizes[][2] = {
    {1, 1}, {7, 5}, {40, 33}, {STARFOCUS_EMULATED ? 48 : 96, STARFOCUS_EMULATED ? 40 : 64}};
constexpr int kStars[] = {1, 5, 9, 17};
constexpr Depth kDepths[] = {Depth::kConstant, Depth::kPiecewise, Depth::kSlanted, Depth::kNoisy};

test::Scene MakeScene(int width, int height, int views, Depth depth, Range range,
                      test::Random* random) {
  test::Scene scene = test::EmptyScene(width, height, views, range.low, range.high);
  SetDepth(depth, &scene, random);
  SetColours(Colours(random->Int(0, 2)), &scene, random);
  return scene;
}

// A focus for which the blur radius reaches 2 to 9 pixels.
sf_params RandomLens(const test::Scene& scene, sf_mode mode, double r_max, test::Random* random) {
  const double aperture = random->Int(0, 2) == 0 ? 1 : random->Real(0.3, 1);
  const double reach = r_max / aperture;
  const double half = 0.5 * double(scene.disparity_max - scene.disparity_min);
  const double centre = 0.5 * double(scene.disparity_min + scene.disparity_max);
  const double offset = std::max(0.0, reach - half);
  return test::Params(centre + (random->Int(0, 1) == 0 ? offset : -offset), aperture, mode);
}

TEST_CASE("conformance: random scenes, every star set, both modes") {
  Distance all[2];
  for (const sf_mode mode : {SF_MODE_FRAME, SF_MODE_BENCHMARK}) {
    test::Random random(41 + uint64_t(mode));
    for (const auto& size : kSizes) {
      for (const int views : kStars) {
        for (const Depth depth : kDepths) {
          const double low = random.Real(-4, 3);
          const Range range = {float(low), float(low + random.Real(0.5, 5))};
          const test::Scene scene = MakeScene(size[0], size[1], views, depth, range, &random);
          const double r_max = mode == SF_MODE_FRAME ? random.Real(2, 9) : random.Real(1, 5);
          all[mode].Add(Check(scene, RandomLens(scene, mode, r_max, &random)));
        }
      }
    }
  }
  all[SF_MODE_FRAME].Print("random scenes, frame");
  all[SF_MODE_BENCHMARK].Print("random scenes, benchmark");
  CHECK(all[SF_MODE_FRAME].mean() < kMeanLimit);
  CHECK(all[SF_MODE_BENCHMARK].mean() < kMeanLimit);
}

TEST_CASE("conformance: many small scenes") {
  constexpr int kSmall = STARFOCUS_EMULATED ? 24 : 36;
  Distance all;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    test::Random random(1000 + seed);
    const double low = random.Real(-6, 5);
    const Range range = {float(low), float(low + random.Real(0, 7))};
    const test::Scene scene =
        MakeScene(random.Int(1, kSmall), random.Int(1, kSmall), kStars[random.Int(0, 3)],
                  kDepths[random.Int(0, 3)], range, &random);
    const sf_mode mode = random.Int(0, 3) == 0 ? SF_MODE_BENCHMARK : SF_MODE_FRAME;
    const double r_max = mode == SF_MODE_FRAME ? random.Real(0.1, 9) : random.Real(0.1, 4);
    CAPTURE(seed);
    all.Add(Check(scene, RandomLens(scene, mode, r_max, &random)));
  }
  all.Print("small scenes");
  CHECK(all.mean() < kMeanLimit);
}

TEST_CASE("conformance: blocks of 64, widest and narrowest aperture") {
  Distance all;
  for (const double theta : {SF_MIN_THETA, SF_MAX_THETA}) {
    for (const int views : kStars) {
      test::Random random(77 + uint64_t(views));
      const test::Scene scene = MakeScene(96, 64, views, Depth::kPiecewise, Range{-2, 3}, &random);
      all.Add(Check(scene, test::Params(0.7), 64, theta));
      all.Add(Check(scene, test::Params(-1.9, 0.8), 64, theta));
    }
  }
  all.Print("blocks of 64");
}

#ifdef STARFOCUS_PROGRAM
// The rectangle at (x0, y0) of a data set.
test::Scene Crop(const starfocus::LightField& field, int x0, int y0, int width, int height) {
  float low = field.disparity.at(x0, y0), high = low;
  test::Scene scene = test::EmptyScene(width, height, int(field.views.size()), low, high);
  for (int y = 0; y < height; ++y) {
    for (int view = 0; view < scene.views(); ++view) {
      const starfocus::Image& picture = field.views[size_t(view)];
      std::copy_n(picture.pixels.data() + size_t(y0 + y) * picture.stride() + size_t(3 * x0),
                  3 * width, scene.Pixel(view, 0, y));
    }
    for (int x = 0; x < width; ++x) {
      const float disparity = field.disparity.at(x0 + x, y0 + y);
      scene.Disparity(x, y) = disparity;
      low = std::min(low, disparity);
      high = std::max(high, disparity);
    }
  }
  scene.disparity_min = low;
  scene.disparity_max = high;
  return scene;
}

TEST_CASE("conformance: parts of the data set wires") {
  const std::string folder = test::DataSet("wires");
  if (folder.empty()) return;
  starfocus::LightField field;
  REQUIRE(starfocus::LoadLightField(folder, 0, &field) == "");
  Distance all;
  for (const int x : {0, 192, 384}) {
    const test::Scene scene = Crop(field, x, 128, 128, 128);
    for (const double focus : {0.0, 3.0, 7.0}) all.Add(Check(scene, test::Params(focus), 64));
  }
  const test::Scene scene = Crop(field, 200, 100, 64, 64);
  all.Add(Check(scene, test::Params(3, 1, SF_MODE_BENCHMARK), 64));
  all.Print("wires");
}
#endif

}  // namespace
