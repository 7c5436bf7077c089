// SPDX-License-Identifier: Apache-2.0
// Checks of everything that comes from outside, before anything is written.
#ifndef STARFOCUS_LIB_API_VALIDATE_H_
#define STARFOCUS_LIB_API_VALIDATE_H_

#include <cstddef>
#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

sf_status CheckConfig(const sf_config& config);
sf_status CheckParams(const sf_config& config, const sf_params& params);

// Checks memory to lay something out in.
sf_status CheckMemory(const void* memory);

// Checks a disparity map by itself.
sf_status CheckMap(const float* disparity, size_t stride, int32_t width, int32_t height);

// Tells whether rows are as wide as `row_bytes`, and all of them addressable.
bool ValidStride(size_t stride, size_t row_bytes, int32_t rows);

// Whether a light field may have that coverage, or none: null.
bool ValidCoverage(const sf_config& config, const uint8_t* coverage, size_t stride);

// Checks pointers and strides of the views of a light field.
sf_status CheckViews(int32_t views, int32_t width, int32_t height,
                     const sf_light_field& light_field);

// Checks pointers and strides of a light field of `config`.
sf_status CheckLightField(const sf_config& config, const sf_light_field& light_field);

// Checks that a region is all 0, or inside the picture.
sf_status CheckRegion(const sf_config& config, const sf_region& region);

// Checks an output of `rows` rows of `width` pixels.
sf_status CheckOutput(int32_t width, int32_t rows, const uint8_t* out, size_t stride);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_H_
