// SPDX-License-Identifier: Apache-2.0
// A streamed refocusing, whatever its rows are made of.
#ifndef STARFOCUS_LIB_API_STREAM_H_
#define STARFOCUS_LIB_API_STREAM_H_

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"

namespace starfocus {

// Checks that a stream runs, and the number of rows of a call.
sf_status CheckPush(const EngineState& engine, int32_t rows);
sf_status CheckPull(const EngineState& engine, int32_t rows);

// Copies up to `rows` next rows of the source, `unit` (1 or 2) at a time, as long as the next
// stripe needs some. *consumed counts them.
sf_status PushRows(const RowSource& source, int32_t rows, int32_t unit, EngineState* engine,
                   int32_t* consumed);

// Stores up to `rows` next rows, and refocuses the stripes that these need and whose rows are
// there. *written counts the rows.
sf_status PullRows(const RowSink& sink, int32_t rows, EngineState* engine, int32_t* written);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_STREAM_H_
