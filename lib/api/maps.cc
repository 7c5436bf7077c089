// SPDX-License-Identifier: Apache-2.0
// C API: measures disparity maps, fills their gaps, and computes the focus of a tapped pixel and
// the largest aperture. The functions for disparity maps require no engine.
#include <cmath>
#include <limits>

#include "lib/api/validate.h"
#include "lib/base/fixed.h"
#include "lib/engine/engine.h"
#include "lib/engine/lens.h"
#include "lib/io/depth_map.h"
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

// Number of values to read on each side of the tapped pixel (docs/constants.md).
constexpr int32_t kAround = 3;
constexpr int32_t kSide = 2 * kAround + 1;

// Largest difference between a pixel's disparity and the disparity of its surface. Two pixels
// within kNear of one surface differ by at most kSurfaceStep, so no depth edge separates the
// pixels.
constexpr double kNear = kSurfaceStep / 2.0 / (1 << kDisparityBits);

// The value of a map that contains the middle of the tapped pixel, and the values around it.
struct Place {
  const starfocus_depth_map& map;
  int32_t x, y;

  // Calls act(disparity) for each known disparity up to `reach` values away, row by row.
  template <class Act>
  void ForKnown(int32_t reach, const Act& act) const {
    const int32_t left = Max(0, x - reach), right = Min(map.width - 1, x + reach);
    for (int32_t row = Max(0, y - reach); row <= Min(map.height - 1, y + reach); ++row) {
      float disparities[kSide];
      const int32_t count = right + 1 - left;
      ReadDisparities(map, left, row, count, disparities);
      for (int32_t k = 0; k < count; ++k) {
        if (IsFinite(disparities[k])) act(disparities[k]);
      }
    }
  }
  // Returns the disparity at the place; NaN if the disparity is unknown.
  double Own() const {
    float disparity;
    ReadDisparities(map, x, y, 1, &disparity);
    return disparity;
  }
};

// Known disparities around a place, in ascending order.
struct Sorted {
  float values[kSide * kSide];
  int32_t count = 0;

  void Insert(float value) {
    int32_t k = count++;
    for (; k > 0 && values[k - 1] > value; --k) values[k] = values[k - 1];
    values[k] = value;
  }
};

// Returns the range of the sorted values within kNear of `disparity`. At least one value must be
// within kNear of `disparity`.
Range RangeNear(const Sorted& sorted, double disparity) {
  Range part = {0, 0};
  while (part.first + 1 < sorted.count && sorted.values[part.first] < disparity - kNear) {
    ++part.first;
  }
  part.last = part.first + 1;
  while (part.last < sorted.count && sorted.values[part.last] <= disparity + kNear) ++part.last;
  return part;
}

double Median(const Sorted& sorted, const Range& part) {
  const float* middle = sorted.values + part.first + part.count() / 2;
  return part.count() % 2 != 0 ? double{middle[0]} : (double{middle[-1]} + middle[0]) / 2;
}

// Returns true if the place is known and a neighbour is on the same surface. The result is true for
// a pixel of a wire one pixel wide, but false for a single wrong pixel.
bool HasNeighbour(const Place& place, double disparity) {
  int32_t near = 0;
  place.ForKnown(1, [&](double value) { near += std::fabs(value - disparity) <= kNear ? 1 : 0; });
  return near > 1;  // the place itself is near
}

// Returns the disparity that has the most other disparities within kNear. If several disparities
// have equally many others within kNear, returns the smallest of these disparities.
double MostCommon(const Sorted& sorted) {
  int32_t most = 0, best = 0;
  for (int32_t k = 0; k < sorted.count; ++k) {
    const int32_t count = RangeNear(sorted, sorted.values[k]).count();
    if (count <= most) continue;
    most = count;
    best = k;
  }
  return sorted.values[best];
}

// Returns the value of a line of `values` values that contains the middle of pixel k, where the
// line is as long as `pixels` pixels.
int32_t ValueOf(int32_t k, int32_t pixels, int32_t values) {
  return static_cast<int32_t>((2 * int64_t{k} + 1) * values / (2 * int64_t{pixels}));
}

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
                                          int32_t height, starfocus_problem* problem) {
  starfocus_disparity_stats stats;
  Checker check = Enter(problem);
  CheckMap(disparity, stride, width, height, &check);
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
  const Place place = {*depth, ValueOf(x, width, depth->width), ValueOf(y, height, depth->height)};
  Sorted sorted;
  place.ForKnown(kAround, [&](float disparity) { sorted.Insert(disparity); });
  check.Need(sorted.count > 0, STARFOCUS_ERROR_NOT_FINITE, {"depth"},
             {"a finite disparity near the pixel"});
  if (!check.passed()) return check.status();
  const double own = place.Own();
  double surface = HasNeighbour(place, own) ? own : MostCommon(sorted);
  // Taking the median twice makes the focus less dependent on the noise of the tapped pixel.
  for (int round = 0; round < 2; ++round) {
    surface = Median(sorted, RangeNear(sorted, surface));
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
  CheckFocus(*params, &check);
  if (check.passed()) {
    *aperture = LargestAperture(reinterpret_cast<EngineState*>(engine)->config, *params);
  }
  return check.status();
}
