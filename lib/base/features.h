// SPDX-License-Identifier: Apache-2.0
// Queries of a configuration.
#ifndef STARFOCUS_LIB_BASE_FEATURES_H_
#define STARFOCUS_LIB_BASE_FEATURES_H_

#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// Returns true if `features` contains the STARFOCUS_FEATURE_ bit `feature`.
constexpr bool Has(uint32_t features, uint32_t feature) { return (features & feature) != 0; }

// Returns true if the engine supports polygons and cat's eyes.
inline bool HasShapes(const starfocus_config& config) {
  return Has(config.features, STARFOCUS_FEATURE_SHAPES);
}

// Range of disparities in float, the type of the values in depth maps.
struct DisparityRange {
  float min, max;
};
inline DisparityRange RangeOf(const starfocus_config& config) {
  return {static_cast<float>(config.disparity_min), static_cast<float>(config.disparity_max)};
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_FEATURES_H_
