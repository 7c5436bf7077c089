// SPDX-License-Identifier: Apache-2.0
// Tests pictures of more than 8 bits, light beyond white and alpha. The oracles are the picture of
// 8 bits, the linearity of refocusing in light, and the picture of another way to ask for it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/operations/cases.h"
#include "tests/operations/operations.h"
#include "tests/operations/random_cases.h"
#include "tests/support/config.h"
#include "tests/support/images.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace deep_test {
namespace {

double LightOfSrgb(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double HalfToLight(uint16_t half) { return double(test::DepthMemory::FloatOf(half)); }

int Channels(int format) {
  return format == STARFOCUS_FORMAT_RGBA16 || format == STARFOCUS_FORMAT_RGBA_HALF ? 4 : 3;
}

// A picture of an RGB format of 16 bits. Rows have `padding` more words than the picture.
struct Words {
  Words(int w, int h, int f, int padding = 0)
      : width(w),
        height(h),
        format(f),
        stride(size_t(w * Channels(f) + padding)),
        words(stride * size_t(h), 0xCDCD) {}

  uint16_t* At(int x, int y) { return &words[size_t(y) * stride + size_t(x * Channels(format))]; }
  starfocus_image Image(int row = 0) {
    starfocus_image image = {format, 0, 0, 0, {At(0, row), nullptr, nullptr}, {2 * stride, 0, 0}};
    return image;
  }

  int width, height, format;
  size_t stride;
  std::vector<uint16_t> words;
};

// A light field whose views are deep. `scene` has the map.
struct DeepField {
  test::Scene scene;
  std::vector<Words> views;

  // word(rgba, codes): sets the words of a pixel whose codes of 8 bits are given.
  template <class Word>
  DeepField(const test::Scene& of, int format, const Word& word) : scene(of) {
    for (int view = 0; view < of.views(); ++view) {
      views.emplace_back(of.width, of.height, format, view);
      for (int y = 0; y < of.height; ++y) {
        for (int x = 0; x < of.width; ++x) word(views.back().At(x, y), of.Pixel(view, x, y));
      }
    }
  }

  starfocus_light_field Field(int row = 0) {
    starfocus_light_field field = scene.Field(row);
    for (size_t k = 0; k < views.size(); ++k) field.views[k] = views[k].Image(row);
    return field;
  }
};

test::Config DeepConfig(const test::Scene& scene, double max_blur = 24) {
  test::Config config = test::ConfigFor(scene, max_blur);
  config.features |= STARFOCUS_FEATURE_DEEP;
  return config;
}

Words Refocused(test::Engine* engine, const starfocus::Params& params, DeepField* field,
                int format) {
  Words out(field->scene.width, field->scene.height, format, 3);
  const starfocus_light_field light_field = field->Field();
  const starfocus_image image = out.Image();
  REQUIRE(engine->status() == STARFOCUS_OK);
  REQUIRE(starfocus_refocus(engine->get(), &params, &light_field, &image, nullptr) == STARFOCUS_OK);
  return out;
}

// Rows of scenes of several superblocks; slow builds have superblocks only across.
constexpr int kRows = test::kSlow ? 60 : 140;

const auto kExpand = [](uint16_t* to, const uint8_t* codes) {
  for (int c = 0; c < 3; ++c) to[c] = uint16_t(257 * codes[c]);
};

// Half floats of the light of the codes, `gain` times as bright.
auto Bright(double gain) {
  return [gain](uint16_t* to, const uint8_t* codes) {
    for (int c = 0; c < 3; ++c) {
      to[c] = test::DepthMemory::HalfOf(gain * LightOfSrgb(codes[c] / 255.0));
    }
  };
}

TEST_CASE("deep: codes of 8 bits in 16 bits give the picture of 8 bits") {
  for (const starfocus_mode mode : test::kModes) {
    for (const int views : {1, 5}) {
      const test::Scene scene = test::LayeredScene(150, kRows, views, 8, 21);
      const starfocus::Params params = test::Params(3, 1, mode);
      const test::Output expected = test::OutputOf(test::ConfigFor(scene, 24), params, scene);
      DeepField field(scene, STARFOCUS_FORMAT_RGB16, kExpand);
      test::Engine engine(DeepConfig(scene));
      Words out = Refocused(&engine, params, &field, STARFOCUS_FORMAT_RGB16);
      int worst = 0;
      for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
          for (int c = 0; c < 3; ++c) {
            const int code = 257 * expected.Pixel(x, y)[c];
            worst = std::max(worst, std::abs(out.At(x, y)[c] - code));
          }
        }
      }
      CAPTURES(mode, views);
      CHECK(worst <= 257);
      CHECK(out.words[out.stride - 1] == 0xCDCD);
    }
  }
}

