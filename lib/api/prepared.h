// SPDX-License-Identifier: Apache-2.0
// What of a light field depends on no lens, in memory of its own: checked and converted disparities
// and the layers of the centre view.
#ifndef STARFOCUS_LIB_API_PREPARED_H_
#define STARFOCUS_LIB_API_PREPARED_H_

#include <cstddef>

#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct Prepared {
  sf_config config;  // of the engine that made it
  sf_light_field light_field;
  Plane<int16_t> disparity;          // all rows
  Plane<int16_t> layers[SF_LAYERS];  // samples: all rows of layers 1 to config.max_layer
};

// Whether an engine of `config` may refocus it.
bool Fits(const Prepared& prepared, const sf_config& config);

// Returns the memory it lives in.
Extent PreparedMemory(const Prepared& prepared);

// Has the engine, whose views and lens are set, read its disparities and layers there.
void UsePrepared(const Prepared& prepared, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_PREPARED_H_
