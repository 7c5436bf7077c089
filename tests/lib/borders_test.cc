// SPDX-License-Identifier: Apache-2.0
// Tests that the borders which the engine declares for a block are sufficient and not too large.
// Noise in place of all values beyond the borders must not change the bytes of a block. If the
// noise starts one pixel closer to the block, at least one block must change.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/io/input.h"
#include "lib/io/layers.h"
#include "lib/optics/view_set.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"
#include "tests/support/test_scene.h"

// Sets captured views in inputs that tests make.
namespace test {

inline void SetViews(const test::Config& config, starfocus::Input* input) {
  starfocus::ViewSet views;
  starfocus::FindViews(config.views, config.positions, nullptr, &views);
  input->views = config.views;
  input->occlusion_views = starfocus::ChooseOcclusionViews(views);
}

// Sets the pixels of a view: rows of packed RGB codes, which must outlive `input`.
inline void SetPixels(int view, const std::vector<uint8_t>& codes, size_t stride,
                      starfocus::Input* input) {
  input->kernels = &starfocus::simd::BestKernels();
  input->images[view].planes[0] = codes.data();
  input->images[view].strides[0] = stride;
  if (view == 0) input->centre = {codes.data(), stride, 0, 0};
}

// Sets the views of `input` to the centre view and side views at the positions `sides`.
inline void SetPositions(const std::vector<starfocus_position>& sides, starfocus::Input* input) {
  test::Config config;
  config.views = 1;
  for (const starfocus_position& position : sides) config.positions[config.views++] = position;
  SetViews(config, input);
}

}  // namespace test

namespace borders_test {
namespace {

using starfocus::Rect;
using test::Borders;

constexpr int kAll = 10000;  // border width that keeps the whole picture

// Widths of the borders, in pixels, within which the centre view, the map and the side views are
// kept. Pixels and disparities outside the kept borders are replaced by noise.
struct Kept {
  int centre = kAll, map = kAll, sides = kAll;
};

bool Beyond(const Rect& rect, int border, int x, int y) {
  return x < rect.x - border || y < rect.y - border || x >= rect.x + rect.width + border ||
         y >= rect.y + rect.height + border;
}

// Returns the smallest, the largest or a random disparity of the range.
float AnyDisparity(const test::Scene& scene, test::Random* random) {
  const int kind = random->Int(0, 2);
  if (kind == 0) return float(random->Real(scene.disparity_min, scene.disparity_max));
  return kind == 1 ? scene.disparity_min : scene.disparity_max;
}

test::Scene Poisoned(const test::Scene& scene, const Rect& rect, const Kept& kept,
                     test::Random* random) {
  test::Scene poisoned = scene;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      if (Beyond(rect, kept.map, x, y)) poisoned.Disparity(x, y) = AnyDisparity(scene, random);
      for (int view = 0; view < scene.views(); ++view) {
        if (!Beyond(rect, view == 0 ? kept.centre : kept.sides, x, y)) continue;
        for (int c = 0; c < 3; ++c) poisoned.Pixel(view, x, y)[c] = random->Byte();
      }
    }
  }
  return poisoned;
}

// Returns a LayeredScene, or pictures of noise with random rectangles in the map of a LayeredScene.
// If `bright` is true, the pictures are squares of highlights, of about the largest size of lamps.
test::Scene AnyScene(int side, int views, float limit, bool bright, test::Random* random) {
  test::Scene scene = test::LayeredScene(side, side, views, limit, random->Next());
  if (random->Int(0, 3) == 0 && !bright) return scene;
  for (auto& picture : scene.pictures) {
    for (size_t n = 0; n < picture.size(); ++n) {
      picture[n] = bright && n % 3 != 0 ? uint8_t(random->Int(251, 255)) : random->Byte();
    }
    const int lamp = random->Int(20, 33), step = lamp + random->Int(8, 30);
    const int x0 = random->Int(0, step), y0 = random->Int(0, step);
    for (int y = 0; bright && y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        if ((x + x0) % step < lamp && (y + y0) % step < lamp) continue;
        std::fill_n(&picture[size_t(y) * scene.stride + 3 * size_t(x)], 3, uint8_t{0});
      }
    }
  }
  const int pieces = random->Int(0, 30);
  for (int piece = 0; piece < pieces; ++piece) {
    const float d = AnyDisparity(scene, random);
    const int x0 = random->Int(0, side - 1), x1 = std::min(side, x0 + random->Int(1, 60));
    const int y0 = random->Int(0, side - 1), y1 = std::min(side, y0 + random->Int(1, 60));
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) scene.Disparity(x, y) = d;
    }
  }
  return scene;
}

