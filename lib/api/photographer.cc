// SPDX-License-Identifier: Apache-2.0
// C API: converts a tapped pixel to a focus, and an f-stop to an aperture.
#include <cmath>

#include "lib/api/validate.h"
#include "lib/base/fixed.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Number of pixels to read on each side of the tapped pixel (docs/constants.md).
constexpr int32_t kAround = 3;
constexpr int32_t kSide = 2 * kAround + 1;

// Largest difference between a pixel's disparity and the disparity of its surface. Two pixels
// within kNear of one surface differ by at most kSurfaceStep, so no depth edge separates the
// pixels.
constexpr double kNear = kSurfaceStep / 2.0 / (1 << kDisparityBits);

struct Map {
  const float* data;
  size_t row_step;  // distance between rows, in floats
  int32_t width, height;

  float At(int32_t x, int32_t y) const {
    return data[static_cast<size_t>(y) * row_step + static_cast<size_t>(x)];
  }
};

// Disparities of the pixels around a pixel, in ascending order.
struct Sorted {
  float values[kSide * kSide];  // in ascending order
  int32_t count = 0;

  void Insert(float value) {
    int32_t k = count++;
    for (; k > 0 && values[k - 1] > value; --k) values[k] = values[k - 1];
    values[k] = value;
  }
};

// Sorts the disparities of the 7 x 7 pixels around pixel (x, y). Returns false if one of these
// disparities is not finite.
bool SortAround(const Map& map, int32_t x, int32_t y, Sorted* sorted) {
  for (int32_t row = Max(0, y - kAround); row <= Min(map.height - 1, y + kAround); ++row) {
    for (int32_t column = Max(0, x - kAround); column <= Min(map.width - 1, x + kAround);
         ++column) {
      const float value = map.At(column, row);
      if (!std::isfinite(value)) return false;
      sorted->Insert(value);
    }
  }
  return true;
}

// Indices [first, last).
struct SortedPart {
  int32_t first, last;
  int32_t count() const { return last - first; }
};

// Returns the part of the sorted values within kNear of `disparity`. At least one value must be
// within kNear of `disparity`.
SortedPart PartNear(const Sorted& sorted, double disparity) {
  SortedPart part = {0, 0};
  while (part.first + 1 < sorted.count && sorted.values[part.first] < disparity - kNear) {
    ++part.first;
  }
  part.last = part.first + 1;
  while (part.last < sorted.count && sorted.values[part.last] <= disparity + kNear) ++part.last;
  return part;
}

double Median(const Sorted& sorted, const SortedPart& part) {
  const float* middle = sorted.values + part.first + part.count() / 2;
  return part.count() % 2 != 0 ? double{middle[0]} : (double{middle[-1]} + middle[0]) / 2;
}

// Returns true if a neighbour of the pixel is on the same surface. The result is true for a pixel
// of a wire one pixel wide, but false for a single wrong pixel.
bool HasNeighbour(const Map& map, int32_t x, int32_t y) {
  const double disparity = map.At(x, y);
  for (int32_t row = Max(0, y - 1); row <= Min(map.height - 1, y + 1); ++row) {
    for (int32_t column = Max(0, x - 1); column <= Min(map.width - 1, x + 1); ++column) {
      const bool itself = column == x && row == y;
      if (!itself && std::fabs(map.At(column, row) - disparity) <= kNear) return true;
    }
  }
  return false;
}

// Returns the disparity that has the most other disparities within kNear. If several disparities
// have equally many others within kNear, returns the smallest of these disparities.
double MostCommon(const Sorted& sorted) {
  int32_t most = 0, best = 0;
  for (int32_t k = 0; k < sorted.count; ++k) {
    const int32_t count = PartNear(sorted, sorted.values[k]).count();
    if (count <= most) continue;
    most = count;
    best = k;
  }
  return sorted.values[best];
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_focus_at(const float* disparity, size_t stride, int32_t width,
                                    int32_t height, int32_t x, int32_t y, double* focus) {
  if (focus == nullptr) return STARFOCUS_ERROR_NULL;
  const starfocus_status status = CheckMap({disparity, stride}, width, height, nullptr);
  if (status != STARFOCUS_OK) return status;
  if (x < 0 || x >= width || y < 0 || y >= height) return STARFOCUS_ERROR_RANGE;
  const Map map = {disparity, stride / sizeof(float), width, height};
  Sorted sorted;
  if (!SortAround(map, x, y, &sorted)) return STARFOCUS_ERROR_NOT_FINITE;
  double surface = HasNeighbour(map, x, y) ? double{map.At(x, y)} : MostCommon(sorted);
  // Taking the median twice makes the focus less dependent on the noise of the tapped pixel.
  for (int round = 0; round < 2; ++round) {
    surface = Median(sorted, PartNear(sorted, surface));
  }
  *focus = surface;
  return STARFOCUS_OK;
}

starfocus_status starfocus_aperture_of_f_stop(double f_stop, double widest, double* aperture) {
  if (aperture == nullptr) return STARFOCUS_ERROR_NULL;
  // If an argument is NaN, a comparison is false and the function returns an error.
  if (!(widest > 0.0 && widest <= f_stop && std::isfinite(f_stop))) return STARFOCUS_ERROR_RANGE;
  *aperture = widest / f_stop;
  return STARFOCUS_OK;
}
