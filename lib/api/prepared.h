// SPDX-License-Identifier: Apache-2.0
// What of a light field depends on no lens, in memory of its own: checked and converted disparities
// and the layers of the centre view.
#ifndef STARFOCUS_LIB_API_PREPARED_H_
#define STARFOCUS_LIB_API_PREPARED_H_

#include <cstddef>

#include "lib/api/reduced.h"
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "starfocus/image.h"

namespace starfocus {

struct Prepared {
  sf_config config;  // of the engine that made it
  sf_light_field light_field;
  sf_image_field* images = nullptr;          // instead of the light field; null: there are none
  Plane<int16_t> disparity;                  // all rows
  Plane<int16_t> layers[SF_LAYERS];          // samples: all rows of layers 1 to config.max_layer
  ReducedField reduced[SF_MAX_PREVIEW + 1];  // by shift, from 1 to config.previews
};

// Tells the engine's rings the rows that are read next; without a function the views are pictures.
struct RowSource {
  sf_status (*read)(const void* field, const RowRange& rows, const Plane<int16_t>& disparity,
                    const Runner& runner, EngineState* engine);
  const void* field;
};

// Lays out a prepared light field for a valid configuration at `base`, or counts when base is null.
// Returns the bytes used, or kTooLarge; *prepared is null when counting.
size_t LayOutPrepared(const sf_config& config, void* base, Prepared** prepared);

// Checks the memory that a prepared light field is to be made in; *extent is what it takes.
sf_status CheckPreparedMemory(const EngineState& engine, const void* memory, size_t bytes,
                              Extent* extent);

// Makes the layers stripe by stripe, in the engine's own planes but for the pixels, and the reduced
// light fields. The engine's views must be set.
sf_status MakeLayers(const Prepared& prepared, const RowSource& source, const Runner& runner,
                     EngineState* engine);

// Whether an engine of `config` may refocus it.
bool Fits(const Prepared& prepared, const sf_config& config);

// Returns the memory it lives in.
Extent PreparedMemory(const Prepared& prepared);

// Has the engine, whose views and lens are set, read its disparities and layers there.
void UsePrepared(const Prepared& prepared, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_PREPARED_H_