// Configuration and lens for refocusing a superblock.
struct Way {
  int views = 5, mode = STARFOCUS_MODE_BLOCK, renderer = STARFOCUS_RENDERER_SLICES, max_layer = 2,
      gather = 1;
  float highlights = 1, limit = 4;
  double focus = 0, n_scale = 1, aperture = 1;
  bool bright = false, coverage = false;

  int side = 160;

  int Side() const { return highlights > 1 ? 288 : side; }
  test::Config Config(const test::Scene& scene) const {
    test::Config config = test::ConfigFor(scene, aperture * (limit + std::abs(focus)));
    if (!coverage) config.features &= ~STARFOCUS_FEATURE_COVERAGE;
    config.superblock = kSuperblock;
    config.tuning.max_layer = int16_t(max_layer);
    config.tuning.gather = int16_t(gather);
    config.highlights = highlights;
    config.tuning.n_scale = n_scale;
    // Deblocking is off, since deblocking would read pixels of other superblocks.
    config.tuning.deblocking = 0;
    return config;
  }
  static constexpr int kSuperblock = 32;
};

// A superblock, in the middle or at the edges of a picture, that is refocused alone.
class Superblock {
 public:
  Superblock(const Way& way, test::Random* random)
      : way_(way),
        scene_(AnyScene(way.Side(), way.views, way.limit, way.bright, random)),
        engine_(way.Config(scene_)) {
    REQUIRE(engine_.status() == STARFOCUS_OK);
    const int middle = way.Side() / 2 / Way::kSuperblock * Way::kSuperblock;
    const int last = (way.Side() - 1) / Way::kSuperblock * Way::kSuperblock;
    const int places[] = {0, middle, last};
    const int x = places[random->Int(0, 2)], y = places[random->Int(0, 2)];
    rect_ = {x, y, std::min(Way::kSuperblock, way.Side() - x),
             std::min(Way::kSuperblock, way.Side() - y)};
    bytes_ = Refocus(scene_, &report_);
  }

  Borders Limits() const { return test::BordersOf(way_.Config(scene_)); }
  const test::Report& report() const { return report_; }

  bool ChangesWith(const Kept& kept, test::Random* random) {
    return Refocus(Poisoned(scene_, rect_, kept, random), nullptr) != bytes_;
  }

 private:
  std::vector<uint8_t> Refocus(const test::Scene& scene, starfocus_report* report) {
    starfocus::Params params =
        test::Params(way_.focus, way_.aperture, starfocus_mode(way_.mode), way_.renderer);
    params.region = {rect_.x, rect_.y, rect_.width, rect_.height};
    test::Output out(rect_.width, rect_.height);
    REQUIRE(test::Refocus(&engine_, params, scene, &out, nullptr, nullptr, report) == STARFOCUS_OK);
    return out.bytes;
  }

  const Way way_;
  const test::Scene scene_;
  test::Engine engine_;
  Rect rect_ = {};
  test::Report report_;
  std::vector<uint8_t> bytes_;
};

Way AnyWay(test::Random* random) {
  constexpr int kViews[] = {1, 5, 17};
  constexpr int kModes[] = {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK, STARFOCUS_MODE_BLUR,
                            STARFOCUS_MODE_BLOCK};
  Way way;
  way.views = kViews[random->Int(0, 2)];
  way.mode = kModes[std::min(3, random->Int(0, 8))];
  way.renderer = random->Int(0, 1) == 0 ? STARFOCUS_RENDERER_LINE_SCAN : STARFOCUS_RENDERER_SLICES;
  way.max_layer = random->Int(0, 2);
  way.gather = random->Int(0, 1);
  way.highlights = random->Int(0, 5) == 0 ? 8.0F : 1.0F;
  way.bright = way.highlights > 1 && random->Int(0, 1) == 0;
  way.limit = float(random->Int(1, way.highlights > 1 ? 5 : 9));
  way.focus = random->Int(-3, 3);
  way.n_scale = random->Int(0, 1) == 0 ? 0.5 : 1;
  way.coverage = random->Int(0, 3) == 0;
  if (way.coverage) way.side = 400;
  return way;
}

