// SPDX-License-Identifier: Apache-2.0
// Jobs that estimate the foreground and the background colour of each cell from pixels that show
// one surface only. Each job writes the cells of one tile, in the lowest level of a pyramid of its
// HairJob.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_
#define STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_

#include <cstdint>

namespace starfocus {

// First pass, background: cells without near pixels around them.
void PullFar(const void* data, int32_t index, int32_t worker);
// First pass, foreground: near pixels, weighted by their contrast to the background.
void MeasureContrast(const void* data, int32_t index, int32_t worker);
void PullNear(const void* data, int32_t index, int32_t worker);
// Second pass: all pixels, weighted by the coverage that the first pass found.
void PullBoth(const void* data, int32_t index, int32_t worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_
