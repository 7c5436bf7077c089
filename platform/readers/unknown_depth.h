// SPDX-License-Identifier: Apache-2.0
// Finds unknown values of a depth picture, and fills them with the background.
#ifndef STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_

#include "platform/levels.h"
#include "platform/readers/depth_options.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Sets unknown values of samples->map to NaN. -inf, NaN and values in options.unknown are always
// unknown. Distances that are not positive are unknown, too. The caller decides the meaning of
// +inf.
//
// If options.has_unknown is false, the following values may mean unknown depth: 0, negative values
// and 65535 in maps of integers of more than 8 bits; 0 and negative values in maps of floats
// without a unit, unless larger values are nearer. If larger values are nearer, 0 is the inverse
// distance of infinitely distant points. The other values of the map, or of all maps of
// options.clip, decide. The function adds a note about the decision to `photo`, and sets
// photo->survey.ends.
void MarkUnknown(const DepthOptions& options, Samples* samples, DepthPhoto* photo);

// Marks pixels with the value `unknown` as unknown (NaN).
void Forget(float unknown, FloatMap* map);

// Replaces NaN by the background in a map in which larger values are nearer. For each unknown
// pixel, uses the gap along its row or its column, whichever is shorter. Gaps at the top of the
// map, which often are sky, get the farthest value beside them. The new value of an unknown pixel
// is the smaller of the values at the ends of the gap. If the values at the ends of the gap differ
// by at most 5 % of the value range, the new value is interpolated. At least one value of the map
// must be known. Returns the number of filled pixels.
size_t FillBehind(FloatMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
