// SPDX-License-Identifier: Apache-2.0
// Subsamples the centre view around a stripe to layers 1 and 2.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_

#include "lib/engine/borders.h"
#include "lib/engine/engine.h"
#include "lib/plan/partition.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Allocates the memory of a worker that subsamples a column of superblocks.
void TakeResample(const starfocus_config& config, Arena* arena, ResampleScratch* resample);

// Allocates the planes of layers 1 and 2 around a stripe, and the marks of their columns.
void TakeLayers(const starfocus_config& config, Arena* arena, StripeLayers* layers);

// Clears the marks of the columns to subsample, for a new stripe. Keeps the old marks as the marks
// of the previous stripe.
void ClearLayerColumns(const starfocus_config& config, StripeLayers* layers);

// Marks all columns of all layers that the engine may use.
void MarkLayerColumns(const starfocus_config& config, StripeLayers* layers);

// Marks the columns of superblocks that `block` reads.
void MarkLayerColumns(const starfocus_config& config, const Block& block, StripeLayers* layers);

// Moves the layers, also of the engine's input, to the rows `of_picture` of the picture, extended
// by `borders`. Rows of the layers that were computed for the previous stripe are kept.
void PlaceLayers(const Range& of_picture, const Borders& borders, EngineState* engine);

// All layers that FillLayers computes.
inline constexpr Range kAllLayers = {1, STARFOCUS_LAYERS};

// Computes the marked columns of the layers [layers.first, layers.last), from the picture or, for
// layer 2 and if it is not null, from `layer_one`, whose samples contain all rows that the filter
// reads. PlaceLayers must be called first. Returns STARFOCUS_OK, STARFOCUS_ERROR_RUNNER or
// STARFOCUS_ERROR_CANCELLED.
starfocus_status FillLayers(const Range& layers, const LayerPlane* layer_one, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_