TEST_CASE("deep: previews of codes of 8 bits in 16 bits are those of 8 bits") {
  const test::Scene scene = test::LayeredScene(150, 141, 5, 8, 25);
  const starfocus::Params params = test::Params(3, 1, STARFOCUS_MODE_BLOCK);
  const auto preview = [&](test::Config config, const starfocus_light_field& field,
                           const starfocus_image& out) {
    config.previews = 1;
    test::Engine engine(config);
    test::PreparedMemory memory(config);
    const starfocus_prepared* prepared = memory.Prepare(engine.get(), field);
    REQUIRE(test::Preview(engine.get(), &params, prepared, 1, &out, nullptr) == STARFOCUS_OK);
  };
  test::Output expected(75, 71);
  preview(test::ConfigFor(scene, 24), scene.Field(),
          starfocus_image_rgb(expected.bytes.data(), expected.stride));
  DeepField field(scene, STARFOCUS_FORMAT_RGB16, kExpand);
  Words out(75, 71, STARFOCUS_FORMAT_RGB16);
  preview(DeepConfig(scene), field.Field(), out.Image());
  int worst = 0;
  for (int y = 0; y < 71; ++y) {
    for (int x = 0; x < 75; ++x) {
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(out.At(x, y)[c] - 257 * expected.Pixel(x, y)[c]));
      }
    }
  }
  CHECK(worst <= 2 * 257);
}

TEST_CASE("deep: every level of a constant picture stays within 2^-14 of white") {
  test::Scene scene = test::LayeredScene(96, 70, 5, 8, 22);
  for (const int format : {STARFOCUS_FORMAT_RGB16, STARFOCUS_FORMAT_RGBA16}) {
    test::Config config = DeepConfig(scene);
    config.transfer = STARFOCUS_TRANSFER_NONE;
    test::Engine engine(config);
    // Slow builds skip most levels.
    constexpr int kDark = test::kSlow ? 4 : 64, kStep = test::kSlow ? 3970 : 397;
    for (int level = 0; level < 65536; level += level < kDark ? 1 : kStep) {
      const uint16_t code = uint16_t(level);
      DeepField field(scene, format, [&](uint16_t* to, const uint8_t*) {
        for (int c = 0; c < Channels(format); ++c) to[c] = c == 3 ? uint16_t{65535} : code;
      });
      Words out = Refocused(&engine, test::Params(2, 1, STARFOCUS_MODE_BLOCK), &field, format);
      int worst = 0;
      for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
          for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(out.At(x, y)[c] - level));
          if (Channels(format) == 4) CHECK(out.At(x, y)[3] == 65535);
        }
      }
      CAPTURES(format, level);
      // Two levels of light, of which a level of 2^-14 has 4 codes. Edges may have one code more.
      CHECK(worst <= 5);
    }
  }
}

