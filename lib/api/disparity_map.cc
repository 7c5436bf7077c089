// SPDX-License-Identifier: Apache-2.0
// C API: measures disparity maps and fills their gaps. The functions for disparity maps require no
// engine.
#include "lib/api/validate.h"
#include "lib/base/gaps.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// A row or a column of a map. Neighbouring elements are `step` floats apart in memory.
struct MapLine {
  float* data;
  size_t step;
  int32_t length;

  float& operator[](int32_t k) const { return data[static_cast<size_t>(k) * step]; }
};

void FillLine(const MapLine& line) { FillGaps(line, line.length, IsFinite); }

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_measure_disparity(const float* disparity, size_t stride, int32_t width,
                                             int32_t height, starfocus_disparity_stats* stats) {
  if (stats == nullptr) return STARFOCUS_ERROR_NULL;
  const starfocus_status status = CheckMap({disparity, stride}, width, height, nullptr);
  if (status != STARFOCUS_OK) return status;
  starfocus_disparity_stats found = {0, 0, 0};
  bool any = false;
  for (int32_t y = 0; y < height; ++y) {
    const float* row = disparity + static_cast<size_t>(y) * (stride / sizeof(float));
    for (int32_t x = 0; x < width; ++x) {
      const double d = row[x];
      if (!IsFinite(row[x])) {
        ++found.invalid;
      } else if (!any) {
        found.min = found.max = d;
        any = true;
      } else {
        found.min = d < found.min ? d : found.min;
        found.max = d > found.max ? d : found.max;
      }
    }
  }
  *stats = found;
  return STARFOCUS_OK;
}

starfocus_status starfocus_fill_disparity(float* disparity, size_t stride, int32_t width,
                                          int32_t height) {
  starfocus_disparity_stats stats;
  const starfocus_status status =
      starfocus_measure_disparity(disparity, stride, width, height, &stats);
  if (status != STARFOCUS_OK || stats.invalid == 0) return status;
  const size_t row_step = stride / sizeof(float);
  if (stats.invalid == int64_t{width} * height) return STARFOCUS_ERROR_ALL_INVALID;
  for (int32_t y = 0; y < height; ++y) {
    FillLine({disparity + static_cast<size_t>(y) * row_step, 1, width});
  }
  // Unknown values now remain only in rows without any known value, so all columns have equal gaps.
  for (int32_t x = 0; x < width; ++x) FillLine({disparity + x, row_step, height});
  return STARFOCUS_OK;
}
