// SPDX-License-Identifier: Apache-2.0
// Compares subsampling and upsampling with the same separable filters in double precision.
#include "lib/io/layers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simd/kernels.h"
#include "tests/support/test_scene.h"

namespace layers_test {
namespace {

using namespace starfocus;
using namespace starfocus::simd;

constexpr double kPi = 3.14159265358979323846;
constexpr double kBetaDown = 1.28, kBetaUp = 2.17;

// Returns the modified Bessel function of the first kind, order 0.
double Bessel(double x) {
  double sum = 1, term = 1;
  for (int k = 1; k < 60; ++k) {
    term *= x * x / 4 / k / k;
    sum += term;
  }
  return sum;
}

// Returns tap n in [-3, 3]: sinc(n / 2) with a 7-tap Kaiser window. All taps sum to `gain`.
double Tap(int n, double beta, double gain) {
  const auto windowed = [&](int k) {
    const double x = kPi * k / 2, sinc = k == 0 ? 1 : k % 2 == 0 ? 0 : std::sin(x) / x;
    return sinc * Bessel(beta * std::sqrt(1 - k * k / 9.0)) / Bessel(beta);
  };
  double sum = 0;
  for (int k = -3; k <= 3; ++k) sum += windowed(k);
  return windowed(n) / sum * gain;
}

// An image of three samples per pixel in double precision. Beyond the image, the edge pixels are
// repeated.
struct Image {
  Image(int w, int h) : width(w), height(h), samples(3 * size_t(w) * size_t(h)) {}
  double& At(int x, int y, int c) {
    const size_t cx = size_t(std::clamp(x, 0, width - 1)),
                 cy = size_t(std::clamp(y, 0, height - 1));
    return samples[3 * (cy * size_t(width) + cx) + size_t(c)];
  }
  int width, height;
  std::vector<double> samples;
};

double DownTap(int k) {
  static const double taps[] = {Tap(0, kBetaDown, 1), Tap(1, kBetaDown, 1), 0,
                                Tap(3, kBetaDown, 1)};
  return taps[std::abs(k)];
}
double UpTap(int k) {
  static const double taps[] = {Tap(0, kBetaUp, 2), Tap(1, kBetaUp, 2), 0, Tap(3, kBetaUp, 2)};
  return taps[std::abs(k)];
}

// Clamps a sample to the range from 0 to 255.
double Clamped(double value) { return std::clamp(value, 0.0, 255.0); }

Image Down(Image from) {
  Image to(LayerSize(from.width, 1), LayerSize(from.height, 1));
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int j = -3; j <= 3; ++j) {
          for (int i = -3; i <= 3; ++i) {
            sum += DownTap(i) * DownTap(j) * from.At(2 * x + i, 2 * y + j, c);
          }
        }
        to.At(x, y, c) = Clamped(sum);
      }
    }
  }
  return to;
}

// Upsamples an image: inserts zeros between the samples, and filters the result.
Image Up(Image from, int width, int height) {
  Image to(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int j = -3; j <= 3; ++j) {
          for (int i = -3; i <= 3; ++i) {
            if ((x + i) % 2 != 0 || (y + j) % 2 != 0) continue;
            sum += UpTap(i) * UpTap(j) * from.At((x + i) / 2, (y + j) / 2, c);
          }
        }
        to.At(x, y, c) = Clamped(sum);
      }
    }
  }
  return to;
}

// Owns a layer in memory of exactly the required size.
struct Layer {
  Layer(int width, int height, int layer) {
    plane.width = LayerSize(width, layer);
    plane.height = LayerSize(height, layer);
    plane.rows = {0, plane.height};
    const size_t stride = 3 * size_t(plane.width), rows = size_t(plane.height);
    samples.assign(stride * rows + kPadding, 0x7123);
    plane.samples = {samples.data(), stride, 0, 0};
  }
  Layer(const Layer&) = delete;

  LayerPlane plane;
  std::vector<int16_t> samples;
};

// Returns an input that has only the centre view, without a transfer function.
starfocus::Input InputOf(const std::vector<uint8_t>& picture, int width, int height) {
  starfocus::Input input;
  input.width = width;
  input.height = height;
  input.transfer = &starfocus::TransferOf(STARFOCUS_TRANSFER_NONE);
  input.centre = {picture.data(), 3 * size_t(width), 0, 0};
  return input;
}

// Scratch memory for the columns and rows of layer 1.
struct Scratch {
  Scratch(int columns, int rows)
      : even(3 * (size_t(columns) + 3) + kPadding),
        odd(even),
        half(3 * size_t(columns) * size_t(starfocus::TapsOfLayer(rows)) + kPadding),
        above(3 * size_t(columns) * size_t(rows) + kPadding),
        memory{even.data(), odd.data(), half.data(), above.data()} {}
  Scratch(const Scratch&) = delete;