// In block mode, lamps are not gathered where blur varies, so that both pictures differ more.
TEST_CASE("deep: light beyond white is refocused like light below it") {
  for (const int views : {1, 5}) {
    for (const starfocus_mode mode : test::kModes) {
      if (test::kSlow && views > 1 && mode != STARFOCUS_MODE_BLOCK) continue;
      const test::Scene scene = test::LayeredScene(150, kRows, views, 8, 23);
      test::Config config = DeepConfig(scene);
      config.features &= ~STARFOCUS_FEATURE_COVERAGE;  // which depends on colours
      test::Engine engine(config);
      const starfocus::Params params = test::Params(3, 1, mode);
      constexpr int kHalf = STARFOCUS_FORMAT_RGB_HALF;
      DeepField dark(scene, kHalf, Bright(1)), bright(scene, kHalf, Bright(32));
      Words low = Refocused(&engine, params, &dark, kHalf);
      Words high = Refocused(&engine, params, &bright, kHalf);
      double sum = 0, worst = 0;
      for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
          for (int c = 0; c < 3; ++c) {
            const double error = HalfToLight(high.At(x, y)[c]) / 32 - HalfToLight(low.At(x, y)[c]);
            worst = std::max(worst, std::fabs(error));
            sum += error * error;
          }
        }
      }
      CAPTURES(views, mode);
      CHECK(worst < 0.1);
      const double most = mode == STARFOCUS_MODE_BLOCK ? 0.004 : 0.003;
      CHECK(std::sqrt(sum / (3 * scene.width * scene.height)) < most);
    }
  }
}

// A black wall is as dark in focus as out of focus, so the map of the wall does not matter.
TEST_CASE("deep: a lamp a little nearer than a wall is blurred by its own radius") {
  constexpr int kSide = 64;
  const auto is_lamp = [](int x, int y) { return (x - 32) * (x - 32) + (y - 32) * (y - 32) < 20; };
  const auto refocused = [&](float wall) {
    test::Scene scene = test::EmptyScene(kSide, kSide, 1, 0, 1);
    test::SetDisparity(&scene, [&](int x, int y) { return is_lamp(x, y) ? 1.0F : wall; });
    DeepField field(scene, STARFOCUS_FORMAT_RGB_HALF,
                    [](uint16_t* to, const uint8_t*) { std::fill_n(to, 3, uint16_t{0}); });
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (is_lamp(x, y)) std::fill_n(field.views[0].At(x, y), 3, test::DepthMemory::HalfOf(60));
      }
    }
    test::Engine engine(DeepConfig(scene));
    return Refocused(&engine, test::Params(8, 1, STARFOCUS_MODE_BLOCK), &field,
                     STARFOCUS_FORMAT_RGB_HALF);
  };
  Words alone = refocused(1), before_wall = refocused(0);
  for (const int x : {32, 36, 40}) {
    const double expected = HalfToLight(alone.At(x, 32)[0]);
    CHECK(HalfToLight(before_wall.At(x, 32)[0]) == doctest::Approx(expected).epsilon(0.04));
  }
}

TEST_CASE("deep: a lamp does not change a preview far away from it") {
  constexpr int kSide = 128, kShown = 20;  // rows of the preview that the lamp does not reach
  test::Scene scene = test::LayeredScene(kSide, kSide, 1, 1, 29);
  test::SetDisparity(&scene, [](int x, int) { return x / 20 % 2 == 0 ? 0.0F : 1.0F; });
  const auto preview = [&](bool has_lamp) {
    DeepField field(scene, STARFOCUS_FORMAT_RGB_HALF, Bright(1));
    if (has_lamp) std::fill_n(field.views[0].At(100, 120), 3, test::DepthMemory::HalfOf(60));
    test::Config config = DeepConfig(scene);
    config.previews = 1;
    test::Engine engine(config);
    test::PreparedMemory memory(engine);
    const starfocus_prepared* const prepared = memory.Prepare(engine.get(), field.Field());
    Words out(kSide / 2, kSide / 2, STARFOCUS_FORMAT_RGB_HALF);
    const starfocus_image image = out.Image();
    const starfocus::Params params = test::Params(8, 1, STARFOCUS_MODE_BLOCK);
    REQUIRE(test::Preview(engine.get(), &params, prepared, 1, &image, nullptr) == STARFOCUS_OK);
    out.words.resize(kShown * out.stride);
    return out.words;
  };
  CHECK(preview(true) == preview(false));
}

