// SPDX-License-Identifier: Apache-2.0
// Which rows a refocusing of a region takes, and who watches over it.
#ifndef STARFOCUS_LIB_API_STRIPE_ROWS_H_
#define STARFOCUS_LIB_API_STRIPE_ROWS_H_

#include "lib/engine/engine.h"

namespace starfocus {

// Returns the rows of the stripes that the lens's region needs; a stripe's first row is a multiple
// of the largest block.
RowRange StripeRows(const EngineState& engine);

// Returns the rows of the centre view and the disparity map that the stripes may read.
RowRange MapRows(const EngineState& engine);

// Returns part `index` of `parts` of the rows, of which none has more than one more than another.
inline RowRange PartOf(const RowRange& rows, int32_t index, int32_t parts) {
  const int64_t count = rows.last - rows.first;
  return {rows.first + static_cast<int32_t>(count * index / parts),
          rows.first + static_cast<int32_t>(count * (index + 1) / parts)};
}

// The calling thread's patience, outside of jobs.
inline Patience* OwnPatience(EngineState* engine) { return &engine->crew.workers[0].patience; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_STRIPE_ROWS_H_
