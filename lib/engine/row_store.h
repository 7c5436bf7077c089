// SPDX-License-Identifier: Apache-2.0
// The pictures of a call: views, layers and converted disparities, as windows onto them.
#ifndef STARFOCUS_LIB_ENGINE_ROW_STORE_H_
#define STARFOCUS_LIB_ENGINE_ROW_STORE_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/filter/layers.h"
#include "lib/input/window.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Whether the columns of a layer are read by the stripe, and whether they were by the one before.
enum ColumnNeed : uint8_t { kNeeded = 1, kNeededBefore = 2 };

struct RowStore {
  PlaneViews planes;  // what the windows read, if all views are rows of codes in memory
  Window windows[STARFOCUS_LAYERS];
  LayerPlane layers[STARFOCUS_LAYERS];  // layers 1 and 2, around a stripe
  uint8_t* needed[STARFOCUS_LAYERS];    // per column of superblocks: ColumnNeed of its layer 1, 2
  Plane<int16_t> disparity;             // ring of converted rows
  bool prepared;  // disparities and layers of the windows are a prepared field's
};

// Points the windows at views: `reader` must stay valid, `centre` has the codes of the centre view.
void SetViews(const starfocus_config& config, const ViewReader& reader,
              const Plane<const uint8_t>& centre, RowStore* row_store);

// Points the windows at views in memory of the library: reduced pictures or rings of rows.
void SetPlanes(const starfocus_config& config, const simd::Kernels& kernels,
               const Plane<uint8_t>* views, RowStore* row_store);

// Fills the unknown pixels (kNoSurface) of a converted row, as STARFOCUS_FEATURE_FILL_UNKNOWN says.
// Returns their number.
int32_t FillUnknown(const starfocus_config& config, const simd::Kernels& kernels, int16_t* row);

// Forgets the layers' rows, which are of another picture, or of which not all were made.
void ForgetLayers(const starfocus_config& config, RowStore* row_store);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_ROW_STORE_H_