// A picture of P010 or P210.
struct Yuv {
  Yuv(int w, int h, int f, int matrix = 0, int range = 0)
      : width(w), height(h), luma(size_t(w * h)), chroma(size_t(w + w % 2) * size_t(Rows(f, h))) {
    image = {f, matrix, range, 0, {}, {2 * size_t(w), 2 * size_t(w + w % 2), 0}};
  }

  static int Rows(int format, int rows) {
    return format == STARFOCUS_FORMAT_P010 ? (rows + 1) / 2 : rows;
  }
  starfocus_image Image(int row = 0) {
    starfocus_image from = image;
    from.planes[0] = &luma[size_t(row * width)];
    from.planes[1] = &chroma[size_t(Rows(image.format, row) * (width + width % 2))];
    return from;
  }
  bool operator==(const Yuv& other) const { return luma == other.luma && chroma == other.chroma; }

  int width, height;
  starfocus_image image;
  std::vector<uint16_t> luma, chroma;
};

// Returns R, G, B of samples of 10 bits, from 0 to 1.
std::vector<double> ColourOf(int y, int u, int v, int matrix, int range) {
  const double kr = matrix == STARFOCUS_MATRIX_BT601 ? 0.299 : 0.2126;
  const double kb = matrix == STARFOCUS_MATRIX_BT601 ? 0.114 : 0.0722;
  const bool full = range == STARFOCUS_RANGE_FULL;
  const double luma = full ? y / 1023.0 : (y - 64) / 876.0, scale = full ? 1023 : 896;
  const double blue = luma + (2 - 2 * kb) * (u - 512) / scale;
  const double red = luma + (2 - 2 * kr) * (v - 512) / scale;
  return {red, (luma - kr * red - kb * blue) / (1 - kr - kb), blue};
}

TEST_CASE("deep: constant colours of P010 and P210 are those of the standards, and stay") {
  test::Random random(31);
  const test::Scene scene = test::LayeredScene(67, 35, 1, 8, 26);
  test::Engine engine(DeepConfig(scene));
  for (int k = 0; k < 64;) {
    const int format = STARFOCUS_FORMAT_P010 + k % 2, matrix = k / 2 % 2, range = k / 4 % 2;
    const int y = random.Int(64, 940), u = random.Int(300, 724), v = random.Int(300, 724);
    const std::vector<double> colour = ColourOf(y, u, v, matrix, range);
    if (*std::min_element(colour.begin(), colour.end()) < 0) continue;
    if (*std::max_element(colour.begin(), colour.end()) > 1) continue;
    ++k;
    Yuv in(67, 35, format, matrix, range), out(67, 35, format, matrix, range);
    std::fill(in.luma.begin(), in.luma.end(), uint16_t(y << 6));
    for (size_t n = 0; n < in.chroma.size(); ++n) in.chroma[n] = uint16_t((n % 2 ? v : u) << 6);
    starfocus_light_field field = scene.Field();
    field.views[0] = in.Image();
    const starfocus::Params params = test::Params(3, 1, STARFOCUS_MODE_BLOCK);
    Words rgb(67, 35, STARFOCUS_FORMAT_RGB16);
    const starfocus_image to_rgb = rgb.Image(), to_yuv = out.Image();
    CAPTURES(format, matrix, range, y, u, v);
    REQUIRE(starfocus_refocus(engine.get(), &params, &field, &to_rgb, nullptr) == STARFOCUS_OK);
    REQUIRE(starfocus_refocus(engine.get(), &params, &field, &to_yuv, nullptr) == STARFOCUS_OK);
    for (int c = 0; c < 3; ++c) {
      // Light has 15 bits, so dark codes of sRGB are up to 26 apart.
      CHECK(std::fabs(rgb.At(40, 20)[c] - 65535 * colour[size_t(c)]) < 26);
    }
    CHECK(in == out);
  }
}

