// SPDX-License-Identifier: Apache-2.0
// Checks of images and depth maps, and where their bytes lie.
#ifndef STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
#define STARFOCUS_LIB_API_VALIDATE_IMAGE_H_

#include "lib/base/geometry.h"
#include "starfocus/image.h"

namespace starfocus {

// Checks an image of that size.
sf_status CheckImage(const sf_image& image, int32_t width, int32_t height);

// Checks the views and the depth map for pictures of `config`.
sf_status CheckImageField(const sf_config& config, const sf_image_field& field);

// An output as an image that is read.
sf_image AsImage(const sf_image_out& out);

// Whether a plane of the image has bytes within `extent`.
bool OverlapsImage(const Extent& extent, const sf_image& image, int32_t width, int32_t height);

// Whether an image or the depth map of the field has bytes within `extent`.
bool OverlapsField(const Extent& extent, const sf_config& config, const sf_image_field& field);

// Whether a plane of the output has bytes within an image or the depth map of the field.
bool OverlapsField(const sf_image& out, int32_t width, int32_t height, const sf_config& config,
                   const sf_image_field& field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
