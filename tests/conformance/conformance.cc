// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/conformance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "starfocus/starfocus.hpp"
#include "tests/support/inside.h"
#include "tests/support/shapes.h"

namespace conformance {
namespace {

// Converts the rectangle of a cell, which is blurred without rendering views, to pixels at the
// layer of the cell's block. At the sides of the block, the rectangle includes the margin that
// upsampling reads.
void AtLayer(const starfocus::Block& block, reference::GatheredCell* cell) {
  const int scale = 1 << block.layer, margin = block.layer == 0 ? 0 : block.layer + 1;
  const starfocus::Rect& rect = block.rect;
  const auto find = [&](int from, int size, int first, int all, int* at, int* at_size) {
    *at = from / scale - (from == first ? margin : 0);
    const int end = from + size;
    *at_size = (end + scale - 1) / scale + (end == first + all ? margin : 0) - *at;
  };
  find(cell->x, cell->width, rect.x, rect.width, &cell->at_x, &cell->at_width);
  find(cell->y, cell->height, rect.y, rect.height, &cell->at_y, &cell->at_height);
}

std::vector<reference::GatheredCell> GatheredCells(const starfocus::GatherMap& map,
                                                   const starfocus::Block& block) {
  std::vector<reference::GatheredCell> cells;
  if (!block.gathers) return cells;
  constexpr int kSide = starfocus::kCellSize;
  const int right = block.rect.x + block.rect.width, bottom = block.rect.y + block.rect.height;
  for (int y = block.rect.y; y < bottom; y += kSide) {
    for (int x = block.rect.x; x < right; x += kSide) {
      if (map.FirstLayer(x, y) > block.layer) continue;
      const bool on_slope = (map.At(x, y) & starfocus::kSlopeMark) != 0;
      cells.push_back(
          {x, y, std::min(kSide, right - x), std::min(kSide, bottom - y), on_slope, 0, 0, 0, 0});
      AtLayer(block, &cells.back());
    }
  }
  return cells;
}

// Block visitor that collects the engine's blocks for the reference. The engine calls the visitor
// while the plan of the block's stripe is in memory.
struct Visit {
  starfocus_engine* engine;
  std::vector<reference::Block>* blocks;

