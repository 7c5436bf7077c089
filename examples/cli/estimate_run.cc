// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/estimate_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <new>

#include "examples/command_line/options.h"
#include "platform/file.h"
#include "platform/problem.h"
#include "platform/progress.h"
#include "platform/runner.h"
#include "platform/y4m.h"
#include "starfocus/depth.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

std::vector<int64_t> Histogram(const FloatMap& map, const starfocus_disparity_stats& stats,
                               int bins) {
  std::vector<int64_t> counts(static_cast<size_t>(bins));
  const double range = double(stats.max) - stats.min;
  for (float d : map.values) {
    if (!std::isfinite(d)) continue;
    const double place = range > 0 ? (double(d) - stats.min) / range * bins : 0;
    const int bin = static_cast<int>(place);
    ++counts[size_t(bin < bins ? bin : bins - 1)];
  }
  return counts;
}

Image DrawDisparity(const FloatMap& map) {
  const auto ends = std::minmax_element(map.values.begin(), map.values.end());
  const float low = *ends.first, range = *ends.second - low;
  Image picture(map.width, map.height);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const float place = range > 0 ? (map.values[i] - low) / range : 0;
    std::fill_n(picture.pixels.begin() + static_cast<ptrdiff_t>(3 * i), 3,
                static_cast<uint8_t>(place * 255 + 0.5F));
  }
  return picture;
}

Image DrawDepth(const FloatMap& map, const starfocus_disparity_stats& stats) {
  constexpr int kSteps = static_cast<int>(std::size(kDepthColors)) - 1;
  const float low = stats.min, range = stats.max - low;
  Image picture(map.width, map.height);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const float place = range > 0 ? (map.values[i] - low) / range * kSteps : 0;
    const int step = std::min(static_cast<int>(place), kSteps - 1);
    const float part = place - static_cast<float>(step);
    for (size_t c = 0; c < 3; ++c) {
      const float from = kDepthColors[step][c], to = kDepthColors[step + 1][c];
      picture.pixels[3 * i + c] = static_cast<uint8_t>(from + part * (to - from) + 0.5F);
    }
  }
  return picture;
}

FloatMap SampleMap(const FloatMap& map, int width, int height) {
  FloatMap small;
  small.width = width;
  small.height = height;
  small.values.reserve(size_t(width) * size_t(height));
  for (int64_t y = 0; y < height; ++y) {
    const auto row = static_cast<int>((2 * y + 1) * map.height / (2 * int64_t{height}));
    for (int64_t x = 0; x < width; ++x) {
      small.values.push_back(
          map.at(static_cast<int>((2 * x + 1) * map.width / (2 * int64_t{width})), row));
    }
  }
  return small;
}

namespace {

constexpr int kSmallWidth = 256;      // Largest width of pictures for finding the disparity range.
constexpr int kLeastConfidence = 48;  // Excludes outliers at edges and on flat walls.
constexpr double kStrays = 0.0005;    // Fraction of values discarded at each end of the range.
// If the views lie on few sides of the centre, false matches may have a high confidence. Without a
// star of views, a disparity counts only if at least kLeastAgreeing of the 3x3 pixels centred on it
// have about the same disparity.
constexpr int kLeastAgreeing = 6;

using Images = std::vector<Image>;

// Threads and progress line for computing a map.
struct Maker {
  Maker(int threads, const char* what) : pool(threads), progress(what, 1) {}

