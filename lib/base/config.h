// SPDX-License-Identifier: Apache-2.0
// Configurations and parameters inside the library, where all fields are set. The structures of
// callers may be shorter and may lack a tuning or a study (lib/api/validate.h).
#ifndef STARFOCUS_LIB_BASE_CONFIG_H_
#define STARFOCUS_LIB_BASE_CONFIG_H_

#include <cstdint>

#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A configuration with the tuning by value, which hides the caller's pointer.
struct FullConfig : starfocus_config {
  starfocus_tuning tuning;
  starfocus_problem* problem;  // Receives the cause of an error; may be null.
};

// Parameters with the fields of starfocus_study by value.
struct FullParams : starfocus_params {
  int32_t mode, renderer;
};

// Returns true if a configuration contains the STARFOCUS_FEATURE_ bit `feature`.
inline bool Has(const starfocus_config& config, uint32_t feature) {
  return (config.features & feature) != 0;
}

// False in builds without the code for deep pictures, such as the npm package, whose pictures have
// 8 bits (STARFOCUS_DEEP in CMakeLists.txt).
#ifdef STARFOCUS_WITHOUT_DEEP
inline constexpr bool kDeep = false;
#else
inline constexpr bool kDeep = true;
#endif

// Returns true if pictures may be deep (lib/io/deep.h).
inline bool HasDeep(const starfocus_config& config) {
  return kDeep && Has(config, STARFOCUS_FEATURE_DEEP);
}

// Returns true if pictures and maps may have any format.
inline bool ReadsImages(const starfocus_config& config) {
  return Has(config, STARFOCUS_FEATURE_IMAGES) || HasDeep(config);
}

// Return the limits of disparities in float, the type of the values in depth maps.
inline float MinDisparity(const starfocus_config& config) {
  return static_cast<float>(config.disparity_min);
}
inline float MaxDisparity(const starfocus_config& config) {
  return static_cast<float>(config.disparity_max);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_CONFIG_H_
