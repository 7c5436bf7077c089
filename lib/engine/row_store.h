// SPDX-License-Identifier: Apache-2.0
// Pictures that a call reads: views, layers and converted disparities, and the windows onto these
// pictures.
#ifndef STARFOCUS_LIB_ENGINE_ROW_STORE_H_
#define STARFOCUS_LIB_ENGINE_ROW_STORE_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/io/layers.h"
#include "lib/io/window.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Flags of a column of a layer: kNeeded if the current stripe reads the column, and kNeededBefore
// if the previous stripe read the column.
enum ColumnNeed : uint8_t { kNeeded = 1, kNeededBefore = 2 };

struct RowStore {
  PlaneViews planes;  // source of the windows if all views are rows of codes in memory
  Window windows[STARFOCUS_LAYERS];
  LayerPlane layers[STARFOCUS_LAYERS];  // layers 1 and 2 around a stripe
  // ColumnNeed for each column of superblocks, for layers 1 and 2.
  uint8_t* needed[STARFOCUS_LAYERS];
  Plane<int16_t> disparity;  // Ring of converted rows of the disparity map.
  bool prepared;  // True: disparities and layers of the windows come from a prepared light field.
};

// Sets `reader`, which must remain valid, as the source of the windows. `centre` holds the codes of
// the centre view.
void SetViews(const starfocus_config& config, const ViewReader& reader,
              const Plane<const uint8_t>& centre, RowStore* row_store);

// Sets views in memory of the library, that is, reduced pictures or rings of rows, as the source of
// the windows.
void SetPlanes(const starfocus_config& config, const simd::Kernels& kernels,
               const Plane<uint8_t>* views, RowStore* row_store);

// Fills the unknown disparities (kNoSurface) of a converted row of the disparity map according to
// STARFOCUS_FEATURE_FILL_UNKNOWN. Returns the number of unknown pixels.
int32_t FillUnknown(const starfocus_config& config, const simd::Kernels& kernels, int16_t* row);

// Discards the rows of the layers, which belong to another picture or are incomplete.
void ForgetLayers(const starfocus_config& config, RowStore* row_store);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_ROW_STORE_H_