TEST_CASE("borders: values beyond the borders of a superblock do not affect its bytes") {
  test::Random random(1);
  uint64_t pixels[STARFOCUS_LAYERS] = {}, gathered = 0;
  for (int round = 0; round < test::Rounds(400); ++round) {
    const Way way = AnyWay(&random);
    Superblock superblock(way, &random);
    const Borders borders = superblock.Limits();
    for (int level = 0; level < STARFOCUS_LAYERS; ++level) {
      pixels[level] += superblock.report().layers[level].pixels;
    }
    gathered += superblock.report().gathered_pixels;
    CAPTURES(round, way.mode, way.renderer, way.views, way.max_layer, way.limit);
    const int centre = way.highlights > 1 ? borders.views : borders.centre;
    const bool changes = superblock.ChangesWith({centre, borders.centre, borders.views}, &random);
    CHECK(!changes);
  }
  for (const uint64_t of_layer : pixels) CHECK(of_layer > 0);
  CHECK(gathered > 0);
}

// Configuration in which the output of a superblock depends on all pixels of one border, except the
// outermost `unused` pixels. The member pointer `border` selects the tested border.
struct Sum {
  const char* name;
  int views, renderer, max_layer;
  // `part` is the fraction of the blur that the range of disparities causes; the offset of the
  // focus causes the rest.
  double blur, aperture, part;
  int Borders::*border;
  int Kept::*kept;
  int unused;  // Number of outermost pixels of the border that affect no tested picture.
  float highlights = 1;
  int side = 160;

  Way Made() const {
    Way way;
    way.views = views;
    way.renderer = renderer;
    way.max_layer = max_layer;
    way.gather = highlights > 1 ? 1 : 0;
    way.highlights = highlights;
    way.bright = highlights > 1;
    way.aperture = aperture;
    way.limit = float(blur / aperture * part);
    way.focus = blur / aperture - double(way.limit);
    way.side = side;
    return way;
  }
};

// Reasons for unused pixels:
// - Layers: blocks begin and end with whole cells, which determine their bytes. The outermost taps
//   of two successive filters contribute too little to change a rounded sample.
// - One view: noise has no rims, which depend on pixels farther away than boundary pixels do.
// - Side views: hidden pixels at the edge of the border are hardly visible, especially at layers 1
//   and 2. The disparities of hidden pixels seldom reach the largest disparity of the
//   configuration.
// - Highlights: those at the edge of the border only decide the size of lamps that layer 2 reads.
const Sum kSums[] = {
    {"boundary pixels", 1, STARFOCUS_RENDERER_SLICES, 0, 7, 1, 1, &Borders::centre, &Kept::map,
     starfocus::kRimBorder - 1},
    {"edges", 5, STARFOCUS_RENDERER_SLICES, 0, 1, 1.0 / 24, 1, &Borders::centre, &Kept::map, 0, 1,
     161},
    {"layer 1", 1, STARFOCUS_RENDERER_SLICES, 1, 11, 1, 1, &Borders::centre, &Kept::centre, 26},
    {"layer 2", 1, STARFOCUS_RENDERER_LINE_SCAN, 2, 11, 1, 0.25, &Borders::centre, &Kept::centre,
     20},
    {"views", 5, STARFOCUS_RENDERER_SLICES, 0, 7, 7.0 / 24, 1, &Borders::views, &Kept::sides, 4},
    {"views, layer 1", 5, STARFOCUS_RENDERER_SLICES, 1, 11, 0.5, 0.75, &Borders::views,
     &Kept::sides, 8},
    {"views, layer 2", 5, STARFOCUS_RENDERER_SLICES, 2, 11, 0.25, 0.5, &Borders::views,
     &Kept::sides, 20},
    {"highlights", 1, STARFOCUS_RENDERER_SLICES, 2, 4, 1, 1, &Borders::views, &Kept::centre, 36, 8},
    {"highlights of views", 5, STARFOCUS_RENDERER_LINE_SCAN, 2, 4, 1, 1, &Borders::views,
     &Kept::sides, 36, 8},
};

