// SPDX-License-Identifier: Apache-2.0
// C API: measures disparity maps, fills their gaps, and computes the focus of a tapped pixel and
// the largest aperture. The functions for disparity maps require no engine.
#include <cmath>
#include <cstring>

#include "lib/api/validate.h"
#include "lib/base/fixed.h"
#include "lib/engine/engine.h"
#include "lib/engine/lens.h"
#include "lib/io/depth_map.h"

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

// Number of values to read on each side of the tapped pixel (docs/constants.md).
constexpr int32_t kAround = 3;
constexpr int32_t kSide = 2 * kAround + 1;

// Largest difference between a pixel's disparity and the disparity of its surface. Two pixels
// within kNear of one surface differ by at most kSurfaceStep, so no depth edge separates the
// pixels.
constexpr double kNear = kSurfaceStep / 2.0 / (1 << kDisparityBits);

// Calls act(disparity) for each known disparity up to `reach` values from value (x, y) of a map,
// row by row.
template <class Act>
void ForKnown(const starfocus_depth_map& map, int32_t x, int32_t y, int32_t reach, const Act& act) {
  const int32_t left = Max(0, x - reach), count = Min(map.width - 1, x + reach) + 1 - left;
  for (int32_t row = Max(0, y - reach); row <= Min(map.height - 1, y + reach); ++row) {
    float disparities[kSide];
    ReadDisparities(map, left, row, count, disparities);
    for (int32_t k = 0; k < count; ++k) {
      if (IsFinite(disparities[k])) act(disparities[k]);
    }
  }
}

// Returns the range of `count` values in ascending order that lie within kNear of `disparity`. At
// least one value must be within kNear of `disparity`.
Range RangeNear(const float* values, int32_t count, double disparity) {
  Range part = {0, 0};
  while (part.first + 1 < count && values[part.first] < disparity - kNear) ++part.first;
  part.last = part.first + 1;
  while (part.last < count && values[part.last] <= disparity + kNear) ++part.last;
  return part;
}

// Returns the disparity that has the most other disparities within kNear. If several disparities
// have equally many others within kNear, returns the smallest of these disparities.
double MostCommon(const float* values, int32_t count) {
  int32_t most = 0, best = 0;
  for (int32_t k = 0; k < count; ++k) {
    const int32_t near = RangeNear(values, count, values[k]).count();
    if (near <= most) continue;
    most = near;
    best = k;
  }
  return values[best];
}

// Returns the value of a line of `values` values that contains the middle of pixel k, where the
// line is as long as `pixels` pixels.
int32_t ValueOf(int32_t k, int32_t pixels, int32_t values) {
  return static_cast<int32_t>((2 * int64_t{k} + 1) * values / (2 * int64_t{pixels}));
}

// Smallest and largest of all finite values, and their number. The values are compared as integers
// in the same order, without branches, so that compilers vectorize the loop.
struct Extremes {
  int32_t least = INT32_MAX, most = INT32_MIN;
  int64_t known = 0;

  void Add(const float* values, int32_t count) {
    constexpr int32_t kInfinity = 0x7f800000;
    int32_t low = least, high = most, finite = 0;
    for (int32_t k = 0; k < count; ++k) {
      int32_t bits;
      std::memcpy(&bits, values + k, sizeof(bits));
      const int32_t mask = -static_cast<int32_t>((bits & INT32_MAX) < kInfinity);  // all or no bits
      const int32_t ordered = Reordered(bits) & mask;
      low = Min(low, ordered | (INT32_MAX & ~mask));
      high = Max(high, ordered | (INT32_MIN & ~mask));
      finite -= mask;
    }
    least = low;
    most = high;
    known += finite;
  }

  // Converts the bits of a value to an integer in the order of the values, or back.
  static int32_t Reordered(int32_t bits) { return bits ^ ((bits >> 31) & INT32_MAX); }

  // Returns the value of an ordered integer, or 0 if there are no values.
  float Value(int32_t ordered) const {
    const int32_t bits = known != 0 ? Reordered(ordered) : 0;
    float value;
    std::memcpy(&value, &bits, sizeof(value));
    return value + 0.0F;  // -0 becomes 0
  }
};

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_measure_disparity(const starfocus_depth_map* depth,
                                             starfocus_disparity_stats* stats,
                                             starfocus_problem* problem) {
  Checker check = Enter(problem);
  check.NotNull(depth, "depth");
  check.NotNull(stats, "stats");
  if (!check.passed()) return check.status();
  CheckLoneMap(*depth, STARFOCUS_MAX_SIZE, STARFOCUS_MAX_SIZE, &check);
  if (!check.passed()) return check.status();
  constexpr int32_t kPiece = 256;  // number of values that are converted at once, on the stack
  Extremes extremes;
  for (int32_t y = 0; y < depth->height; ++y) {
    for (int32_t x = 0; x < depth->width; x += kPiece) {
      float piece[kPiece];
      const int32_t count = Min(kPiece, depth->width - x);
      ReadDisparities(*depth, x, y, count, piece);
      extremes.Add(piece, count);
    }
  }
  *stats = {extremes.Value(extremes.least), extremes.Value(extremes.most),
            int64_t{depth->width} * depth->height - extremes.known};
  return STARFOCUS_OK;
}