  std::vector<int16_t> even, odd, half, above;
  const starfocus::ResampleScratch memory;
};

// Layers 1 and 2 of a picture, computed in columns of superblocks as in the engine.
struct Layers {
  Layers(const std::vector<uint8_t>& picture, int width, int height, int superblock)
      : one(width, height, 1), two(width, height, 2) {
    const Scratch scratch(superblock / 2 + 16, 2 * height + 20);
    const starfocus::Input from = InputOf(picture, width, height);
    const int columns = (width + superblock - 1) / superblock;
    for (int layer = 1; layer <= 2; ++layer) {
      LayerPlane* to = layer == 1 ? &one.plane : &two.plane;
      for (int index = columns - 1; index >= 0; --index) {
        const int begin = index * (superblock >> layer);
        const int end = index + 1 == columns ? to->width : begin + (superblock >> layer);
        DownsamplePicture(BestKernels(), from, layer, {begin, end}, scratch.memory, *to);
      }
    }
  }
  Layer one, two;
};

// The samples of a layer that upsampling to width x height reads, with a margin of repeated pixels.
struct Padded {
  template <class Load>
  Padded(int layer_width, int layer_height, int width, int height, int margin, const Load& load) {
    rect.width = (width + 1) / 2 + 2 * margin;
    rect.height = (height + 1) / 2 + 2 * margin;
    samples.resize(3 * size_t(rect.width) * size_t(rect.height) + kPadding);
    rect.samples = samples.data();
    for (int y = 0; y < rect.height; ++y) {
      for (int x = 0; x < rect.width; ++x) {
        const int cx = std::clamp(x - margin, 0, layer_width - 1);
        const int cy = std::clamp(y - margin, 0, layer_height - 1);
        for (int c = 0; c < 3; ++c) {
          samples[3 * (size_t(y) * size_t(rect.width) + size_t(x)) + size_t(c)] = load(cx, cy, c);
        }
      }
    }
  }
  LayerRect rect;
  std::vector<int16_t> samples;
};

// Returns width x height samples that are upsampled from a padded layer.
std::vector<int16_t> UpByTwo(const Padded& in, int margin, int width, int height) {
  std::vector<int16_t> line(3 * size_t(in.rect.width) + kPadding), between = line, even = line;
  std::vector<int16_t> out(3 * size_t(width) * size_t(height) + kPadding);
  UpsampleByTwo(BestKernels(), in.rect, margin, {line.data(), between.data(), even.data()},
                {out.data(), width, height});
  return out;
}

// Subsamples by one or two layers, upsamples again and returns the samples.
std::vector<int16_t> DownAndUp(const std::vector<uint8_t>& picture, int width, int height,
                               int layer, int superblock) {
  const Layers layers(picture, width, height, superblock);
  const LayerPlane& plane = layer == 1 ? layers.one.plane : layers.two.plane;
  const auto load = [&](int x, int y, int c) { return plane.samples.Row(y)[3 * x + c]; };
  constexpr int kMargin = 2;
  if (layer == 1) {
    const Padded one(plane.width, plane.height, width, height, kMargin, load);
    return UpByTwo(one, kMargin, width, height);
  }
  const int w1 = layers.one.plane.width, h1 = layers.one.plane.height;
  const Padded two(plane.width, plane.height, w1, h1, kMargin, load);
  const std::vector<int16_t> middle = UpByTwo(two, kMargin, w1, h1);
  const Padded one(w1, h1, width, height, kMargin, [&](int x, int y, int c) {
    return middle[3 * (size_t(y) * size_t(w1) + size_t(x)) + size_t(c)];
  });
  return UpByTwo(one, kMargin, width, height);
}

Image ReferenceDownAndUp(const std::vector<uint8_t>& picture, int width, int height, int layer) {
  Image image(width, height);
  std::copy(picture.begin(), picture.end(), image.samples.begin());
  const Image one = Down(image);
  if (layer == 1) return Up(one, width, height);
  return Up(Up(Down(one), one.width, one.height), width, height);
}

enum Content { kRandom, kBlackOrWhite, kBoard, kStep, kStripes, kSmooth, kContents };

