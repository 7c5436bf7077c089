// SPDX-License-Identifier: Apache-2.0
// Layers 1 and 2 of the centre view around a stripe, as jobs for the runner.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_

#include "lib/engine/borders.h"
#include "lib/engine/jobs.h"
#include "lib/engine/row_store.h"
#include "lib/plan/partition.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Begins the stripe's marks of the columns of superblocks in which layers are needed: none are,
// and those of the stripe before were.
void ClearLayerColumns(const starfocus_config& config, RowStore* row_store);

// Marks all columns of the layers that the engine may use.
void MarkLayerColumns(const starfocus_config& config, RowStore* row_store);

// Marks the columns that `block` reads.
void MarkLayerColumns(const starfocus_config& config, const Block& block, RowStore* row_store);

// Makes room in the layers and their windows for the rows that rows `of_picture` subsample to and
// `borders` has beyond them, and keeps those that are there.
void PlaceLayers(const RowRange& of_picture, const Borders& borders, RowStore* row_store);

// Subsamples into the marked columns of placed layers. Returns STARFOCUS_OK, STARFOCUS_ERROR_RUNNER
// or STARFOCUS_ERROR_CANCELLED.
starfocus_status FillLayers(const starfocus_config& config, const simd::Kernels& kernels,
                            Workers* workers, RowStore* row_store);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_LAYERS_H_
