// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/converted_field.h"

#include <limits>

#include "lib/base/arena.h"
#include "lib/base/fixed.h"
#include "lib/base/rows.h"
#include "lib/convert/depth_rows.h"
#include "lib/convert/image_rows.h"

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

// Calls convert(y) for each row of a job.
template <class Convert>
void ForRows(const ConvertJob& job, int32_t index, const Convert& convert) {
  CancelToken cancel(job.progress);
  const int64_t height = job.height;
  const auto last = static_cast<int32_t>(height * (index + 1) / job.jobs);
  for (auto y = static_cast<int32_t>(height * index / job.jobs); y < last; ++y) {
    if (!cancel.Spend(job.width)) return;
    convert(y);
  }
}

void ConvertImage(const void* data, int32_t index, int32_t) {
  const ConvertJob& job = JobOf(data);
  const size_t stride = 3 * static_cast<size_t>(job.width);
  ForRows(job, index, [&](int32_t y) {
    ReadCodes(job.kernels, job.image, 0, y, job.width, job.rgb + static_cast<size_t>(y) * stride);
  });
}

void ConvertMap(const void* data, int32_t index, int32_t) {
  constexpr float kPixel = 1.0F / (1 << kDisparityBits);
  constexpr int32_t kPiece = 256;
  const ConvertJob& job = JobOf(data);
  const simd::DepthRule& rule = job.depth.rule;
  ForRows(job, index, [&](int32_t y) {
    float* const row = job.disparity + static_cast<size_t>(y) * static_cast<size_t>(job.width);
    for (int32_t x = 0; x < job.width; x += kPiece) {
      int16_t fixed[kPiece];
      const int32_t count = Min(kPiece, job.width - x);
      ReadDepth(job.kernels, job.depth, {x, y, count, 1}, {fixed, 0, 0, 0});
      for (int32_t k = 0; k < count; ++k) {
        const float disparity = static_cast<float>(fixed[k]) * kPixel;
        const float inside = disparity < rule.low    ? rule.low
                             : disparity > rule.high ? rule.high
                                                     : disparity;
        row[x + k] =
            fixed[k] == simd::kNoSurface ? std::numeric_limits<float>::quiet_NaN() : inside;
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
                              int32_t most_jobs, JobSet* jobs, starfocus_light_field* field) {
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
  FillColumns(width, map.width, memory.columns);
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
