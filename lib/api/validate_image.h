// SPDX-License-Identifier: Apache-2.0
// Checks of images and depth maps, and where their bytes lie.
#ifndef STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
#define STARFOCUS_LIB_API_VALIDATE_IMAGE_H_

#include "lib/source/extents.h"
#include "starfocus/image.h"

namespace starfocus {

// Whether the engine is made for images.
sf_status NeedImages(const sf_config& config);

// Checks an image of that size, view `index` or the output.
sf_status CheckImage(const sf_image& image, const Rect& size, sf_problem* problem,
                     int32_t index = 0);

// Checks the views and the depth map for pictures of `config`.
sf_status CheckImageField(const sf_config& config, const sf_image_field& field);

// Adds the images and the depth map of a field.
void AddImageField(const sf_config& config, const sf_image_field& field, Extents* extents);

// Checks an output of that size that must not overlap what is read.
sf_status CheckImageOutput(const sf_image& image, const Rect& size, const Extents& read,
                           sf_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
