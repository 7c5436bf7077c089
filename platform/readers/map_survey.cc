// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/map_survey.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace starfocus {
namespace {

// The value 0 or 65535 is a depth if its distance to the other values is less than kBesidePart
// times their range. Sensors leave a larger gap at 0, because the nearest distance that a sensor
// measures is at least 5 % of the range.
constexpr float kBesidePart = 0.02F;

void Extend(const RobustRange& other, RobustRange* range) {
  if (!other.known) return;
  if (!range->known) *range = other;
  range->low = std::min(range->low, other.low);
  range->high = std::max(range->high, other.high);
}

// Returns the mean of the known values of a map in rows `from` to `to` - 1.
double MeanOfRows(const FloatMap& map, int from, int to) {
  double sum = 0, count = 0;
  for (int y = from; y < to; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (!std::isfinite(map.at(x, y))) continue;
      sum += double(map.at(x, y));
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

bool HasKnown(const FloatMap& map, int y) {
  const auto row = map.values.begin() + static_cast<ptrdiff_t>(y) * map.width;
  return std::any_of(row, row + map.width, [](float value) { return std::isfinite(value); });
}

}  // namespace

bool MapEnds::AreDepths() const {
  const bool has_low = zeros + negatives > 0;
  if (!others.known || (has_low && tops > 0 && others.high >= kTop / 2)) return true;
  const float beside = kBesidePart * (others.high - others.low);
  return others.high > others.low &&
         ((has_low && others.low <= beside) || (tops > 0 && kTop - others.high <= beside));
}

void MapSurvey::Add(const MapSurvey& other) {
  if (kind.empty()) kind = other.kind;
  ends.zeros += other.ends.zeros;
  ends.negatives += other.ends.negatives;
  ends.tops += other.ends.tops;
  Extend(other.ends.others, &ends.others);
  Extend(other.range, &range);
  rise += other.rise;
  has_infinity |= other.has_infinity;
  has_distances |= other.has_distances;
}

MapSurvey SurveyNear(const FloatMap& map) {
  int first = 0, end = map.height;
  while (first < end && !HasKnown(map, first)) ++first;
  while (first < end && !HasKnown(map, end - 1)) --end;
  const int third = (end - first + 2) / 3;
  MapSurvey survey;
  survey.rise = MeanOfRows(map, end - third, end) - MeanOfRows(map, first, first + third);
  survey.has_infinity =
      std::find(map.values.begin(), map.values.end(), HUGE_VALF) != map.values.end();
  return survey;
}

}  // namespace starfocus
