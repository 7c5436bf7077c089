// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "lib/base/arena.h"
#include "lib/base/fixed.h"
#include "lib/depth/maps.h"
#include "lib/io/depth_rows.h"
#include "lib/io/image_rows.h"
#include "lib/io/rows.h"

namespace starfocus {
namespace {

// Converts the rows of one image or of the map. Each job converts one range of rows.
struct ConvertJob {
  const simd::ImageKernels& kernels;
  int32_t width, height, jobs;
  CallProgress* progress;
  ImageSource image;
  uint8_t* rgb;
  DepthSource depth;
  float* disparity;
};

const ConvertJob& JobOf(const void* data) { return *static_cast<const ConvertJob*>(data); }

// Number of rows that are converted together. ReadDepth converts values that these rows share once.
constexpr int32_t kGroupRows = 8;

// Calls convert(rows) for groups of rows of a job. Stops after cancellation.
template <class Convert>
void ForGroups(const ConvertJob& job, int32_t index, const Convert& convert) {
  CancelToken cancel(job.progress);
  const Range part = PartOf({0, job.height}, index, job.jobs);
  for (int32_t y = part.first; y < part.last; y += kGroupRows) {
    const Range rows = {y, Min(y + kGroupRows, part.last)};
    if (!cancel.Spend(int64_t{job.width} * (rows.last - rows.first))) return;
    convert(rows);
  }
}

void ConvertImage(const void* data, int32_t index, int32_t) {
  const ConvertJob& job = JobOf(data);
  const size_t stride = 3 * static_cast<size_t>(job.width);
  ForGroups(job, index, [&](const Range& rows) {
    for (int32_t y = rows.first; y < rows.last; ++y) {
      ReadCodes(job.kernels, job.image, 0, y, job.width, job.rgb + static_cast<size_t>(y) * stride);
    }
  });
}

// Converts `count` fixed-point disparities to pixels, limited to the range of the rule.
void WriteDisparities(const simd::DepthRule& rule, const int16_t* fixed, int32_t count,
                      float* out) {
  constexpr float kPixel = 1.0F / (1 << kDisparityBits);
  for (int32_t k = 0; k < count; ++k) {
    const float disparity = static_cast<float>(fixed[k]) * kPixel;
    const float inside = disparity < rule.low    ? rule.low
                         : disparity > rule.high ? rule.high
                                                 : disparity;
    out[k] = fixed[k] == simd::kNoSurface ? std::numeric_limits<float>::quiet_NaN() : inside;
  }
}

void ConvertMap(const void* data, int32_t index, int32_t) {
  const ConvertJob& job = JobOf(data);
  ForGroups(job, index, [&](const Range& rows) {
    for (int32_t x = 0; x < job.width; x += kDepthPiece) {
      int16_t fixed[kGroupRows * kDepthPiece];
      const Plane<int16_t> piece = {fixed, kDepthPiece, 0, rows.first};
      const int32_t count = Min(kDepthPiece, job.width - x);
      ReadDepth(job.kernels, job.depth, {x, rows.first, count, rows.last - rows.first}, piece);
      for (int32_t y = rows.first; y < rows.last; ++y) {
        WriteDisparities(
            job.depth.rule, piece.Row(y), count,
            job.disparity + static_cast<size_t>(y) * static_cast<size_t>(job.width) + x);
      }
    }
  });
}

}  // namespace

size_t LayOutConverted(const starfocus_depth_config& config, bool has_map, void* base,
                       ConvertedMemory* memory) {
  const auto width = static_cast<size_t>(config.width), height = static_cast<size_t>(config.height);
  Arena arena(base);
  *memory = {};
  for (int32_t k = 0; k < config.views; ++k) {
    memory->views[k] = arena.Take<uint8_t>(3 * width, height);
  }
  if (has_map) memory->disparity = arena.Take<float>(width, height);
  if (has_map) memory->columns = arena.Take<uint32_t>(width);
  return arena.Bytes();
}

starfocus_status ConvertField(const starfocus_depth_config& config, const ConvertedMemory& memory,
                              int32_t most_jobs, Jobs* jobs, starfocus_light_field* field) {
  const int32_t width = config.width, height = config.height, count = Min(most_jobs, height);
  ConvertJob job = {
      simd::BestImageKernels(), width, height, count, &jobs->call_progress, {}, {}, {}, {}};
  for (int32_t k = 0; k < config.views; ++k) {
    if (IsInPlace(field->views[k])) continue;
    job.image = PlanesOf<const uint8_t>(field->views[k]);
    job.rgb = memory.views[k];
    const starfocus_status status = RunJobSet(ConvertImage, &job, count, jobs);
    if (status != STARFOCUS_OK) return status;
    field->views[k] = starfocus_image_rgb(job.rgb, 3 * static_cast<size_t>(width));
  }
  starfocus_depth_map& map = field->depth;
  if (memory.disparity == nullptr || IsInPlace(map, width, height)) return STARFOCUS_OK;
  FillColumns(width, map.width, 0, width, memory.columns);
  const simd::DepthRule rule = RuleOf(map, static_cast<float>(config.disparity_min),
                                      static_cast<float>(config.disparity_max));
  job.depth = {map, rule, width, height, memory.columns};
  job.disparity = memory.disparity;
  const starfocus_status status = RunJobSet(ConvertMap, &job, count, jobs);
  map = starfocus_depth_float(job.disparity, sizeof(float) * static_cast<size_t>(width), width,
                              height);
  return status;
}

}  // namespace starfocus
