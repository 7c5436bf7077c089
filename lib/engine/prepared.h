// SPDX-License-Identifier: Apache-2.0
// Prepared light field, which stores data that do not depend on the lens: checked and converted
// disparities, the layers of the centre view, and copies of the light field at 1/2, 1/4 and 1/8 of
// its size, for previews.
#ifndef STARFOCUS_LIB_ENGINE_PREPARED_H_
#define STARFOCUS_LIB_ENGINE_PREPARED_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/config.h"
#include "lib/base/geometry.h"
#include "lib/engine/engine.h"

namespace starfocus {

// Returns the width or height of a reduced picture.
constexpr int32_t ReducedSize(int32_t size, int shift) {
  return (size + (1 << shift) - 1) >> shift;
}

// Returns the rectangle of reduced pixels that overlap `rect`.
Rect ReducedRect(const Rect& rect, int shift);

// Copy of a prepared light field at 1/2^shift of its size. Each pixel represents a block of 2^shift
// by 2^shift pixels, or the part of the block inside the picture.
struct ReducedField {
  StoredViews views;         // All rows.
  Plane<int16_t> disparity;  // In fixed point (kDisparityBits), in pixels of the reduced picture.
  Plane<uint8_t> coverage;   // Null: the configuration has no coverage.
};

// Returns the configuration of an engine for a light field of `config` at 1/2^shift of its size.
FullConfig ReducedConfig(const FullConfig& config, int shift);

struct Prepared {
  // Allocator of the memory; its functions are null if the memory belongs to the caller.
  starfocus_allocator allocator = {};
  size_t bytes = 0;  // Result of LayOutPrepared, also if the caller's memory is larger.
  // Configuration of the engine that prepared the light field, without `problem`, which belongs to
  // that engine.
  FullConfig config;
  starfocus_light_field light_field;
  bool covers = false;       // True if the light field has coverage.
  bool has_alpha = false;    // True if a view has alpha that is refocused.
  Plane<int16_t> disparity;  // Disparities of all rows.
  // Samples of all rows of layers 1 to config.tuning.max_layer.
  Plane<int16_t> layers[STARFOCUS_LAYERS];
  ReducedField reduced[STARFOCUS_MAX_PREVIEW + 1];  // indexed by shift, from 1 to config.previews
};

// Lays out a prepared light field for a valid configuration at `base`. If `base` is null, only
// counts the bytes and sets *prepared to null. Returns the number of bytes, or kTooLarge.
size_t LayOutPrepared(const FullConfig& config, void* base, Prepared** prepared);

// Prepares the light field of the engine's input in `memory`. Checks and converts the map, and
// computes the layers and reduced light fields stripe by stripe. The engine's planes, except for
// the pixels, serve as scratch memory. *prepared is written only on success. If a row of the map is
// invalid, the memory is not changed.
starfocus_status Prepare(void* memory, EngineState* engine, Prepared** prepared);

// Returns true if an engine of `config` can refocus the prepared light field.
bool Fits(const Prepared& prepared, const FullConfig& config);

// Returns the address range of the prepared light field.
Extent PreparedMemory(const Prepared& prepared);

// Makes `in`, whose pictures are those of the prepared light field, read its disparities and
// layers. The map is not read again.
void UsePrepared(const Prepared& prepared, Input* in);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_PREPARED_H_