  ThreadRunner pool;
  PictureProgress progress;
};

using Bytes = std::vector<uint8_t>;

struct FreeAligned {
  void operator()(void* memory) const {
    ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
  }
};

// Inputs and requested outputs of the computation of a map.
struct MapTask {
  const Images& views;
  int used;                    // Number of views, from the first on, from which the map is made.
  const Positions& positions;  // Positions of `views`.
  const FloatMap* given;       // map to repair; null: estimate the map
  DisparityRange range;
  bool confidence, coverage;
  const PlanarImage* planar = nullptr;  // the only view in YUV; null: `views` has the pixels
};

struct MadeMap {
  FloatMap map;
  Bytes confidence, coverage;  // Empty if not requested or not found.
};

starfocus::Config ConfigOf(const MapTask& task, Maker* maker) {
  starfocus::Config config;
  config.width = task.views[0].width;
  config.height = task.views[0].height;
  config.views = task.used;
  std::copy_n(task.positions.begin(), task.used, config.positions);
  config.disparity_min = task.range.min;
  config.disparity_max = task.range.max;
  config.max_workers = maker->pool.workers();
  if (task.planar != nullptr) config.features |= STARFOCUS_FEATURE_IMAGES;
  return config;
}

Result<MadeMap> MakeMap(const std::string& where, const MapTask& task, Maker* maker) {
  const bool repair = task.given != nullptr;
  const Image& centre = task.views[0];
  starfocus_problem problem = {};
  const starfocus::Config config = ConfigOf(task, maker);
  const starfocus_callbacks callbacks = {ThreadRunner::Run, &maker->pool, PictureProgress::Tell,
                                         &maker->progress, nullptr};
  size_t bytes = 0;
  MadeMap made = {{centre.width, centre.height, {}}, {}, {}};
  starfocus_status status = starfocus_map_workspace_size(&config, repair ? 1 : 0, &bytes, &problem);
  if (status == STARFOCUS_ERROR_TOO_LARGE) {
    return OutOfMemory(where, repair ? "repair its disparities" : "estimate its disparities");
  }
  if (status == STARFOCUS_OK) {
    const std::unique_ptr<void, FreeAligned> workspace(
        ::operator new (bytes, std::align_val_t{STARFOCUS_ALIGNMENT}));
    starfocus_light_field light_field = starfocus::NewLightField();
    if (task.planar != nullptr) light_field.views[0] = EngineImage(*task.planar);
    for (size_t i = 0; i < static_cast<size_t>(task.used) && task.planar == nullptr; ++i) {
      light_field.views[i] = starfocus_image_rgb(task.views[i].row(0), task.views[i].stride());
    }
    const auto width = size_t(centre.width), pixels = width * size_t(centre.height);
    made.map.values.resize(pixels);
    made.confidence.resize(task.confidence ? pixels : 0);
    made.coverage.resize(task.coverage ? pixels : 0);
    starfocus_disparity_output out = {made.map.values.data(),
                                      made.map.stride(),
                                      task.confidence ? made.confidence.data() : nullptr,
                                      width,
                                      task.coverage ? made.coverage.data() : nullptr,
                                      width,
                                      0};
    if (repair) {
      light_field.depth = starfocus_depth_float(task.given->values.data(), task.given->stride(),
                                                task.given->width, task.given->height);
    }
    const auto make = repair ? starfocus_repair_disparity : starfocus_estimate_disparity;
    status = make(&config, &callbacks, &light_field, &out, workspace.get(), bytes, &problem);
    if (out.has_coverage == 0) made.coverage.clear();
  }
  if (status == STARFOCUS_OK) return made;
  return Error::Internal(where, "views from which a map can be computed",
                         Describe(status, &problem).text);
}

// Reduces a picture by an integer factor in each direction. Each pixel is the mean of factor *
// factor pixels.
Image Shrink(const Image& picture, int factor) {
  Image small(std::max(1, picture.width / factor), std::max(1, picture.height / factor));
  for (int y = 0; y < small.height; ++y) {
    for (int k = 0; k < 3 * small.width; ++k) {
      const int x = k / 3 * factor, c = k % 3;
      int sum = 0, count = 0;
      for (int row = y * factor; row < std::min((y + 1) * factor, picture.height); ++row) {
        for (int column = x; column < std::min(x + factor, picture.width); ++column) {
          sum += picture.row(row)[3 * column + c];
          ++count;
        }
      }
      small.row(y)[k] = static_cast<uint8_t>((sum + count / 2) / count);
    }
  }
  return small;
}

// Returns the number of pixels within 3x3 pixels around pixel (x, y) whose disparities are certain
// and differ by at most 1 from the disparity of this pixel.
int CountAgreeing(const MadeMap& made, int x, int y) {
  const FloatMap& map = made.map;
  int agreeing = 0;
  for (int row = std::max(0, y - 1); row <= std::min(y + 1, map.height - 1); ++row) {
    for (int column = std::max(0, x - 1); column <= std::min(x + 1, map.width - 1); ++column) {
      const size_t at = size_t(row) * size_t(map.width) + size_t(column);
      const bool sure = made.confidence[at] >= kLeastConfidence;
      agreeing += sure && std::abs(map.at(column, row) - map.at(x, y)) <= 1 ? 1 : 0;
    }
  }
  return agreeing;
}

// Returns the sorted disparities of the pixels that are certain.
std::vector<float> SureDisparities(const MadeMap& made, bool star) {
  std::vector<float> sure;
  for (int y = 0; y < made.map.height; ++y) {
    for (int x = 0; x < made.map.width; ++x) {
      if (made.confidence[size_t(y) * size_t(made.map.width) + size_t(x)] < kLeastConfidence)
        continue;
      if (star || CountAgreeing(made, x, y) >= kLeastAgreeing) sure.push_back(made.map.at(x, y));
    }
  }
  if (sure.empty()) sure.push_back(0);  // in a uniform picture, all disparities are uncertain
  std::sort(sure.begin(), sure.end());
  return sure;
}

}  // namespace

