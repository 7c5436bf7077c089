// SPDX-License-Identifier: Apache-2.0
// The loop over the stripes of a picture. Every way into the engine is a source of rows, a sink of
// rows, or a stream, which refocuses one stripe at a time.
#ifndef STARFOCUS_LIB_ENGINE_DRIVER_H_
#define STARFOCUS_LIB_ENGINE_DRIVER_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/engine/engine.h"
#include "lib/input/view_reader.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A light field of the caller's in any format. Its rows are loaded in order, each once. A source
// around another one may change the map.
struct RowSource {
  ViewReader views;              // null functions: the views are in memory
  bool converts_centre = false;  // rows of the centre view go into the engine's ring
  // Writes row y of the disparity map to `out`, kDisparityBits, kNoSurface where it is unknown.
  // Returns simd::DepthFlags. Null: the map is in memory.
  uint32_t (*map)(const void* self, int32_t y, int16_t* out) = nullptr;
  // Writes row y of the coverage, for streams. Null: the light field has none.
  void (*coverage)(const void* self, int32_t y, uint8_t* out) = nullptr;
  // Writes row y of the centre view's alpha. Null: it is 255.
  void (*alpha)(const void* self, int32_t y, uint8_t* out) = nullptr;
  const void* self = nullptr;
};

// Takes finished rows of a picture or region, in order. `from` has all columns of the picture.
struct RowSink {
  starfocus_status (*store)(const void* self, const RowRange& rows, const Plane<uint8_t>& from,
                            EngineState* engine);
  const void* self;
};

// Checks that all values of rows [rows.first, rows.last) of the map are allowed.
// STARFOCUS_ERROR_NOT_FINITE comes before STARFOCUS_ERROR_DISPARITY.
starfocus_status CheckRows(const RowSource& source, const RowRange& rows, EngineState* engine);

// Loads rows of the map into `disparity`, and of the centre view into its ring if the source
// converts it. The rows have been checked.
starfocus_status LoadRows(const RowSource& source, const RowRange& rows,
                          const Plane<int16_t>& disparity, EngineState* engine);

// Copies row y of the source into the rings of a streaming engine. Returns the status of its map,
// with which nothing is copied.
starfocus_status CopyRow(const RowSource& source, int32_t y, EngineState* engine);

// Returns the rows of the stripes that the lens's region needs; a stripe's first row is a multiple
// of the superblock.
RowRange StripeRows(const EngineState& engine);

// Returns part `index` of `parts` of the rows, of which none has more than one more than another.
RowRange PartOf(const RowRange& rows, int32_t index, int32_t parts);

// Refocuses what the lens's region needs, stripe by stripe, and stores the region's rows. All rows
// are checked before the first one is stored. Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED,
// STARFOCUS_ERROR_RUNNER or an error of the map.
starfocus_status RefocusRows(const RowSource& source, const RowSink& sink, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_DRIVER_H_
