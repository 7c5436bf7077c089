// SPDX-License-Identifier: Apache-2.0
// Loop over the stripes of a picture. Every entry point of the engine except streams runs this loop
// with a source of input rows and an output. Streams do not use the loop and refocus one stripe at
// a time.
#ifndef STARFOCUS_LIB_ENGINE_DRIVER_H_
#define STARFOCUS_LIB_ENGINE_DRIVER_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/engine/engine.h"
#include "lib/io/output.h"
#include "lib/io/view_reader.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Input light field in any format. The engine loads each row once, in order. A source that wraps
// another source may replace the depth map.
struct RowSource {
  ViewReader views;  // If the reader's functions are null, the engine reads the views in place.
  bool converts_centre = false;  // True if the engine copies rows of the centre view to its ring.
  // Returns simd::DepthFlags of the values of the disparity map on which `rows` depend. A null
  // function means that the disparity map is in memory.
  uint32_t (*check_map)(const void* self, const Range& rows) = nullptr;
  // Writes rows of the disparity map to `out`, in kDisparityBits; unknown disparities are
  // kNoSurface. Returns simd::DepthFlags. The function is null if check_map is null.
  uint32_t (*map)(const void* self, const Range& rows, const Plane<int16_t>& out) = nullptr;
  // Writes row y of the coverage to `out`. Only streams call this function. A null function means
  // that the light field has no coverage.
  void (*coverage)(const void* self, int32_t y, uint8_t* out) = nullptr;
  // Writes row y of the centre view's alpha to `out`. A null function means that alpha is 255
  // everywhere.
  void (*alpha)(const void* self, int32_t y, uint8_t* out) = nullptr;
  const void* self = nullptr;
};

// Checks all values of rows [rows.first, rows.last) of the disparity map. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_NOT_FINITE or STARFOCUS_ERROR_DISPARITY. If the rows contain both kinds of
// errors, the function returns STARFOCUS_ERROR_NOT_FINITE.
starfocus_status CheckRows(const RowSource& source, const Range& rows, EngineState* engine);

// Loads rows of the disparity map into `disparity`. If the source converts the centre view, loads
// rows of the centre view into their ring. CheckRows must have accepted the rows.
starfocus_status LoadRows(const RowSource& source, const Range& rows,
                          const Plane<int16_t>& disparity, EngineState* engine);

// Copies row y of the source to the rings of a streaming engine. Returns the result of checking row
// y of the disparity map. If this row is invalid, the function copies no view.
starfocus_status CopyRow(const RowSource& source, int32_t y, EngineState* engine);

// Returns the rows of all stripes that affect the region of the lens. The first row is a multiple
// of the superblock size.
Range StripeRows(const EngineState& engine);

// Refocuses the stripes that affect the region of the lens, and stores the rows of the region.
// Checks all input rows before it stores the first output row. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_CANCELLED, STARFOCUS_ERROR_RUNNER or an error of the disparity map.
starfocus_status RefocusRows(const RowSource& source, const Output& out, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_DRIVER_H_
