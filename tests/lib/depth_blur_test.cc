// SPDX-License-Identifier: Apache-2.0
// Compares the blur mode with an adaptive convolution by the ideal PSF (4) in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "lib/gather/gather.h"
#include "lib/optics/view_weights.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/reference_blur.h"
#include "tests/support/config.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"
#include "tests/support/transfer_curve.h"

namespace depth_blur_test {
namespace {

using reference::kOne;
static_assert(kOne == 1 << starfocus::kDisparityBits, "the same scale");

// Returns the reference of a blurred picture, with samples that are not rounded. PSFs of pixels
// behind the focus are rotated by 180 degrees.
std::vector<double> Reference(const test::Scene& scene, const starfocus::Params& params,
                              const reference::ApertureShape& opening, int transfer) {
  double light[256];
  for (int code = 0; code < 256; ++code) light[code] = test::LightOf(code, transfer);
  std::vector<double> out;
  const int focus = int(std::floor(params.focus * kOne + 0.5));
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const int signed_distance = int(std::floor(scene.Disparity(x, y) * kOne + 0.5f)) - focus;
      const int distance = std::abs(signed_distance), side = signed_distance < 0 ? -1 : 1;
      const double r = reference::NearestRadius(int(std::floor(params.aperture * distance)));
      const reference::Psf& kernel = reference::PsfOf(r, opening);
      double sums[3] = {0, 0, 0};
      for (int m = -kernel.size; m <= kernel.size; ++m) {
        for (int n = -kernel.size; n <= kernel.size; ++n) {
          const uint8_t* pixel = scene.Pixel(0, std::clamp(x + n, 0, scene.width - 1),
                                             std::clamp(y + m, 0, scene.height - 1));
          const double weight = kernel.At(side * n, side * m);
          for (int c = 0; c < 3; ++c) sums[c] += weight * light[pixel[c]];
        }
      }
      for (const double sum : sums) out.push_back(test::CodeOf(sum, transfer));
    }
  }
  return out;
}

std::vector<uint8_t> Blurred(const test::Scene& scene, double focus, double aperture, int block,
                             double theta, int transfer, const test::NamedShape* shape = nullptr) {
  test::Config config = test::ConfigFor(scene, 40);
  config.superblock = block;
  config.transfer = transfer;
  starfocus::Params params = test::Params(focus, aperture, STARFOCUS_MODE_BLUR);
  params.theta = theta;
  if (shape != nullptr) shape->Set(&params);
  test::ReserveFor(params, &config);
  test::Engine engine(config);
  test::Output out(scene.width, scene.height, 3);
  REQUIRE(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
  CHECK(out.PaddingUntouched());
  return out.Tight();
}

constexpr double kTheta = 0.26 * 3.14159265358979323846;

// Returns the largest difference from the rounded reference, with either transfer function.
double Difference(const test::Scene& scene, double focus, double aperture, int block,
                  double theta = kTheta) {
  double largest = 0;
  for (const int transfer : {STARFOCUS_TRANSFER_NONE, STARFOCUS_TRANSFER_SRGB}) {
    const std::vector<uint8_t> got = Blurred(scene, focus, aperture, block, theta, transfer);
    const std::vector<double> expected =
        Reference(scene, test::Params(focus, aperture, STARFOCUS_MODE_BLUR), theta, transfer);
    for (size_t i = 0; i < got.size(); ++i) {
      largest = std::max(largest, std::abs(got[i] - std::floor(expected[i] + 0.5)));
    }
  }
  return largest;
}

// Checks flat disparities with many radii, on random pictures and on black-and-white pictures.
// Steps between black and white are the most sensitive test of the shape of a PSF.
void CheckRadii(double theta) {
  for (const double r :
       {0.0, 0.05, 0.125, 0.4, 0.5, 0.5625, 0.625, 0.75, 0.875, 1.0,  1.3,  1.5, 1.75,
        2.0, 2.6,  3.0,   3.9, 4.0, 4.06,   5.0,   6.5,  8.0,   11.1, 16.0, 23.7}) {
    const float d = static_cast<float>(r);
    test::Scene scene = test::EmptyScene(37, 29, 1, d, d);
    test::Random random(17);
    CAPTURE(r);
    for (const bool extreme : {false, true}) {
      for (uint8_t& sample : scene.pictures[0]) {
        sample = extreme ? uint8_t(random.Int(0, 1) * 255) : random.Byte();
      }
      CHECK(Difference(scene, 0, 1, 32, theta) <= 1);
    }
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(x < 15 || y > 20 ? 255 : 0));
      }
    }
    CHECK(Difference(scene, 0, 1, 32, theta) <= 1);
  }
}

