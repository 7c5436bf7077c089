// SPDX-License-Identifier: Apache-2.0
// Copies of a prepared light field at 1/2, 1/4 and 1/8 of its size, for previews.
#ifndef STARFOCUS_LIB_ENGINE_REDUCED_H_
#define STARFOCUS_LIB_ENGINE_REDUCED_H_

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/engine/engine.h"
#include "lib/engine/reduce.h"

namespace starfocus {

static_assert(STARFOCUS_MAX_PREVIEW == kMaxReduction,
              "each preview size must be a supported size of reduced light fields");

struct ReducedField {
  Plane<uint8_t> views[kMaxViews];  // 8-bit samples (codes) of all rows.
  Plane<int16_t> disparity;  // In fixed point (kDisparityBits), in pixels of the reduced picture.
  Plane<uint8_t> coverage;   // Null: the configuration has no coverage.
};

// Returns the configuration of an engine for a light field of `config` at 1/2^shift of its size.
starfocus_config ReducedConfig(const starfocus_config& config, int shift);

void TakeReduced(const starfocus_config& config, int shift, Arena* arena, ReducedField* field);

// Reduces rows [rows.first, rows.last) of the engine's input to 1/2^shift of
// its size, for each shift from 1 to `previews`. Writes the results to fields[shift]. Reads
// disparities from `disparity`. rows.first and rows.last must be multiples of the superblock size;
// rows.last may also be the height of the picture.
starfocus_status ReduceRows(const Plane<int16_t>& disparity, const Range& rows, int32_t previews,
                            const ReducedField* fields, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_REDUCED_H_