  static void Add(void* self, const starfocus_block* told) {
    const auto& visit = *static_cast<const Visit*>(self);
    const test::StripeBlocks plan = test::PlanOf(visit.engine);
    const starfocus::Block& b = *std::find_if(
        plan.blocks.begin(), plan.blocks.end(),
        [&](const auto& block) { return block.rect.x == told->x && block.rect.y == told->y; });
    visit.blocks->push_back({b.rect.x,
                             b.rect.y,
                             b.rect.width,
                             b.rect.height,
                             b.layer,
                             b.n,
                             {b.rendered.x, b.rendered.y, b.rendered.width, b.rendered.height,
                              b.border.left, b.border.right, b.border.top, b.border.bottom},
                             GatheredCells(plan.gathered, b)});
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

void SetDepth(Depth depth, test::Scene* scene, test::Random* random) {
  const double low = scene->disparity_min, high = scene->disparity_max;
  if (depth == Depth::kPiecewise) return test::RandomDisparity(scene, random);
  if (depth == Depth::kNoisy) return test::NoisyDisparity(scene, random);
  const double base = random->Real(low, high);
  const double dx = depth == Depth::kConstant ? 0 : random->Real(-0.3, 0.3);
  const double dy = depth == Depth::kConstant ? 0 : random->Real(-0.3, 0.3);
  reference::ForEachPixel(scene->width, scene->height, [&](int x, int y) {
    scene->Disparity(x, y) =
        std::clamp(float(base + dx * x + dy * y), scene->disparity_min, scene->disparity_max);
  });
}

void SetColours(Colours colours, test::Scene* scene, test::Random* random) {
  if (colours == Colours::kAny) colours = Colours(random->Int(0, 2));
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

double OneOf(std::initializer_list<double> values, test::Random* random) {
  return values.begin()[random->Int(0, int(values.size()) - 1)];
}

// Makes a chequerboard of near and far rectangles of one or more pixels.
void Alternate(test::Scene* scene, test::Random* random) {
  const int step_x = random->Int(1, 5), step_y = random->Int(1, 5);
  reference::ForEachPixel(scene->width, scene->height, [&](int x, int y) {
    const bool near = (x / step_x + y / step_y) % 2 == 1;
    scene->Disparity(x, y) = near ? scene->disparity_max : scene->disparity_min;
  });
}

// In all views, gives near pixels one colour and far pixels another colour, with a little noise.
// Pixels at edges may then be any mixture of the near and the far colour.
void TwoColours(test::Scene* scene, test::Random* random) {
  const int noise = 1 << random->Int(0, 6);
  const float middle = 0.5F * (scene->disparity_min + scene->disparity_max);
  uint8_t colours[2][3];
  for (auto& colour : colours) {
    for (uint8_t& level : colour) level = random->Byte();
  }
  for (int view = 0; view < scene->views(); ++view) {
    reference::ForEachPixel(scene->width, scene->height, [&](int x, int y) {
      const uint8_t* colour = colours[scene->Disparity(x, y) > middle ? 1 : 0];
      for (int c = 0; c < 3; ++c) {
        scene->Pixel(view, x, y)[c] =
            uint8_t(std::clamp(colour[c] + random->Int(-noise, noise), 0, 255));
      }
    });
  }
}

// Copies the centre view to all views.
void RepeatCentre(test::Scene* scene) {
  for (auto& picture : scene->pictures) picture = scene->pictures[0];
}

test::Scene AnyScene(Kind kind, test::Random* random) {
  const double depth =
      OneOf({0, random->Real(0, 3), random->Real(0, 12), random->Real(0, 60)}, random);
  const double low = random->Int(0, 9) == 0 ? random->Real(-400, 400) : random->Real(-9, 9);
  const bool large = kind == Kind::kLarge || kind == Kind::kPaper;
  const int views = test::kStars[random->Int(0, 3)];
  const int height = random->Int(1, large ? 64 : 32), width = random->Int(1, large ? 96 : 40);
  test::Scene scene = test::EmptyScene(width, height, views, float(low), float(low + depth));
  const int map = random->Int(0, 4);
  if (map == 4) {
    Alternate(&scene, random);
  } else {
    SetDepth(Depth(map), &scene, random);
  }
  const int colours = random->Int(0, 3);
  if (colours == 3) {
    TwoColours(&scene, random);
  } else {
    SetColours(Colours(colours), &scene, random);
  }
  if (random->Int(0, 3) == 0) RepeatCentre(&scene);
  return scene;
}

void SetLens(Kind kind, Trial* trial, test::Random* random) {
  const test::Scene& scene = trial->scene;
  const double half = 0.5 * (double{scene.disparity_max} - scene.disparity_min);
  const double centre = 0.5 * (double{scene.disparity_max} + scene.disparity_min);
  const bool paper = kind == Kind::kPaper, benchmark = random->Int(0, paper ? 1 : 5) == 0;
  // Small blur radii are more frequent than large radii, except in trials of the kind kLarge.
  const double part = random->Unit(), most = benchmark ? 6 : paper ? 9 : 40;
  const double radius = kind == Kind::kLarge && !benchmark ? 24 * part : most * part * part;
  double aperture = random->Int(0, 1) == 0 ? 1 : random->Real(0.02, 1);
  if (aperture * half > radius) aperture = std::max(radius / half, 1e-3);
  const double offset = std::max(0.0, radius / aperture - half);
  const double focus = centre + (random->Int(0, 1) == 0 ? offset : -offset);
  const starfocus_mode mode = benchmark                         ? STARFOCUS_MODE_BENCHMARK
                              : paper || random->Int(0, 3) == 0 ? STARFOCUS_MODE_FRAME
                                                                : STARFOCUS_MODE_BLOCK;
  trial->params = test::Params(focus, aperture, mode);
  trial->params.study.renderer =
      paper || random->Int(0, 3) == 0 ? STARFOCUS_RENDERER_LINE_SCAN : STARFOCUS_RENDERER_SLICES;
}

// Extends the focus of every third lens to a range, which may contain all disparities.
void SetRange(Trial* trial, test::Random* random) {
  if (random->Int(0, 2) != 0) return;
  starfocus::Params& lens = trial->params;
  const double widest = 1 + 1.2 * std::max(trial->scene.disparity_max - lens.focus,
                                           lens.focus - trial->scene.disparity_min);
  lens.focus_nearer = random->Int(0, 2) == 0 ? 0 : random->Real(0, widest);
  lens.focus_farther = random->Int(0, 2) == 0 ? 0 : random->Real(0, widest);
}

// Sets the configuration of a scene with blur radii up to `max_blur` pixels.
void SetConfig(int max_layer, double max_blur, Trial* trial) {
  test::Config& config = trial->config;
  config = test::ConfigFor(trial->scene, max_blur);
  // The reference has no thin structures, which random disparities contain.
  // coverage_conformance_slow_test compares how their pixels are split.
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  // The thresholds of deblocking magnify rounding errors. deblock_test tests deblocking.
  config.tuning.deblocking = 0;
  config.tuning.max_layer = max_layer;
}

double LargestBlur(const Trial& trial) {
  return reference::LargestBlur(trial.params, trial.scene.disparity_min, trial.scene.disparity_max);
}

void DrawConfig(Trial* trial, test::Random* random) {
  const int superblock = random->Int(0, 3) == 0 ? 64 : 32;
  SetConfig(random->Int(0, STARFOCUS_LAYERS - 1), std::max(0.5, LargestBlur(*trial)), trial);
  test::Config& config = trial->config;
  config.superblock = superblock;
  config.tuning.gather = random->Int(0, 3) == 0 ? 0 : 1;
  // A low cost per block makes the partition fine, and a high cost makes the partition coarse.
  if (random->Int(0, 1) == 0) config.tuning.timing.block = 1u << random->Int(0, 26);
  if (random->Int(0, 1) == 0) {
    trial->params.theta = OneOf({STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA,
                                 random->Real(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA)},
                                random);
  }
  if (random->Int(0, 1) == 0)
    config.tuning.n_scale = random->Real(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE);
  config.transfer = random->Int(0, 1) == 0 ? STARFOCUS_TRANSFER_SRGB : STARFOCUS_TRANSFER_NONE;
  const int lamps = random->Int(0, 5);
  if (lamps < 2) config.highlights = float(random->Real(1, lamps == 0 ? 4 : 16));
  if (random->Int(0, 1) == 0) test::RandomShape(&trial->params, random);
  test::ReserveFor(trial->params, &config);
}

}  // namespace

void Distance::Add(const Distance& other) {
  largest = std::max(largest, other.largest);
  unrounded = std::max(unrounded, other.unrounded);
  if (other.samples >= kEnoughSamples) worst_mean = std::max(worst_mean, other.mean());
  sum += other.sum;
  samples += other.samples;
  for (size_t layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    at_layer[layer] += other.at_layer[layer];
  }
  gathered += other.gathered;
}

void Distance::Report(const char* name) const {
  std::printf(
      "%s: %.0f samples, largest difference %d (%.3f unrounded), mean %.4f, worst %.4f; "
      "pixels at layers 0, 1, 2: %.0f %.0f %.0f, gathered: %.0f\n",
      name, samples, largest, unrounded, mean(), worst_mean, double(at_layer[0]),
      double(at_layer[1]), double(at_layer[2]), double(gathered));
  CHECK(mean() < kMeanLimit);
}

test::Scene MakeScene(int width, int height, int views, const Range& range, Depth depth,
                      test::Random* random, Colours colours) {
  test::Scene scene = test::EmptyScene(width, height, views, range.low, range.high);
  SetDepth(depth, &scene, random);
  SetColours(colours, &scene, random);
  return scene;
}

std::string Trial::Text() const {
  std::string text =
      "width, height, views, mode, renderer, nearest and farthest disparity, focus, nearer, "
      "farther, aperture, superblock, max_layer, theta, n_scale, gather, block cost, transfer, "
      "highlights: " +
      test::Listed(scene.width, scene.height, scene.views(), params.study.mode,
                   params.study.renderer, scene.disparity_min, scene.disparity_max, params.focus,
                   params.focus_nearer, params.focus_farther, params.aperture, config.superblock,
                   config.tuning.max_layer, params.theta, config.tuning.n_scale,
                   config.tuning.gather, config.tuning.timing.block, config.transfer,
                   config.highlights) +
      test::ShapeText(params);
  for (const starfocus_position& at : scene.positions) text += ", view " + test::Listed(at.u, at.v);
  return text;
}

Trial MakeTrial(const test::Scene& scene, double focus, starfocus_mode mode,
                starfocus_renderer renderer, int max_layer, double max_blur) {
  Trial trial = {scene, test::Params(focus, 1, mode), {}};
  trial.params.study.renderer = renderer;
  SetConfig(max_layer, max_blur, &trial);
  trial.config.superblock = 32;
  while (trial.config.superblock < scene.height) trial.config.superblock *= 2;
  return trial;
}

Trial RandomTrial(uint64_t seed, Kind kind) {
  test::Random random(seed);
  Trial trial;
  trial.scene = AnyScene(kind, &random);
  SetLens(kind, &trial, &random);
  DrawConfig(&trial, &random);
  if (kind == Kind::kAnywhere && trial.params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN) {
    test::RandomViews(&trial.scene, &trial.config, &random);
  }
  SetRange(&trial, &random);
  if (kind == Kind::kPaper) trial.config.tuning.n_scale = test::Config().tuning.n_scale;
  return trial;
}

namespace {

// Checks the report and the blocks of a whole picture that line scans render: the number of views,
// and the border of each block, which must reach as far as the largest blur.
void CheckFrame(const Trial& trial, const starfocus_report& report,
                const std::vector<reference::Block>& blocks) {
  const double r_max = LargestBlur(trial);
  const int n = reference::ViewsAlongRadius(r_max, trial.params.study.mode);
  int views = 0;
  for (int k = 0; k < (2 * n + 1) * (2 * n + 1); ++k) {
    const int i = k % (2 * n + 1) - n, j = k / (2 * n + 1) - n;
    views += i * i + j * j <= n * n;
  }
  CHECK(report.n == n);
  CHECK(report.rendered_views == views);
  for (const reference::Block& block : blocks) {
    CHECK(block.n == n);
    const reference::Rectangle& rect = block.rendered;
    for (const int border : {rect.left, rect.right, rect.top, rect.bottom}) {
      CHECK(border == int(std::ceil(r_max)) + 2);
    }
  }
}

}  // namespace

Distance Check(const Trial& trial) {
  const std::string text = trial.Text();
  CAPTURE(text);
  test::Engine engine(trial.config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  std::vector<reference::Block> blocks;
  Visit visit = {engine.get(), &blocks};
  test::Output out(trial.scene.width, trial.scene.height);
  starfocus_report report = starfocus::NewReport();
  const starfocus_observer observer = test::Visitor(Visit::Add, &visit);
  REQUIRE(test::Refocus(&engine, trial.params, trial.scene, &out, test::ObservedBy(&observer),
                        &report) == STARFOCUS_OK);
  const starfocus_study& study = trial.params.study;
  if (study.renderer == STARFOCUS_RENDERER_LINE_SCAN && study.mode != STARFOCUS_MODE_BLOCK &&
      trial.config.tuning.n_scale == 1) {
    CheckFrame(trial, report, blocks);
  }
  Distance distance = Compare(
      out.Tight(), reference::RefocusBlocks(trial.scene, trial.params, trial.config, blocks));
  for (const reference::Block& block : blocks) {
    distance.at_layer[block.layer] += block.width * block.height;
    for (const auto& cell : block.gathered) distance.gathered += cell.width * cell.height;
  }
  CAPTURE(distance.unrounded);
  // Codes are rounded before and after highlights are added.
  CHECK(distance.largest <= (trial.config.highlights > 1 ? 2 : 1));
  return distance;
}

Distance CheckRandom(uint64_t first, uint64_t last, Kind kind) {
  Distance all;
  for (uint64_t seed = first; seed <= last; ++seed) {
    CAPTURE(seed);
    all.Add(Check(RandomTrial(seed, kind)));
  }
  return all;
}

}  // namespace conformance