Image DrawLevels(const Bytes& levels, const Image& centre) {
  Image picture(centre.width, centre.height);
  for (size_t i = 0; i < levels.size(); ++i) {
    std::fill_n(picture.pixels.begin() + static_cast<ptrdiff_t>(3 * i), 3, levels[i]);
  }
  return picture;
}

int StarWithin(const Positions& positions) {
  for (int views : {17, 9, 5}) {
    if (static_cast<size_t>(views) > positions.size()) continue;
    if (AreStar(Positions(positions.begin(), positions.begin() + views))) return views;
  }
  return 1;
}

int EstimateViews(const Positions& positions) {
  const int star = StarWithin(positions);
  return star > 1 ? star : static_cast<int>(positions.size());
}

Error CheckEstimateViews(const std::string& where, const LightField& light_field) {
  if (light_field.views.size() > 1) return {};
  return Expected(where, "at least 2 views to estimate disparities", "a single view");
}

Result<DisparityRange> FindRange(const std::string& where, const LightField& light_field,
                                 int threads) {
  const Images& views = light_field.views;
  const int used = EstimateViews(light_field.positions);
  const int factor = (views[0].width + kSmallWidth - 1) / kSmallWidth;
  Images small;
  for (int i = 0; i < used; ++i) small.push_back(Shrink(views[size_t(i)], factor));
  const float most =
      std::min(static_cast<float>(small[0].width) / 8,
               static_cast<float>(STARFOCUS_MAX_DISPARITY) / static_cast<float>(factor));
  Maker maker(threads, "searching the disparity range");
  const Result<MadeMap> made = MakeMap(
      where, {small, used, light_field.positions, nullptr, {-most, most}, true, false}, &maker);
  if (!made) return made.error();
  const std::vector<float> sure = SureDisparities(*made, StarWithin(light_field.positions) > 1);
  const auto strays = static_cast<size_t>(kStrays * static_cast<double>(sure.size()));
  // Extend the range by one pixel of the reduced pictures at each end, to include surfaces close to
  // discarded outliers.
  const float low = std::max(sure[strays] - 1, -most);
  const float high = std::min(sure[sure.size() - 1 - strays] + 1, most);
  // If `factor` is not a power of 2, factor * (limit / factor) can exceed the limit by rounding.
  constexpr float kLimit = STARFOCUS_MAX_DISPARITY;
  return DisparityRange{std::max(low * static_cast<float>(factor), -kLimit),
                        std::min(high * static_cast<float>(factor), kLimit)};
}

Result<DisparityEstimate> EstimateDisparity(const std::string& where, const LightField& light_field,
                                            const DisparityRange& range, int threads) {
  const Images& views = light_field.views;
  const int used = EstimateViews(light_field.positions);
  Maker maker(threads, "estimating disparities");
  Result<MadeMap> made =
      MakeMap(where, {views, used, light_field.positions, nullptr, range, true, false}, &maker);
  if (!made) return made.error();
  return DisparityEstimate{std::move(made->map), range, DrawLevels(made->confidence, views[0]), {}};
}

Result<DisparityEstimate> RepairDisparity(const std::string& where, const LightField& light_field,
                                          const RepairOptions& options) {
  const FloatMap& given = light_field.disparity;
  const starfocus_disparity_stats stats = MeasureDisparity(given);
  if (stats.invalid == int64_t{given.width} * given.height) {
    return Expected(where, "a map with finite disparities", "none");
  }
  constexpr double kMost = STARFOCUS_MAX_DISPARITY;
  if (stats.min < -kMost || stats.max > kMost) {
    return Expected(where, "disparities from -" + Short(kMost) + " to " + Short(kMost),
                    Short(stats.min) + " to " + Short(stats.max));
  }
  const DisparityRange range = {float(std::max(stats.min - kRepairReach, -kMost)),
                                float(std::min(stats.max + kRepairReach, kMost))};
  const Images& views = light_field.views;
  const Positions& positions = light_field.positions;
  Maker maker(options.threads, "repairing disparities");
  const bool is_planar = !light_field.planar.samples.empty();
  const PlanarImage narrow = is_planar ? Narrow(light_field.planar) : PlanarImage();
  Result<MadeMap> made =
      MakeMap(where,
              {views, StarWithin(positions), positions, &given, range, options.confidence,
               options.coverage, is_planar ? &narrow : nullptr},
              &maker);
  if (!made) return made.error();
  DisparityEstimate estimate;
  if (options.confidence) estimate.confidence = DrawLevels(made->confidence, views[0]);
  estimate.map = std::move(made->map);
  estimate.coverage = std::move(made->coverage);
  const starfocus_disparity_stats ends = MeasureDisparity(estimate.map);
  estimate.range = {static_cast<float>(ends.min), static_cast<float>(ends.max)};
  return estimate;
}

}  // namespace starfocus