starfocus_status starfocus_fill_disparity(float* disparity, size_t stride, int32_t width,
                                          int32_t height, starfocus_problem* problem) {
  starfocus_disparity_stats stats;
  Checker check = Enter(problem);
  CheckMap(disparity, stride, width, height, "disparity", "stride", &check);
  if (!check.passed()) return check.status();
  const starfocus_depth_map map = starfocus_depth_float(disparity, stride, width, height);
  check.Add(starfocus_measure_disparity(&map, &stats, problem));
  if (!check.passed() || stats.invalid == 0) return check.status();
  const size_t row_step = stride / sizeof(float);
  if (stats.invalid == int64_t{width} * height) {
    check.Need(false, STARFOCUS_ERROR_ALL_INVALID, {"disparity"}, {"a finite value"});
    return check.status();
  }
  for (int32_t y = 0; y < height; ++y) {
    FillLine({disparity + static_cast<size_t>(y) * row_step, 1, width});
  }
  // Unknown values now remain only in rows without any known value, so all columns have equal gaps.
  for (int32_t x = 0; x < width; ++x) FillLine({disparity + x, row_step, height});
  return STARFOCUS_OK;
}

starfocus_status starfocus_focus_at(const starfocus_depth_map* depth, int32_t width, int32_t height,
                                    int32_t x, int32_t y, double* focus,
                                    starfocus_problem* problem) {
  Checker check = Enter(problem);
  check.NotNull(depth, "depth");
  check.NotNull(focus, "focus");
  if (!check.passed()) return check.status();
  CheckLoneMap(*depth, width, height, &check);
  if (!check.passed()) return check.status();
  check.In({"x", double(x)}, {"inside the picture", 0, width - 1.0});
  check.In({"y", double(y)}, {"inside the picture", 0, height - 1.0});
  if (!check.passed()) return check.status();
  const int32_t column = ValueOf(x, width, depth->width), row = ValueOf(y, height, depth->height);
  float known[kSide * kSide];  // known disparities around the pixel, in ascending order
  int32_t count = 0;
  ForKnown(*depth, column, row, kAround, [&](float disparity) {
    int32_t k = count++;
    for (; k > 0 && known[k - 1] > disparity; --k) known[k] = known[k - 1];
    known[k] = disparity;
  });
  check.Need(count > 0, STARFOCUS_ERROR_NOT_FINITE, {"depth"},
             {"a finite disparity near the pixel"});
  if (!check.passed()) return check.status();
  float own;  // NaN if the disparity of the pixel is unknown
  ReadDisparities(*depth, column, row, 1, &own);
  // A pixel of a wire one pixel wide has a neighbour on its surface, a single wrong pixel has none.
  int32_t near = 0;  // includes the pixel itself
  ForKnown(*depth, column, row, 1,
           [&](double disparity) { near += std::fabs(disparity - own) <= kNear ? 1 : 0; });
  double surface = near > 1 ? double{own} : MostCommon(known, count);
  // Taking the median twice makes the focus less dependent on the noise of the tapped pixel.
  for (int round = 0; round < 2; ++round) {
    const Range part = RangeNear(known, count, surface);
    const float* const middle = known + part.first + part.count() / 2;
    surface = part.count() % 2 != 0 ? double{middle[0]} : (double{middle[-1]} + middle[0]) / 2;
  }
  *focus = surface;
  return STARFOCUS_OK;
}

starfocus_status starfocus_largest_aperture(starfocus_engine* engine,
                                            const starfocus_params* params, double* aperture) {
  Checker check = Enter(engine);
  check.NotNull(params, "params");
  check.NotNull(aperture, "aperture");
  if (!check.passed()) return check.status();
  starfocus_params full = DefaultParams();
  check.Read(*params, "params.size", &full);
  CheckFocus(full, &check);
  if (check.passed()) {
    *aperture = LargestAperture(reinterpret_cast<EngineState*>(engine)->config, full);
  }
  return check.status();
}
