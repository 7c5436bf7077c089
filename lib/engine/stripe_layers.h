// Layers 1 and 2 of the centre view around a stripe, as jobs for the runner.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_

#include "lib/engine/engine.h"
#include "lib/engine/jobs.h"

namespace starfocus {

// The columns of largest blocks in which the layers are needed by the next stripe: none; all, of
// the layers that the engine may use; those that `block` reads.
void ClearLayerColumns(const EngineState& engine);
void MarkLayerColumns(const EngineState& engine);
void MarkLayerColumns(const EngineState& engine, const Block& block);

// The layers' rows are no longer of use: they are of another picture, or not all were made.
void ForgetLayers(EngineState* engine);

// Makes room in the engine's layers and their windows for the rows that rows `of_picture` subsample
// to, and keeps those that are there.
void PlaceLayers(const RowRange& of_picture, EngineState* engine);

// Subsamples into the marked columns of placed layers. SF_OK or SF_ERROR_RUNNER.
sf_status FillLayers(EngineState* engine, const Runner& runner);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_
