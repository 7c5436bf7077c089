// SPDX-License-Identifier: Apache-2.0
// What of a light field depends on no lens, in memory of its own: checked and converted disparities
// and the layers of the centre view.
#ifndef STARFOCUS_LIB_SOURCE_PREPARED_H_
#define STARFOCUS_LIB_SOURCE_PREPARED_H_

#include <cstddef>

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "lib/source/extents.h"
#include "lib/source/reduced.h"

namespace starfocus {

struct Prepared {
  starfocus_config config;  // of the engine that made it
  starfocus_light_field light_field;
  bool covers = false;       // whether the light field has coverage
  Plane<int16_t> disparity;  // all rows
  Plane<int16_t>
      layers[STARFOCUS_LAYERS];  // samples: all rows of layers 1 to config.tuning.max_layer
  ReducedField reduced[STARFOCUS_MAX_PREVIEW + 1];  // by shift, from 1 to config.previews
};

// Lays out a prepared light field for a valid configuration at `base`, or counts when base is null.
// Returns the bytes used, or kTooLarge; *prepared is null when counting.
size_t LayOutPrepared(const starfocus_config& config, void* base, Prepared** prepared);

// A call that prepares a light field, whatever its format.
struct PrepareCall {
  void* memory;
  size_t bytes;
};

// Prepares the light field that the engine's views show and `source` gives: checks and converts the
// map, and makes the layers and the reduced light fields stripe by stripe, in the engine's own
// planes but for the pixels. *prepared is null on error; the memory stays as it is when a row of
// the map is bad.
starfocus_status Prepare(const PrepareCall& call, const RowSource& source, EngineState* engine,
                         Prepared** prepared);

// Whether an engine of `config` may refocus it.
bool Fits(const Prepared& prepared, const starfocus_config& config);

// Returns the memory it lives in.
Extent PreparedMemory(const Prepared& prepared);

// Has the engine, whose views and lens are set, read its disparities and layers there.
void UsePrepared(const Prepared& prepared, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_PREPARED_H_
