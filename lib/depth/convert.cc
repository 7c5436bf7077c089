// SPDX-License-Identifier: Apache-2.0
// Converts a light field of any format to packed RGB codes and disparities, before an estimate or a
// repair.
#include <limits>

#include "lib/base/fixed.h"
#include "lib/depth/maps.h"
#include "lib/io/image.h"

namespace starfocus {
namespace {

// Number of rows that are converted together. ReadDepth converts values that these rows share once.
constexpr int32_t kRowsAtOnce = 8;

// Converts `height` rows of `width` samples as a set of at most `most_jobs` jobs. Calls
// convert(rows) for groups of rows. Stops after cancellation.
template <class Convert>
starfocus_status ForRowsAtOnce(int32_t width, int32_t height, int32_t most_jobs, Jobs* jobs,
                               const Convert& convert) {
  const int32_t count = Min(most_jobs, height);
  return ForEach(count, jobs, [&](int32_t index, int32_t) {
    CancelToken cancel(&jobs->call_progress);
    const Range part = PartOf({0, height}, index, count);
    for (int32_t y = part.first; y < part.last; y += kRowsAtOnce) {
      const Range rows = {y, Min(y + kRowsAtOnce, part.last)};
      if (!cancel.Spend(int64_t{width} * (rows.last - rows.first))) return;
      convert(rows);
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

// Converts the rows [rows.first, rows.last) of a map, at most kRowsAtOnce rows.
void ConvertRows(const simd::ImageKernels& kernels, const DepthSource& map, int32_t width,
                 const Range& rows, float* disparity) {
  for (int32_t x = 0; x < width; x += kDepthPiece) {
    int16_t fixed[kRowsAtOnce * kDepthPiece];
    const Plane<int16_t> piece = {fixed, kDepthPiece, 0, rows.first};
    const int32_t count = Min(kDepthPiece, width - x);
    ReadDepth(kernels, map, {x, rows.first, count, rows.last - rows.first}, piece);
    for (int32_t y = rows.first; y < rows.last; ++y) {
      WriteDisparities(map.rule, piece.Row(y), count, disparity + ptrdiff_t{y} * width + x);
    }
  }
}

}  // namespace

starfocus_status ConvertField(const FullConfig& config, const SweepSetup& setup, Arena* arena,
                              Jobs* jobs, starfocus_light_field* field) {
  const simd::ImageKernels& kernels = simd::BestImageKernels();
  const int32_t width = config.width, height = config.height;
  const int32_t most_jobs = setup.columns * setup.rows;
  const auto columns = static_cast<size_t>(width), rows = static_cast<size_t>(height);
  const size_t stride = 3 * columns;
  for (int32_t k = 0; k < config.views; ++k) {
    uint8_t* const rgb = arena->Take<uint8_t>(stride, rows);
    if (rgb == nullptr || IsInPlace(field->views[k])) continue;
    const ImageSource image = PlanesOf<const uint8_t>(field->views[k]);
    const starfocus_status status =
        ForRowsAtOnce(width, height, most_jobs, jobs, [&](const Range& group) {
          for (int32_t y = group.first; y < group.last; ++y) {
            ReadCodes(kernels, image, 0, y, width, rgb + static_cast<size_t>(y) * stride);
          }
        });
    if (status != STARFOCUS_OK) return status;
    field->views[k] = starfocus_image_rgb(rgb, stride);
  }
  if (!setup.repairs) return STARFOCUS_OK;
  float* const disparity = arena->Take<float>(columns, rows);
  uint32_t* const places = arena->Take<uint32_t>(columns);
  if (disparity == nullptr || IsInPlace(field->depth, width, height)) return STARFOCUS_OK;
  starfocus_depth_map& map = field->depth;
  FillColumns(width, map.width, 0, width, places);
  const simd::DepthRule rule = RuleOf(map, MinDisparity(config), MaxDisparity(config));
  const DepthSource source = {map, rule, width, height, places};
  const starfocus_status status = ForRowsAtOnce(
      width, height, most_jobs, jobs,
      [&](const Range& group) { ConvertRows(kernels, source, width, group, disparity); });
  map = starfocus_depth_float(disparity, sizeof(float) * columns, width, height);
  return status;
}

}  // namespace starfocus