TEST_CASE("deep: regions and streams of P010 and P210 give the words of the whole picture") {
  // Rows are converted in pieces of 128 pixels.
  const test::Scene scene = test::LayeredScene(281, 67, 1, 8, 27);
  test::Config config = DeepConfig(scene);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  config.max_workers = 3;
  test::Engine engine(config);
  starfocus::Params params = test::Params(3, 1, STARFOCUS_MODE_BLOCK);
  for (const int format : {STARFOCUS_FORMAT_P010, STARFOCUS_FORMAT_P210}) {
    test::Random random(32);
    Yuv in(281, 67, format), whole(281, 67, format), streamed(281, 67, format);
    for (uint16_t& word : in.luma) word = uint16_t(random.Int(64, 940) << 6);
    for (uint16_t& word : in.chroma) word = uint16_t(random.Int(400, 624) << 6);
    const auto field = [&](int row) {
      starfocus_light_field of = scene.Field(row);
      of.views[0] = in.Image(row);
      return of;
    };
    const starfocus_light_field all = field(0);
    starfocus_image image = whole.Image();
    REQUIRE(starfocus_refocus(engine.get(), &params, &all, &image, nullptr) == STARFOCUS_OK);
    REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
    for (int pushed = 0, pulled = 0; pulled < 67;) {
      int32_t consumed = 0, written = 0;
      const starfocus_light_field rows = field(std::min(pushed, 66));
      REQUIRE(starfocus_stream_push(engine.get(), &rows, std::min(6, 67 - pushed), &consumed) ==
              STARFOCUS_OK);
      image = streamed.Image(pulled);
      REQUIRE(starfocus_stream_pull(engine.get(), &image, std::min(10, 67 - pulled), &written,
                                    nullptr) == STARFOCUS_OK);
      pushed += consumed;
      pulled += written;
    }
    CHECK(whole == streamed);
    params.region = {150, 10, 41, 37};
    Yuv part(41, 37, format);
    image = part.Image();
    REQUIRE(starfocus_refocus(engine.get(), &params, &all, &image, nullptr) == STARFOCUS_OK);
    params.region = {};
    for (int y = 0; y < 37; ++y) {
      const auto first = whole.luma.begin() + 281 * (y + 10) + 150;
      CHECK(std::equal(first, first + 41, part.luma.begin() + 41 * y));
    }
  }
}

// Calls of one picture of a case.
struct Ways {
  Ways(const properties::Case& of, DeepField* given)
      : params(of.params), field(given), format(given->views[0].format), config(of.config) {
    config.features |= STARFOCUS_FEATURE_DEEP | STARFOCUS_FEATURE_STREAMING;
    config.max_workers = 3;
    config.highlights = 1;
  }

  Words Whole(test::Engine* engine) const { return Refocused(engine, params, field, format); }
  Words Region(test::Engine* engine, const starfocus_region& region) const {
    starfocus::Params part = params;
    part.region = region;
    Words out(region.width, region.height, format, 1);
    const starfocus_light_field light_field = field->Field();
    const starfocus_image image = out.Image();
    REQUIRE(starfocus_refocus(engine->get(), &part, &light_field, &image, nullptr) == STARFOCUS_OK);
    return out;
  }
  Words Prepared(test::Engine* engine) const {
    test::PreparedMemory memory(*engine);
    const starfocus_prepared* prepared = memory.Prepare(engine->get(), field->Field());
    Words out(field->scene.width, field->scene.height, format);
    const starfocus_image image = out.Image();
    REQUIRE(starfocus_refocus_prepared(engine->get(), &params, prepared, &image, nullptr) ==
            STARFOCUS_OK);
    return out;
  }
  Words Streamed(test::Engine* engine, int push, int pull) const {
    const int height = field->scene.height;
    Words out(field->scene.width, height, format);
    REQUIRE(starfocus_stream_begin(engine->get(), &params) == STARFOCUS_OK);
    for (int pushed = 0, pulled = 0; pulled < height;) {
      int32_t consumed = 0, written = 0;
      const starfocus_light_field rows = field->Field(std::min(pushed, height - 1));
      REQUIRE(starfocus_stream_push(engine->get(), &rows, std::min(push, height - pushed),
                                    &consumed) == STARFOCUS_OK);
      const starfocus_image image = out.Image(pulled);
      REQUIRE(starfocus_stream_pull(engine->get(), &image, std::min(pull, height - pulled),
                                    &written, nullptr) == STARFOCUS_OK);
      pushed += consumed;
      pulled += written;
    }
    return out;
  }

