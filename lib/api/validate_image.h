// SPDX-License-Identifier: Apache-2.0
// Checks of images and depth maps, and where their bytes lie.
#ifndef STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
#define STARFOCUS_LIB_API_VALIDATE_IMAGE_H_

#include "lib/source/extents.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct PictureSize {
  int32_t width, height;
};

// Checks `count` views.
sf_status CheckViews(const sf_light_field& light_field, int32_t count, const PictureSize& size,
                     sf_problem* problem);

// Checks the map of a picture of that size.
sf_status CheckDepthMap(const sf_depth_map& map, const PictureSize& size, sf_problem* problem);

// Checks that `count` views are of formats that are read in place.
sf_status CheckInPlace(const sf_light_field& light_field, int32_t count, sf_problem* problem);

// Checks that a map is, too.
sf_status CheckInPlace(const sf_depth_map& map, const PictureSize& size, sf_problem* problem);

// Checks a light field for pictures of `config`.
sf_status CheckLightField(const sf_config& config, const sf_light_field& light_field);

// Adds all planes of a light field.
void AddLightField(const sf_config& config, const sf_light_field& light_field, Extents* extents);

// Adds the planes of a picture of that size.
void AddImage(const sf_image& image, const PictureSize& size, Extents* extents);

// Checks a picture of that size for the engine to write, by itself.
sf_status CheckOutput(const sf_config& config, const sf_image& image, const PictureSize& size);

// Checks that it does not overlap what is read.
sf_status CheckOutputApart(const sf_image& image, const PictureSize& size, const Extents& read,
                           sf_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
