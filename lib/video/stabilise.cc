// SPDX-License-Identifier: Apache-2.0
#include "lib/video/stabilise.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "simd/kernels.h"

namespace starfocus {
namespace {

// Largest number of frames of the mean scale of maps.
constexpr int32_t kMostLength = 8;

// Colour difference of a pixel and its eight neighbours, summed over R, G and B, up to which the
// pixel follows a motion: 9 codes on average. More where the picture has contrast, because motions
// are whole pixels.
constexpr uint16_t kMostColour = 27 * 9;

// Weight of the variance of steps against that of disparities in the prior of FitDrift.
constexpr double kDriftNoise = 8;

// Motions that the pixels of a block may follow: those of the block and of its neighbours.
struct Candidates {
  Motion motions[9];
  int32_t count = 0;

  Candidates(const MotionField& field, int32_t column, int32_t row) {
    Add(field.At(column, row));
    for (int32_t y = Max(row - 1, 0); y <= Min(row + 1, field.rows - 1); ++y) {
      for (int32_t x = Max(column - 1, 0); x <= Min(column + 1, field.columns - 1); ++x) {
        Add(field.At(x, y));
      }
    }
  }
  void Add(const Motion& motion) {
    if (std::find(motions, motions + count, motion) == motions + count) motions[count++] = motion;
  }
};

constexpr auto kBlock = static_cast<int32_t>(simd::kFollowed);
static_assert(kBlock == kMotionBlock);

// Copies the surfaces of those pixels of `block` that have a cost, from the frame before. Returns
// their number.
int32_t CopyBlock(const Stabiliser& s, const Rect& block, const Motion* motions,
                  const uint16_t* costs, const uint16_t* choices) {
  const StableFrame &before = s.frames[s.current], &now = s.frames[1 - s.current];
  const Rect part = Clipped(block, s.config.width, s.config.height);
  int32_t followed = 0;
  for (int32_t y = part.y; y < part.y + part.height; ++y) {
    const ptrdiff_t row = ptrdiff_t{y} * s.config.width;  // of the planes without a border
    const int32_t first = kBlock * (y - block.y) - block.x;
    for (int32_t x = part.x; x < part.x + part.width; ++x) {
      const ptrdiff_t at = row + x;
      now.count.data[at] = 0;
      if (costs[first + x] == simd::kNoCost) continue;
      const Motion& motion = motions[choices[first + x]];
      const int32_t from_x = x + motion.across, from_y = y + motion.down;
      if (!Contains({0, 0, s.config.width, s.config.height}, from_x, from_y)) continue;
      ++followed;
      const ptrdiff_t from = ptrdiff_t{from_y} * s.config.width + from_x;
      now.count.data[at] = before.count.data[from];
      now.other.data[at] = before.other.data[from];
      now.others.data[at] = before.others.data[from];
      *At(now.disparity, x, y) = *At(before.disparity, from_x, from_y);
      if (!now.has_coverage) continue;
      now.coverage.data[at] =
          before.has_coverage ? before.coverage.data[from] : s.coverage.data[at];
    }
  }
  return followed;
}

// Finds the pixels of a block in the frame before, and copies their surfaces. Returns the number of
// pixels that were found.
int32_t FollowBlock(const Stabiliser& s, int32_t column, int32_t row) {
  const StableFrame &before = s.frames[s.current], &now = s.frames[1 - s.current];
  const int32_t x0 = column * kBlock, y0 = row * kBlock;
  const Candidates candidates(s.motion[0], column, row);
  uint16_t limits[kBlock * kBlock], costs[kBlock * kBlock], choices[kBlock * kBlock];
  std::fill_n(costs, kBlock * kBlock, simd::kNoCost);
  s.kernels->LimitBlock(PixelAt(now.rgb, x0, y0), now.rgb.stride, kMostColour, limits);
  for (int32_t k = 0; k < candidates.count; ++k) {
    const int32_t x = x0 + candidates.motions[k].across, y = y0 + candidates.motions[k].down;
    if (x < -kBlock || y < -kBlock || x > s.config.width || y > s.config.height) continue;
    const simd::FollowedBlock block = {
        PixelAt(now.rgb, x0, y0), PixelAt(before.rgb, x, y),  now.rgb.stride,
        At(s.given, x0, y0),      At(before.disparity, x, y), s.given.stride,
        before.disparity.stride};
    s.kernels->FollowBlock(block, limits, static_cast<uint16_t>(k), costs, choices);
  }
  return CopyBlock(s, {x0, y0, kBlock, kBlock}, candidates.motions, costs, choices);
}

// Adds the pixels of a row of blocks whose surface continues within `tolerance`, to find the change
// of all disparities. Every sixteenth pixel is enough.
DriftSums SumDrift(const Stabiliser& s, int32_t row, int32_t tolerance, const Drift& drift) {
  const StableFrame& now = s.frames[1 - s.current];
  DriftSums sums = {};
  const int32_t last = Min(s.config.height, (row + 1) * kMotionBlock);
  for (int32_t y = row * kMotionBlock; y < last; y += 4) {
    for (int32_t x = 0; x < s.config.width; x += 4) {
      const int32_t given = s.given.Row(y)[x];
      if (now.count.Row(y)[x] == 0 || given == simd::kNoSurface) continue;
      const int32_t before = now.disparity.Row(y)[x];
      if (std::abs(Drifted(drift, given) - before) > tolerance) continue;
      const int32_t step = given - before;
      ++sums.count;
      sums.x += before;
      sums.y += step;
      sums.xx += before * before;
      sums.xy += before * step;
      sums.yy += step * step;
    }
  }
  return sums;
}

// Returns the drift of least squares. Its scale is at most 1/4. The steps are fitted to the
// disparities before, which are means of several frames: noise of the disparities that a line is
// fitted to makes the line flatter.
Drift FitDrift(const DriftSums& s) {
  if (s.count == 0) return {0, 0};
  const double n = double(s.count), mean_x = double(s.x) / n, mean_y = double(s.y) / n;
  const double variance = double(s.xx) / n - mean_x * mean_x;
  const double covariance = double(s.xy) / n - mean_x * mean_y;
  const double noise = double(s.yy) / n - mean_y * mean_y;
  // The prior of no change of scale has the weight of disparities that vary by a pixel, or more if
  // the steps are noise.
  const double prior = (1 << (2 * kDisparityBits)) + kDriftNoise * noise;
  const double found = covariance / (variance + prior);
  const double slope = found < -1.0 / 5 ? -1.0 / 5 : found > 1.0 / 3 ? 1.0 / 3 : found;
  // A disparity of the map is now (1 + slope) times that before, plus a constant.
  const double scale = -slope / (1 + slope);
  const double offset = (slope * mean_x - mean_y) / (1 + slope);
  return {static_cast<int32_t>(scale * (1 << kDriftBits)), static_cast<int32_t>(offset)};
}

// Takes memory of a plane of whole blocks, with a border for motions that lead out of the picture.
template <class T>
Plane<T> TakePadded(const FullConfig& config, int32_t samples, Arena* arena) {
  constexpr int32_t kBorder = kBlock + 1;
  const int32_t columns = MotionBlocks(config.width) * kBlock + 2 * kBorder;
  const int32_t rows = MotionBlocks(config.height) * kBlock + 2 * kBorder;
  const auto stride = static_cast<size_t>(columns) * static_cast<size_t>(samples);
  T* const data = arena->Take<T>(stride, static_cast<size_t>(rows));
  if (data == nullptr) return {};
  std::memset(data, 0, stride * static_cast<size_t>(rows) * sizeof(T));
  return {data + kBorder * (static_cast<ptrdiff_t>(stride) + samples), stride};
}

}  // namespace

void PadColours(const FullConfig& config, const Plane<uint8_t>& rgb) {
  const int32_t width = config.width, height = config.height;
  const int32_t right = MotionBlocks(width) * kBlock, bottom = MotionBlocks(height) * kBlock;
  for (int32_t y = 0; y < height; ++y) {
    for (int32_t x = -kBlock - 1; x < right + kBlock + 1; x = x == -1 ? width : x + 1) {
      std::memcpy(PixelAt(rgb, x, y), PixelAt(rgb, x < 0 ? 0 : width - 1, y), 3);
    }
  }
  const auto bytes = static_cast<size_t>(3 * (right + 2 * kBlock + 2));
  for (int32_t y = -kBlock - 1; y < bottom + kBlock + 1; y = y == -1 ? height : y + 1) {
    std::memcpy(PixelAt(rgb, -kBlock - 1, y), PixelAt(rgb, -kBlock - 1, y < 0 ? 0 : height - 1),
                bytes);
  }
}

void TakeStabiliser(const FullConfig& config, Arena* arena, Stabiliser* s) {
  const auto width = static_cast<size_t>(config.width), height = static_cast<size_t>(config.height);
  s->config = config;
  s->kernels = &simd::BestVideoKernels();
  s->jobs = arena->Take<Jobs>(1);
  const auto bands = static_cast<size_t>(MotionBlocks(config.height));
  auto* const progress = arena->Take<std::atomic<uint32_t>>(ProgressWords(bands));
  for (StableFrame& frame : s->frames) {
    frame.rgb = TakePadded<uint8_t>(config, 3, arena);
    frame.disparity = TakePadded<int16_t>(config, 1, arena);
    frame.luma = TakePyramid(config.width, config.height, arena);
    frame.other = {arena->Take<int16_t>(width, height), width};
    frame.count = {arena->Take<uint8_t>(width, height), width};
    frame.others = {arena->Take<uint8_t>(width, height), width};
    frame.coverage = {arena->Take<uint8_t>(width, height), width};
  }
  s->given = TakePadded<int16_t>(config, 1, arena);
  s->coverage = {arena->Take<uint8_t>(width, height), width};
  s->relations = {arena->Take<uint8_t>(width, height), width};
  s->columns = arena->Take<uint32_t>(width);
  TakeMotion(s->frames[0].luma, arena, s->motion);
  s->sums = arena->Take<DriftSums>(bands);
  s->sums_of_rows = arena->Take<int64_t>(bands);
  if (s->jobs == nullptr) return;
  new (s->jobs) Jobs();
  s->jobs->max_workers = config.max_workers;
  s->jobs->progress = progress;
}

namespace {

// Returns the largest difference between disparities of one surface in the map of the next frame.
int32_t ToleranceOf(const Stabiliser& s) {
  int32_t least = INT16_MAX, most = INT16_MIN;
  for (int32_t y = 0; y < s.config.height; ++y) {
    const int16_t* const row = s.given.Row(y);
    for (int32_t x = 0; x < s.config.width; ++x) {
      if (row[x] == simd::kNoSurface) continue;
      least = Min(least, row[x]);
      most = Max(most, row[x]);
    }
  }
  return Max(1 << kDisparityBits, (most - least) / 16);
}

// Returns the change of all disparities of the map since the frame before.
starfocus_status FindDrift(const Stabiliser& s, Drift* drift) {
  const int32_t rows = MotionBlocks(s.config.height), tolerance = s.tolerance;
  *drift = {};
  for (int32_t pass = 0; pass < 3; ++pass) {
    const int32_t reach = pass == 0 ? 3 * tolerance : tolerance;
    const starfocus_status status = ForEach(
        rows, s.jobs, [&](int32_t row, int32_t) { s.sums[row] = SumDrift(s, row, reach, *drift); });
    if (status != STARFOCUS_OK) return status;
    DriftSums sum = {};
    for (int32_t row = 0; row < rows; ++row) {
      sum.count += s.sums[row].count;
      sum.x += s.sums[row].x;
      sum.y += s.sums[row].y;
      sum.xx += s.sums[row].xx;
      sum.xy += s.sums[row].xy;
      sum.yy += s.sums[row].yy;
    }
    *drift = FitDrift(sum);
  }
  return STARFOCUS_OK;
}

// Calls work(row) for each row of blocks, and adds the results to *sum.
template <class Work>
starfocus_status AddRows(const Stabiliser& s, const Work& work, int64_t* sum) {
  const int32_t rows = MotionBlocks(s.config.height);
  const starfocus_status status =
      ForEach(rows, s.jobs, [&](int32_t row, int32_t) { s.sums_of_rows[row] = work(row); });
  if (status != STARFOCUS_OK) return status;
  for (int32_t row = 0; row < rows; ++row) *sum += s.sums_of_rows[row];
  return STARFOCUS_OK;
}

// Follows the pixels of the next frame to the current frame. Sets *followed to their number.
starfocus_status FollowFrame(const Stabiliser& s, int64_t* followed) {
  const StableFrame &before = s.frames[s.current], &now = s.frames[1 - s.current];
  const starfocus_status status = FindMotion(*s.kernels, before.luma, now.luma, s.motion, s.jobs);
  if (status != STARFOCUS_OK) return status;
  const auto follow = [&](int32_t row) {
    int64_t sum = 0;
    for (int32_t column = 0; column < s.motion[0].columns; ++column) {
      sum += FollowBlock(s, column, row);
    }
    return sum;
  };
  return AddRows(s, follow, followed);
}

// Fuses the next frame. Adds the pixels that keep their surface to *kept.
starfocus_status FuseFrame(const Stabiliser& s, int32_t length, const Drift& drift, int64_t* kept) {
  const StableFrame& now = s.frames[1 - s.current];
  // The mean scale is that of all maps since the start, so that of the frame before changes, too.
  const int32_t parts = length + 1;
  const Fusion fusion = {s.config.width,
                         s.config.height,
                         s.tolerance,
                         {drift.scale - drift.scale / parts, drift.offset - drift.offset / parts},
                         {-drift.scale / parts, -drift.offset / parts},
                         s.given,
                         now.disparity,
                         now.other,
                         now.count,
                         now.others,
                         s.relations,
                         s.coverage,
                         now.has_coverage ? now.coverage : Plane<uint8_t>()};
  const auto rows_of = [&](int32_t row) {
    return Range{row * kMotionBlock, Min((row + 1) * kMotionBlock, s.config.height)};
  };
  const starfocus_status status =
      ForEach(MotionBlocks(s.config.height), s.jobs,
              [&](int32_t row, int32_t) { RelateRows(fusion, rows_of(row)); });
  if (status != STARFOCUS_OK) return status;
  return AddRows(
      s, [&](int32_t row) { return FuseRows(fusion, rows_of(row)); }, kept);
}

}  // namespace

starfocus_status Stabilise(Stabiliser* s, StabiliserReport* report) {
  *report = {};
  const StableFrame& now = s->frames[1 - s->current];
  const int64_t pixels = int64_t{s->config.width} * s->config.height;
  int32_t length = s->length;
  s->tolerance = ToleranceOf(*s);
  starfocus_status status = FillPyramid({now.rgb.data, now.rgb.stride, 0, 0}, now.luma, s->jobs);
  if (status == STARFOCUS_OK && length > 0) status = FollowFrame(*s, &report->followed);
  if (status != STARFOCUS_OK) return status;
  report->is_cut = length > 0 && 5 * report->followed < 2 * pixels;
  if (length == 0 || report->is_cut) {
    length = 0;
    report->followed = 0;
    for (int32_t y = 0; y < s->config.height; ++y) {
      std::memset(now.count.Row(y), 0, static_cast<size_t>(s->config.width));
    }
  } else {
    status = FindDrift(*s, &report->drift);
  }
  if (status == STARFOCUS_OK) status = FuseFrame(*s, length, report->drift, &report->kept);
  if (status != STARFOCUS_OK) return status;
  s->length = Min(length + 1, kMostLength);
  s->current = 1 - s->current;
  return STARFOCUS_OK;
}

}  // namespace starfocus
