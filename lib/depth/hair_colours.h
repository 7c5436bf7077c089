// SPDX-License-Identifier: Apache-2.0
// The colours of the near and of the far surface at hair, from where they are pure: jobs for the
// tiles of a HairJob, which write the lowest levels of its two pyramids.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_
#define STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_

#include <cstdint>

namespace starfocus {

// At first only cells without near pixels around are known to be far.
void PullFar(const void* data, int32_t index, int32_t worker);
// Then the near pixels count that differ most from the far colour.
void MeasureContrast(const void* data, int32_t index, int32_t worker);
void PullNear(const void* data, int32_t index, int32_t worker);
// Then pixels count by the coverage that was found.
void PullBoth(const void* data, int32_t index, int32_t worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_COLOURS_H_