  starfocus::Params params;
  DeepField* field;
  int format;
  test::Config config;
};

// Returns true if `part` is the rectangle of `whole` at (x0, y0).
bool IsPart(Words part, Words whole, int x0, int y0) {
  for (int y = 0; y < part.height; ++y) {
    if (std::memcmp(part.At(0, y), whole.At(x0, y0 + y),
                    size_t(2 * Channels(part.format) * part.width)) != 0) {
      return false;
    }
  }
  return true;
}

// Sets the words of a pixel of any deep RGB format: some pixels are transparent, and some are
// beyond white where the format allows it.
auto AnyWords(int format) {
  return [format](uint16_t* to, const uint8_t* codes) {
    const bool has_alpha = Channels(format) == 4;
    const double alpha = codes[1] > 100 || !has_alpha ? 1 : codes[1] / 100.0;
    if (format == STARFOCUS_FORMAT_RGB16 || format == STARFOCUS_FORMAT_RGBA16) {
      kExpand(to, codes);
      if (has_alpha) to[3] = uint16_t(65535 * alpha);
      return;
    }
    Bright(alpha * (codes[0] > 200 ? 20 : 1))(to, codes);
    if (has_alpha) to[3] = test::DepthMemory::HalfOf(alpha);
  };
}

TEST_CASE("deep: all ways to ask for a picture of a random case give the same words") {
  properties::ForRandomCases(120, [](test::Random* random) {
    const properties::Case of = properties::RandomCase(random);
    const int format = STARFOCUS_FORMAT_RGB16 + random->Int(0, 3);
    DeepField field(of.scene, format, AnyWords(format));
    const Ways ways(of, &field);
    INFO(of.Text(), " format ", format);
    test::Engine first(ways.config), engine(ways.config);
    const Words whole = ways.Whole(&first);
    const auto targets = test::SimdTargets();
    test::UseKernels(targets[random->Next() % targets.size()], engine.get());
    CHECK(IsPart(ways.Whole(&engine), whole, 0, 0));
    const int x = random->Int(0, of.scene.width - 1), y = random->Int(0, of.scene.height - 1);
    const starfocus_region region = {x, y, random->Int(1, of.scene.width - x),
                                     random->Int(1, of.scene.height - y)};
    if (of.params.study.mode != STARFOCUS_MODE_BENCHMARK) {
      CHECK(IsPart(ways.Region(&engine, region), whole, x, y));
    }
    CHECK(IsPart(ways.Prepared(&engine), whole, 0, 0));
    CHECK(IsPart(ways.Streamed(&engine, random->Int(1, 40), random->Int(1, 40)), whole, 0, 0));
  });
}

test::Output Codes(test::Engine* engine, const starfocus::Params& params, const test::Scene& scene,
                   const starfocus_region& region) {
  starfocus::Params part = params;
  part.region = region;
  const bool whole = region.width == 0;
  test::Output out(whole ? scene.width : region.width, whole ? scene.height : region.height);
  const starfocus_light_field field = scene.Field();
  const starfocus_image image = starfocus_image_rgb(out.bytes.data(), out.stride);
  REQUIRE(engine->status() == STARFOCUS_OK);
  REQUIRE(starfocus_refocus(engine->get(), &part, &field, &image, nullptr) == STARFOCUS_OK);
  return out;
}

