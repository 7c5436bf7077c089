// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/unknown_depth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "platform/readers/robust_range.h"

namespace starfocus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kTop = 65535;  // Largest 16-bit value.
// The value 0 or 65535 is a depth if its distance to the other values is less than kBesidePart
// times their range. Sensors leave a larger gap at 0, because the nearest distance that a sensor
// measures is at least 5 % of the range.
constexpr float kBesidePart = 0.02F;

// Number of pixels with the values 0 and 65535 in a 16-bit map, and whether these values are
// depths.
struct Ends {
  size_t zeros = 0, tops = 0;
  bool are_depths = false;
};

// Decides whether 0 and 65535 are depths in a 16-bit map. The values 0 and 65535 are depths if the
// map was stretched to the whole range. A map counts as stretched if values other than 0 and 65535
// come close to 0 or 65535. A map with both 0 and 65535 counts as stretched if another value lies
// in the upper half of the range, or if all values are 0 or 65535.
Ends JudgeEnds(const FloatMap& map) {
  Ends ends;
  std::vector<float> others;
  for (const float value : map.values) {
    if (value == 0) {
      ++ends.zeros;
    } else if (value == kTop) {
      ++ends.tops;
    } else {
      others.push_back(value);
    }
  }
  const RobustRange range = RobustRangeOf(others);
  if (ends.zeros > 0 && ends.tops > 0) {
    ends.are_depths = !range.known || range.high >= kTop / 2;
  } else if (!range.known) {
    ends.are_depths = true;  // All values are 0 or all are 65535.
  }
  const float beside = kBesidePart * (range.high - range.low);
  if (range.known && range.high > range.low) {
    ends.are_depths |=
        (ends.zeros > 0 && range.low <= beside) || (ends.tops > 0 && kTop - range.high <= beside);
  }
  return ends;
}

void Forget(float unknown, FloatMap* map) {
  std::replace(map->values.begin(), map->values.end(), unknown, kUnknown);
}

// A gap of unknown pixels in a row or a column of a map. `value` is the value that fills one pixel
// of the gap.
struct Gap {
  float value = kUnknown;
  int length = std::numeric_limits<int>::max();  // Length of the gap around the pixel.
};

// Calls `visit` for each unknown pixel of a line, with the gap that contains the pixel. The line
// has `count` values, `step` elements apart. If the values at the ends of a gap differ by at most
// `alike`, both values belong to one surface, and values in the gap are interpolated. If the values
// at the ends of a gap differ by more than `alike`, pixels in the gap receive the smaller value,
// which is the background. A gap at the border of the map has a known value at one end only. The
// length of a gap at the border counts twice, because no second value confirms the value at the
// known end.
template <class Visit>
void FindGaps(const float* line, size_t step, int count, float alike, const Visit& visit) {
  const auto at = [&](int k) { return line[size_t(k) * step]; };
  for (int k = 0; k < count;) {
    if (!std::isnan(at(k))) {
      ++k;
      continue;
    }
    const int begin = k;
    int end = k;
    while (end < count && std::isnan(at(end))) ++end;
    const bool before = begin > 0, after = end < count;
    if (!before && !after) return;
    const float first = at(before ? begin - 1 : end), last = at(after ? end : begin - 1);
    const float slope = (last - first) / static_cast<float>(end - begin + 1);
    const bool one_surface = std::fabs(last - first) <= alike;
    const int length = (end - begin) * (before && after ? 1 : 2);
    for (; k < end; ++k) {
      const float between = first + slope * static_cast<float>(k - begin + 1);
      visit(k, Gap{one_surface ? between : std::fmin(first, last), length});
    }
  }
}

// Fills every unknown pixel that has a known pixel in its row or column. Returns the number of
// filled pixels.
size_t FillOnce(float alike, FloatMap* map) {
  const size_t width = size_t(map->width);
  std::vector<Gap> gaps(map->values.size());
  for (int y = 0; y < map->height; ++y) {
    Gap* row = gaps.data() + size_t(y) * width;
    FindGaps(map->values.data() + size_t(y) * width, 1, map->width, alike,
             [row](int x, const Gap& gap) { row[x] = gap; });
  }
  for (int x = 0; x < map->width; ++x) {
    Gap* column = gaps.data() + x;
    FindGaps(map->values.data() + x, width, map->height, alike, [&](int y, const Gap& gap) {
      Gap* at = column + size_t(y) * width;
      if (gap.length == at->length) at->value = std::fmin(at->value, gap.value);
      if (gap.length < at->length) *at = gap;
    });
  }
  size_t filled = 0;
  for (size_t k = 0; k < gaps.size(); ++k) {
    if (!std::isnan(map->values[k]) || std::isnan(gaps[k].value)) continue;
    map->values[k] = gaps[k].value;
    ++filled;
  }
  return filled;
}

}  // namespace

void MarkUnknown(const DepthOptions& options, int largest, DepthPhoto* photo) {
  FloatMap* map = &photo->map;
  for (float& value : map->values) {
    if (!std::isfinite(value)) value = kUnknown;
  }
  for (const double value : options.unknown) Forget(static_cast<float>(value), map);
  const bool distances =
      options.unit == DepthUnit::kMetres || options.unit == DepthUnit::kMillimetres;
  if (distances) Forget(0, map);  // Sensors store the distance 0 for pixels without a measurement.
  if (options.has_unknown || largest <= 255) return;
  const Ends ends = JudgeEnds(*map);
  if (ends.zeros + ends.tops == 0) return;
  const bool both = ends.zeros > 0 && ends.tops > 0;
  const std::string end = ends.tops == 0 ? "0" : "65535", which = both ? "0 and 65535" : end;
  if (ends.are_depths) {
    photo->notes.push_back("in the depth picture, " + which + (both ? " are" : " is") +
                           " taken as a known depth, because other values are close (--unknown " +
                           (both ? "0,65535" : end) + " overrides this)");
    return;
  }
  photo->notes.push_back("in the depth picture, " + which + (both ? " are" : " is") +
                         " taken as unknown depth (--unknown none overrides this)");
  Forget(0, map);
  Forget(kTop, map);
}

size_t FillBehind(FloatMap* map) {
  const auto unknown = std::count_if(map->values.begin(), map->values.end(),
                                     [](float value) { return std::isnan(value); });
  if (unknown == 0) return 0;
  constexpr float kAlikePart = 0.05F;  // Tolerance as a fraction of the value range.
  const RobustRange range = RobustRangeOf(map->values);
  const float alike = kAlikePart * (range.high - range.low);
  // The first pass completes every row and column that contains a known pixel, so the second pass
  // fills all remaining pixels.
  for (auto left = static_cast<size_t>(unknown); left > 0;) left -= FillOnce(alike, map);
  return static_cast<size_t>(unknown);
}

}  // namespace starfocus
