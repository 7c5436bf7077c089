// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/unknown_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "platform/readers/robust_range.h"

namespace starfocus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Returns the figures of the values at the ends of the range of values. The value 65535 is an end
// if `has_top` is true.
MapEnds MeasureEnds(bool has_top, const FloatMap& map) {
  MapEnds ends;
  std::vector<float> others;
  for (const float value : map.values) {
    if (value == 0) {
      ++ends.zeros;
    } else if (value < 0) {
      ++ends.negatives;
    } else if (has_top && value == MapEnds::kTop) {
      ++ends.tops;
    } else {
      others.push_back(value);
    }
  }
  ends.others = RobustRangeOf(others);
  return ends;
}

// Returns the names of the values at the ends, such as "0 and 65535".
std::string NamesOf(const MapEnds& ends) {
  std::string names = ends.zeros > 0 ? "0" : "";
  if (ends.negatives > 0) names += names.empty() ? "negative values" : " and negative values";
  if (ends.tops > 0) names += names.empty() ? "65535" : " and 65535";
  return names;
}

// Decides whether values at the ends of the range of values are unknown, and adds a note.
void MarkEnds(const DepthOptions& options, Samples* samples, DepthPhoto* photo) {
  const bool floats = samples->largest == 0;
  photo->survey.ends = MeasureEnds(!floats, samples->map);
  const MapEnds& ends = options.clip != nullptr ? options.clip->ends : photo->survey.ends;
  const bool are_depths = ends.AreDepths();
  // Floats up to 1 are normalized. Networks store 0 for the sky in such maps.
  const bool normalized = floats && ends.others.known && ends.others.high <= 1;
  const bool larger_is_nearer =
      options.near == Near::kWhite ||
      ((samples->larger_is_nearer || normalized) && options.near == Near::kUnknown);
  // Floats that reach 0 without a gap need no note: 0 is an ordinary value.
  if (ends.zeros + ends.negatives + ends.tops == 0 || (floats && are_depths)) return;
  const bool one = ends.zeros * ends.tops == 0 && ends.negatives == 0;
  const std::string taken =
      "in the depth picture, " + NamesOf(ends) + (one ? " is" : " are") + " taken as ";
  if (are_depths || (floats && larger_is_nearer)) {
    const std::string listed = ends.negatives > 0 ? "V,V,..."
                               : ends.tops == 0   ? "0"
                               : ends.zeros > 0   ? "0,65535"
                                                  : "65535";
    photo->notes.push_back(taken + "a known depth, because " +
                           (are_depths ? "other values are close"
                                       : "larger values are nearer and 0 is the farthest depth") +
                           " (--unknown " + listed + " overrides this)");
    return;
  }
  photo->notes.push_back(taken + "unknown depth (--unknown none overrides this)");
  for (float& value : samples->map.values) {
    if (value <= 0 || (!floats && value == MapEnds::kTop)) value = kUnknown;
  }
}

// A gap of unknown pixels in a row or a column of a map. `value` is the value that fills one pixel
// of the gap.
struct Gap {
  float value = kUnknown;
  int length = std::numeric_limits<int>::max();  // Length of the gap around the pixel.
  bool at_start = false;                         // True if the line begins with the gap.
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
      visit(k, Gap{one_surface ? between : std::fmin(first, last), length, !before});
    }
  }
}

// Limits the values of gaps at the top of columns to the smallest value in and beside the unknown
// part of the row. Sky that a sensor cannot measure would otherwise get the depth of the person
// below it.
void LimitTops(const float* row, int width, Gap* gaps) {
  for (int begin = 0; begin < width; ++begin) {
    if (!std::isnan(row[begin])) continue;
    int end = begin;
    float least = begin > 0 ? row[begin - 1] : HUGE_VALF;
    for (; end < width && std::isnan(row[end]); ++end) least = std::fmin(least, gaps[end].value);
    if (end < width) least = std::fmin(least, row[end]);
    for (; begin < end; ++begin) {
      if (gaps[begin].at_start) gaps[begin].value = least;
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
             [row](int x, const Gap& gap) {
               row[x] = {gap.value, gap.length, false};
             });
  }
  for (int x = 0; x < map->width; ++x) {
    Gap* column = gaps.data() + x;
    FindGaps(map->values.data() + x, width, map->height, alike, [&](int y, const Gap& gap) {
      Gap* at = column + size_t(y) * width;
      if (gap.length == at->length) at->value = std::fmin(at->value, gap.value);
      if (gap.length < at->length) *at = gap;
    });
  }
  for (size_t at = 0; at < gaps.size(); at += width) {
    LimitTops(map->values.data() + at, map->width, gaps.data() + at);
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

void Forget(float unknown, FloatMap* map) {
  std::replace(map->values.begin(), map->values.end(), unknown, kUnknown);
}

void MarkUnknown(const DepthOptions& options, Samples* samples, DepthPhoto* photo) {
  FloatMap* map = &samples->map;
  Forget(-HUGE_VALF, map);
  for (const double value : options.unknown) Forget(static_cast<float>(value), map);
  if (options.unit == DepthUnit::kDistance || options.unit == DepthUnit::kDepth16) {
    for (float& value : map->values) {
      if (value <= 0) value = kUnknown;
    }
  }
  const bool has_markers =
      samples->largest == 0 ? options.unit == DepthUnit::kNone : samples->largest > UINT8_MAX;
  if (has_markers && !options.has_unknown) MarkEnds(options, samples, photo);
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
