// SPDX-License-Identifier: Apache-2.0
// Queries of the features and the limits of a configuration.
#ifndef STARFOCUS_LIB_BASE_FEATURES_H_
#define STARFOCUS_LIB_BASE_FEATURES_H_

#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// Returns true if a starfocus_config or a starfocus_depth_config contains the STARFOCUS_FEATURE_
// bit `feature`.
template <class Config>
constexpr bool Has(const Config& config, uint32_t feature) {
  return (config.features & feature) != 0;
}

// Return the limits of disparities in float, the type of the values in depth maps.
template <class Config>
constexpr float MinDisparity(const Config& config) {
  return static_cast<float>(config.disparity_min);
}
template <class Config>
constexpr float MaxDisparity(const Config& config) {
  return static_cast<float>(config.disparity_max);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_FEATURES_H_