TEST_CASE("borders: if a border is one pixel too narrow, the bytes of superblocks change") {
  for (const Sum& sum : kSums) {
    test::Random random(5);
    bool beyond = false, within = false;
    for (int round = 0; round < 300 && !within; ++round) {
      Superblock superblock(sum.Made(), &random);
      const int border = superblock.Limits().*sum.border;
      Kept kept;
      kept.*sum.kept = border;
      beyond = beyond || superblock.ChangesWith(kept, &random);
      kept.*sum.kept = border - sum.unused - 1;
      within = superblock.ChangesWith(kept, &random);
    }
    const std::string name = sum.name;
    CAPTURE(name);
    CHECK(!beyond);
    CHECK(within);
  }
}

// Records whether the output of a step depends on samples beyond the border, and whether the output
// depends on the outermost samples within the border.
struct Dependence {
  bool beyond = false, within = false;

  // The function `run` returns the output of the tested step for a border of the given width. `run`
  // replaces all input beyond the border by noise.
  template <class Run>
  void Add(int border, const Run& run) {
    const auto all = run(kAll);
    beyond = beyond || run(border) != all;
    within = within || run(border - 1) != all;
  }
  void Check() const {
    CHECK(!beyond);
    CHECK(within);
  }
};

// Returns a picture of noise around a rectangle. Noise beyond the border comes from another
// sequence of random numbers.
std::vector<uint8_t> NoiseAround(int side, const Rect& rect, int border, uint64_t seed) {
  test::Random inside(seed), outside(border == kAll ? seed : seed + 1);
  std::vector<uint8_t> picture(3 * size_t(side) * size_t(side));
  size_t n = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (int c = 0; c < 3; ++c) {
        const uint8_t kept = inside.Byte(), poison = outside.Byte();
        picture[n++] = Beyond(rect, border, x, y) ? poison : kept;
      }
    }
  }
  return picture;
}

TEST_CASE("borders: the layer filters read exactly as far as their declared border") {
  constexpr int kSide = 40, kRows = 22, kAt = 9;
  Dependence dependence;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    dependence.Add(starfocus::kDownBorder, [&](int border) {
      const Rect pair = {2 * kAt, 2 * kAt, 2, 2};
      const std::vector<uint8_t> picture = NoiseAround(kSide, pair, border, seed);
      starfocus::Input input;
      input.width = input.height = kSide;
      input.transfer = &starfocus::TransferOf(STARFOCUS_TRANSFER_NONE);
      input.centre = {picture.data(), 3 * size_t(kSide), 0, 0};
      std::vector<int16_t> samples(3 * kRows * kRows + 64), even(3 * kSide), odd(even),
          half(3 * kSide * size_t(starfocus::TapsOfLayer(kRows)) + 64);
      starfocus::LayerPlane plane;
      plane.width = plane.height = kRows - 1;
      plane.rows = {kAt, kAt + 1};
      plane.samples = {samples.data(), 3 * kRows, 0, 0};
      DownsamplePicture(starfocus::simd::BestKernels(), input, 1, {0, plane.width},
                        {even.data(), odd.data(), half.data(), nullptr}, plane);
      const int16_t* const sample = plane.samples.Row(kAt) + 3 * kAt;
      return std::vector<int16_t>(sample, sample + 3);
    });
  }
  dependence.Check();
}

TEST_CASE("borders: captured views are read exactly as far as the declared border") {
  constexpr int kSide = 40;
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    CAPTURE(layer);
    Dependence dependence;
    for (uint64_t seed = 1; seed <= 20; ++seed) {
      dependence.Add(starfocus::CapturedBorder(layer), [&](int border) {
        const Rect place = {16, 16, 1, 1};
        const std::vector<uint8_t> picture = NoiseAround(kSide, place, border, seed);
        starfocus::Input input;
        test::SetPixels(1, picture, 3 * size_t(kSide), &input);
        input.views = 2;
        input.width = input.height = kSide;
        input.transfer = &starfocus::TransferOf(STARFOCUS_TRANSFER_NONE);
        const int at = (16 << starfocus::kShiftBits >> layer) + (layer == 0 ? 77 : 0);
        std::vector<int16_t> rgb(3);
        ReadCaptured(input, layer, 1, {at, at, 1, 0}, 1, rgb.data());
        return rgb;
      });
    }
    dependence.Check();
  }
}

}  // namespace

}  // namespace borders_test