std::vector<uint8_t> RandomPicture(int width, int height, Content content, test::Random* random) {
  std::vector<uint8_t> picture(3 * size_t(width) * size_t(height));
  const int size = random->Int(1, 9), x0 = random->Int(0, width), y0 = random->Int(0, height);
  const double fx = random->Real(0, 0.5), fy = random->Real(0, 0.5);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        int value = random->Byte();
        if (content == kBlackOrWhite) value = value < 128 ? 0 : 255;
        if (content == kBoard) value = (x / size + y / size + c) % 2 * 255;
        if (content == kStep) value = (x < x0) == (y < y0) ? 255 : 0;
        if (content == kStripes) value = (c == 0 ? x : y) / size % 2 * 255;
        if (content == kSmooth) value = int(127.5 + 127 * std::sin(fx * x + fy * y + c));
        picture[3 * (size_t(y) * size_t(width) + size_t(x)) + size_t(c)] = uint8_t(value);
      }
    }
  }
  return picture;
}

TEST_CASE("layers: taps match their definition") {
  const double one = 1 << kTapBits;
  // The taps must equal their definition up to rounding. The centre tap takes the remainder of
  // rounding, so that the gain is exactly 1.
  const auto check = [&](const HalfBand& taps, double beta, double gain) {
    CHECK(std::abs(taps.near - one * Tap(1, beta, gain)) < 1);
    CHECK(std::abs(taps.far - one * Tap(3, beta, gain)) < 1);
  };
  check(starfocus::kDownFilter, kBetaDown, 1);
  CHECK(std::abs(starfocus::kDownFilter.centre - one * Tap(0, kBetaDown, 1)) < 1);
  check(starfocus::kUpFilter, kBetaUp, 2);
  // With beta_U, G_U(-1) is nearly 0. The engine changes the centre tap so that G_U(-1) is exactly
  // 0, which gives both phases a gain of 1.
  const double response = Tap(0, kBetaUp, 2) - 2 * Tap(1, kBetaUp, 2) - 2 * Tap(3, kBetaUp, 2);
  CHECK(std::abs(response) < 3e-4);
  CHECK(std::abs(starfocus::kUpFilter.centre - one * Tap(0, kBetaUp, 2)) <
        1 + one * std::abs(response));
  CHECK(starfocus::kUpFilter.centre == 1 << kTapBits);
}

TEST_CASE("layers: rounding errors of subsampling and upsampling by 1 or 2 layers are bounded") {
  test::Random random(13);
  // Largest errors per layer, before and after rounding to grey levels.
  double samples[3] = {}, grey_levels[3] = {};
  constexpr int kSizes[] = {1, 2, 3, 4, 5, 7, 8, 15, 16, 17, 31, 33, 47, 70};
  for (int round = 0; round < 240; ++round) {
    // Every tenth picture has several columns of the largest superblocks.
    const int width = round % 10 == 0 ? random.Int(70, 270) : kSizes[random.Int(0, 13)];
    const int height = kSizes[random.Int(0, 13)];
    const std::vector<uint8_t> picture =
        RandomPicture(width, height, Content(round % kContents), &random);
    for (int layer = 1; layer <= 2; ++layer) {
      const std::vector<int16_t> got =
          DownAndUp(picture, width, height, layer, 32 << random.Int(0, 3));
      std::vector<uint8_t> levels(picture.size() + kPadding);
      BestKernels().Narrow(got.data(), picture.size(), {nullptr, nullptr}, levels.data());
      const Image expected = ReferenceDownAndUp(picture, width, height, layer);
      for (size_t i = 0; i < picture.size(); ++i) {
        const double exact = expected.samples[i], sample = std::ldexp(double(got[i]), -kLayerBits);
        samples[layer] = std::max(samples[layer], std::abs(sample - exact));
        grey_levels[layer] =
            std::max(grey_levels[layer], std::abs(levels[i] - std::nearbyint(exact)));
      }
    }
  }
  MESSAGE("one layer ", samples[1], ", two layers ", samples[2]);
  CHECK(samples[1] <= 0.25);
  CHECK(samples[2] <= 0.5);
  CHECK(grey_levels[1] <= 1);
  CHECK(grey_levels[2] <= 1);
}

TEST_CASE("layers: LayerSize is half the size of the previous layer, rounded up, plus one") {
  for (int size = 1; size < 300; ++size) {
    // Layer 1 has (size + 1) / 2 pixels inside the picture, and one more pixel beyond the picture.
    CHECK(LayerSize(size, 0) == size);
    CHECK(LayerSize(size, 1) == (size + 1) / 2 + 1);
    CHECK(LayerSize(size, 2) == ((size + 1) / 2 + 2) / 2 + 1);
    CHECK(4 * (LayerSize(size, 2) - 1) >= size - 1);
  }
}

}  // namespace
}  // namespace layers_test