TEST_CASE("blur: flat disparities of many radii match the reference") { CheckRadii(kTheta); }
TEST_CASE("blur: the least and the steepest fall-off match the reference") {
  CheckRadii(STARFOCUS_MIN_THETA);
  CheckRadii(STARFOCUS_MAX_THETA);
}

TEST_CASE("blur: random disparities, foci, apertures, fall-offs and blocks match the reference") {
  test::Random random(18);
  for (int round = 0; round < 24; ++round) {
    test::Scene scene = test::RandomScene(random.Int(1, 70), random.Int(1, 50), 1, -6, 6,
                                          uint64_t(round) + 300, random.Int(0, 5));
    if (round % 3 == 0) test::NoisyDisparity(&scene, &random);
    const double theta = round % 4 == 0 ? random.Real(0.1, 0.4) * 3.14159 : kTheta;
    const double focus = random.Real(-8, 8), aperture = random.Int(0, 1) ? 1 : random.Real(0.1, 1);
    CAPTURES(round, theta);
    CHECK(Difference(scene, focus, aperture, 32 << random.Int(0, 3), theta) <= 1);
  }
}

TEST_CASE(
    "blur: openings of other shapes match the reference, in front of the focus and behind it") {
  for (const test::NamedShape& shape : test::kShapes) {
    starfocus::Params lens = test::Params(0);
    shape.Set(&lens);
    for (const double r : {0.5, 0.75, 1.0, 1.75, 3.0, 4.5, 8.0, 13.0}) {
      CAPTURES(shape.name, r);
      test::Random random(19);
      test::Scene scene = test::EmptyScene(34, 26, 1, -2, 2);
      for (uint8_t& sample : scene.pictures[0]) sample = uint8_t(random.Int(0, 1) * 255);
      for (float& disparity : scene.disparity) disparity = random.Int(0, 1) == 0 ? -2.0F : 2.0F;
      const double aperture = r < 1.5 ? r / 1.5 : 1, focus = r < 1.5 ? 0.5 : 2 - r;
      const std::vector<uint8_t> got =
          Blurred(scene, focus, aperture, 32, kTheta, STARFOCUS_TRANSFER_SRGB, &shape);
      const std::vector<double> expected = Reference(
          scene, test::Params(focus, aperture, STARFOCUS_MODE_BLUR), lens, STARFOCUS_TRANSFER_SRGB);
      double largest = 0;
      for (size_t i = 0; i < got.size(); ++i) {
        largest = std::max(largest, std::abs(got[i] - std::floor(expected[i] + 0.5)));
      }
      CHECK(largest <= 1);
    }
  }
}

TEST_CASE("blur: pixels in focus are copied, and a picture of one level does not change") {
  const test::Scene sharp = test::RandomScene(41, 33, 1, 2.5f, 2.5f, 7);
  CHECK(Blurred(sharp, 2.5, 1, 32, kTheta, STARFOCUS_TRANSFER_SRGB) == sharp.pictures[0]);
  for (int level = 0; level < 256; level += 5) {
    test::Scene scene = test::RandomScene(40, 35, 1, -9, 9, uint64_t(level) + 1);
    std::fill(scene.pictures[0].begin(), scene.pictures[0].end(), uint8_t(level));
    CHECK(Blurred(scene, 0.3, 1, 64, kTheta, STARFOCUS_TRANSFER_SRGB) == scene.pictures[0]);
  }
}

TEST_CASE("blur: only the centre view is read") {
  test::Scene scene = test::RandomScene(50, 40, 17, -4, 4, 19);
  const std::vector<uint8_t> before = Blurred(scene, 1, 1, 32, kTheta, STARFOCUS_TRANSFER_SRGB);
  for (size_t view = 1; view < scene.pictures.size(); ++view) {
    std::fill(scene.pictures[view].begin(), scene.pictures[view].end(), uint8_t{9});
  }
  CHECK(Blurred(scene, 1, 1, 32, kTheta, STARFOCUS_TRANSFER_SRGB) == before);
}

TEST_CASE("blur: the result does not depend on the size of blocks") {
  const test::Scene scene = test::RandomScene(150, 90, 1, -6, 6, 20);
  const std::vector<uint8_t> expected = Blurred(scene, 2, 1, 32, kTheta, STARFOCUS_TRANSFER_SRGB);
  for (const int block : {64, 128, 256})
    CHECK(Blurred(scene, 2, 1, block, kTheta, STARFOCUS_TRANSFER_SRGB) == expected);
}