// Returns the largest error of the mean of 32 rows of codes.
double WorstMean(const test::Output& codes, Words exact) {
  double worst = 0;
  for (int top = 0; top + 32 <= codes.height; ++top) {
    double sum = 0;
    for (int y = top; y < top + 32; ++y) {
      for (int x = 0; x < codes.width; ++x) {
        sum += codes.Pixel(x, y)[1] - exact.At(x, y)[1] / 257.0;
      }
    }
    worst = std::max(worst, std::fabs(sum / (32 * codes.width)));
  }
  return worst;
}

TEST_CASE("deep: blurred skies of 8 bits have the right means, and flat pictures stay flat") {
  test::Scene scene = test::LayeredScene(150, 100, 1, 8, 28);
  std::fill(scene.disparity.begin(), scene.disparity.end(), scene.disparity_min);
  const starfocus::Params params = test::Params(scene.disparity_max, 1, STARFOCUS_MODE_BLOCK);
  test::Random random(33);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const auto code = uint8_t((y + random.Int(0, 63)) / 64 + 140);
      std::fill_n(scene.Pixel(0, x, y), 3, code);
    }
  }
  test::Engine engine(DeepConfig(scene));
  DeepField field(scene, STARFOCUS_FORMAT_RGB16, kExpand);
  const Words exact = Refocused(&engine, params, &field, STARFOCUS_FORMAT_RGB16);
  CHECK(WorstMean(Codes(&engine, params, scene, {}), exact) < 0.05);
  CHECK(WorstMean(test::OutputOf(test::ConfigFor(scene, 24), params, scene), exact) > 0.2);
  for (int level = 0; level < 256; level += test::kSlow ? 51 : 1) {
    for (std::vector<uint8_t>& view : scene.pictures) {
      std::fill(view.begin(), view.end(), uint8_t(level));
    }
    const std::vector<uint8_t> out = Codes(&engine, params, scene, {}).Tight();
    CAPTURES(level);
    CHECK(std::count(out.begin(), out.end(), uint8_t(level)) == ptrdiff_t(out.size()));
  }
}

TEST_CASE("deep: regions of dithered pictures have the codes of the whole picture") {
  properties::ForRandomCases(60, [](test::Random* random) {
    properties::Case of = properties::RandomCase(random);
    INFO(of.Text());
    if (of.params.study.mode == STARFOCUS_MODE_BENCHMARK) return;
    // Less contrast, so that groups of columns are about as smooth as those that are dithered.
    for (std::vector<uint8_t>& view : of.scene.pictures) {
      for (uint8_t& code : view) code = uint8_t(100 + code / 8);
    }
    test::Config config = of.config;
    config.features |= STARFOCUS_FEATURE_DEEP;
    config.highlights = 1;
    test::Engine engine(config);
    const test::Output whole = Codes(&engine, of.params, of.scene, {});
    const auto targets = test::SimdTargets();
    test::UseKernels(targets[random->Next() % targets.size()], engine.get());
    for (int k = 0; k < 8; ++k) {
      const int x = random->Int(0, of.scene.width - 1), y = random->Int(0, of.scene.height - 1);
      const starfocus_region region = {x, y, random->Int(1, of.scene.width - x),
                                       random->Int(1, of.scene.height - y)};
      const test::Output part = Codes(&engine, of.params, of.scene, region);
      bool same = true;
      for (int row = 0; row < part.height; ++row) {
        same = same && std::equal(part.Pixel(0, row), part.Pixel(0, row) + part.stride,
                                  whole.Pixel(x, y + row));
      }
      CAPTURES(x, y, region.width, region.height);
      CHECK(same);
    }
  });
}

}  // namespace
}  // namespace deep_test
