// SPDX-License-Identifier: Apache-2.0
// C API: measures disparity maps and fills their gaps. The functions for disparity maps require no
// engine.
#include <limits>

#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/base/fixed.h"
#include "lib/io/depth_values.h"
#include "lib/io/gaps.h"
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

starfocus_status starfocus_measure_disparity(const starfocus_depth_map* depth,
                                             starfocus_disparity_stats* stats) {
  if (depth == nullptr || stats == nullptr) return STARFOCUS_ERROR_NULL;
  const starfocus_status status = CheckLoneMap(*depth, {STARFOCUS_MAX_SIZE, STARFOCUS_MAX_SIZE});
  if (status != STARFOCUS_OK) return status;
  constexpr int32_t kPiece = 256;  // number of values that are converted at once, on the stack
  float least = std::numeric_limits<float>::infinity(), most = -least;
  int64_t known = 0;
  for (int32_t y = 0; y < depth->height; ++y) {
    for (int32_t x = 0; x < depth->width; x += kPiece) {
      float piece[kPiece];
      const int32_t count = Min(kPiece, depth->width - x);
      ReadDisparities(*depth, x, y, count, piece);
      for (int32_t k = 0; k < count; ++k) {
        if (!IsFinite(piece[k])) continue;
        ++known;
        least = piece[k] < least ? piece[k] : least;
        most = piece[k] > most ? piece[k] : most;
      }
    }
  }
  *stats = {known != 0 ? least : 0.0, known != 0 ? most : 0.0,
            int64_t{depth->width} * depth->height - known};
  return STARFOCUS_OK;
}

starfocus_status starfocus_fill_disparity(float* disparity, size_t stride, int32_t width,
                                          int32_t height) {
  starfocus_disparity_stats stats;
  starfocus_status status = CheckMap({disparity, stride}, width, height, nullptr);
  if (status != STARFOCUS_OK) return status;
  const starfocus_depth_map map = starfocus_depth_float(disparity, stride, width, height);
  status = starfocus_measure_disparity(&map, &stats);
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
