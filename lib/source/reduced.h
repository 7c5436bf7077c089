// SPDX-License-Identifier: Apache-2.0
// A prepared light field's own light fields of 1/2, 1/4 and 1/8 of the size, for previews.
#ifndef STARFOCUS_LIB_SOURCE_REDUCED_H_
#define STARFOCUS_LIB_SOURCE_REDUCED_H_

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/engine/engine.h"
#include "lib/filter/reduce.h"

namespace starfocus {

static_assert(STARFOCUS_MAX_PREVIEW == kMaxReduction, "every preview is a reduction");

struct ReducedField {
  Plane<uint8_t> views[kMaxViews];  // codes of all rows
  Plane<int16_t> disparity;         // kDisparityBits, in pixels of the reduced picture
  Plane<uint8_t> coverage;          // null: the configuration finds none
};

// The configuration of an engine for the light field of `config`, an engine's own, reduced.
starfocus_config ReducedConfig(const starfocus_config& config, int shift);

void TakeReduced(const starfocus_config& config, int shift, Arena* arena, ReducedField* field);

// Reduces rows [rows.first, rows.last) of the light field that the engine's windows show, by all
// shifts from 1 to `previews` into fields[shift]; disparities are those of `disparity`. The first
// row is a multiple of the superblock, and so is the last one but at the picture's end.
starfocus_status ReduceRows(const Plane<int16_t>& disparity, const RowRange& rows, int32_t previews,
                            const ReducedField* fields, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_REDUCED_H_
