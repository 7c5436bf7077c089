// SPDX-License-Identifier: Apache-2.0
// Jobs that estimate the foreground and the background colour of each cell from pixels that show
// one surface only. Each job writes the cells of one tile to the lowest level of a pyramid; `data`
// is a HairJob.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_
#define STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_

#include <cstdint>

namespace starfocus {

// Computes background colours for the first pass, from cells without near pixels nearby.
void PullFar(const void* data, int32_t index, int32_t worker);
// MeasureContrast and PullNear compute foreground colours for the first pass, from near pixels
// weighted by their contrast to the background. MeasureContrast must run first, for all tiles.
void MeasureContrast(const void* data, int32_t index, int32_t worker);
void PullNear(const void* data, int32_t index, int32_t worker);
// Computes foreground and background colours for the second pass, from all pixels weighted by the
// coverage of the first pass.
void PullBoth(const void* data, int32_t index, int32_t worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_
