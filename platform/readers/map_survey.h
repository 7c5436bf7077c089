// SPDX-License-Identifier: Apache-2.0
// Figures of a depth map that decide how its values are interpreted. All frames of a clip are
// interpreted by the sum of their figures, so that a value means the same depth in each frame.
#ifndef STARFOCUS_PLATFORM_READERS_MAP_SURVEY_H_
#define STARFOCUS_PLATFORM_READERS_MAP_SURVEY_H_

#include <cstddef>
#include <string>

#include "platform/pfm.h"
#include "platform/readers/robust_range.h"

namespace starfocus {

// The end of the grey range of a depth picture that means near: white, black, or unknown.
enum class Near { kUnknown, kWhite, kBlack };

// Numbers of samples at the ends of the range of values, and the range of the other values.
struct MapEnds {
  static constexpr float kTop = 65535;  // Largest 16-bit value.

  // Decides whether 0, negative values and 65535 are depths. They are depths if the other values
  // come close to 0 or 65535, because the map was stretched to the whole range or has no gap at 0.
  // A map with both ends counts as stretched if another value lies in the upper half of the range,
  // or if there is no other value.
  bool AreDepths() const;

  size_t zeros = 0, negatives = 0;
  size_t tops = 0;  // values of 65535 in maps of integers
  RobustRange others;
};

struct MapSurvey {
  std::string kind;   // description of the values; empty: no map
  MapEnds ends;       // of the stored values
  RobustRange range;  // of the known values
  // Mean of the lower third of the rows with known values minus the mean of the upper third.
  double rise = 0;
  bool has_infinity = false;  // True if a value is +inf.
  // True if the values look like distances: 0 is unknown in the map, and the other values are in
  // the range of rooms and streets.
  bool has_distances = false;

  // Guesses which end of the value range is near. Small values are near if the map has +inf or
  // distances. For other maps, the guess assumes that the bottom of a photograph is nearer than its
  // top.
  Near GuessNear() const {
    return !has_infinity && !has_distances && rise > 0 ? Near::kWhite : Near::kBlack;
  }
  // Adds the figures of another map. Ranges become the smallest ranges that contain both ranges.
  void Add(const MapSurvey& other);
};

// Returns a survey of the figures of a map that GuessNear requires. Unknown values (NaN) are
// ignored.
MapSurvey SurveyNear(const FloatMap& map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MAP_SURVEY_H_