TEST_CASE("blur: PSFs sum to exactly one, fit their types and decrease from the centre") {
  const double most = STARFOCUS_MAX_BLUR;
  const int steps = starfocus::PsfCount(most);
  std::vector<uint16_t> weights(starfocus::BlurWeightCount(false, most));
  std::vector<starfocus::Psf> kernels(static_cast<size_t>(steps));
  // The PSFs are made in two calls, as in an engine that later requires PSFs for larger radii.
  const uint32_t fall_off = starfocus::ApertureFallOff(kTheta);
  starfocus::MakePsfs(0, steps / 3, fall_off, nullptr, weights.data(), kernels.data());
  starfocus::MakePsfs(steps / 3, steps, fall_off, nullptr, weights.data(), kernels.data());
  for (int step = 0; step < steps; ++step) {
    const starfocus::Psf& kernel = kernels[size_t(step)];
    CAPTURE(step);
    REQUIRE(kernel.weights >= weights.data());
    const int size = kernel.size;
    REQUIRE(kernel.weights + (size + 1) * (size + 2) / 2 <= weights.data() + weights.size());
    int64_t sum = 0;
    uint32_t largest = 0;
    for (int m = -size; m <= size; ++m) {
      for (int n = -size; n <= size; ++n) {
        sum += kernel.Weight(n, m);
        largest = std::max(largest, kernel.Weight(n, m));
      }
    }
    CHECK(sum == int64_t{1} << kernel.sum_bits);
    CHECK(kernel.sum_bits >= 1);
    CHECK(kernel.sum_bits <= 24);
    CHECK(largest <= 32767);
    // The centre takes the remainder of rounding, which may be negative.
    CHECK(kernel.Weight(0, 0) + 8 >= largest);
  }
}

TEST_CASE("blur: PSFs are as wide as (4), without a second integral over pixels") {
  // The variance exceeds the variance of (4) by a quarter, or by 1/24. The variance of integrals
  // over pixels would be 0 up to a radius of 1/2, and exceed (4) by up to 0.14 above. From a
  // variance of 1/2 on, the variance oscillates around the wanted value.
  const double most = 4;
  for (const test::NamedShape& shape : test::kShapes) {
    CAPTURE(shape.name);
    starfocus::Params lens = test::Params(0, 1, STARFOCUS_MODE_BLUR);
    shape.Set(&lens);
    const starfocus::ApertureShape opening = starfocus::ShapeOf(lens);
    const int steps = starfocus::PsfCount(most);
    std::vector<uint16_t> weights(starfocus::BlurWeightCount(!opening.IsSymmetric(), most));
    std::vector<starfocus::Psf> psfs(static_cast<size_t>(steps));
    starfocus::MakePsfs(0, steps, opening, nullptr, weights.data(), psfs.data());
    const double mean_square = double(starfocus::MeanSquare(opening)) / starfocus::kOpeningOne;
    for (int step = 1; step < steps; ++step) {
      const starfocus::Psf& psf = psfs[size_t(step)];
      double squares = 0;
      for (int m = -psf.size; m <= psf.size; ++m) {
        for (int n = -psf.size; n <= psf.size; ++n) squares += psf.Weight(n, m) * (n * n + m * m);
      }
      const double r = double(starfocus::RadiusOfPsf(step)) / kOne, exact = r * r * mean_square;
      const double more = std::ldexp(squares / 2, -psf.sum_bits) - exact;
      CAPTURE(r);
      CHECK(std::fabs(more - std::min(exact / 4, 1.0 / 24)) < (exact < 0.5 ? 0.003 : 0.09));
    }
  }
}

TEST_CASE("blur: PsfIndex rounds each radius to the nearest radius that has a PSF") {
  int last = -1;
  for (int radius = 0; radius <= int(STARFOCUS_MAX_BLUR) * kOne; ++radius) {
    const int step = starfocus::PsfIndex(radius);
    REQUIRE(step >= last);
    REQUIRE(step <= last + 1);
    last = step;
  }
  CHECK(starfocus::PsfIndex(0) == 0);
  // A radius halfway between two steps of 1/8 pixel is rounded up.
  CHECK(starfocus::PsfIndex(4) == 1);
  CHECK(starfocus::PsfIndex(3) == 0);
  CHECK(starfocus::PsfIndex(4 * kOne) == 32);
  CHECK(starfocus::PsfIndex(8 * kOne) == 64);
  CHECK(starfocus::PsfIndex(128 * kOne) == 32 + 5 * 32);
  CHECK(starfocus::PsfCount(STARFOCUS_MAX_BLUR) > starfocus::PsfIndex(128 * kOne));
}

}  // namespace
}  // namespace depth_blur_test
