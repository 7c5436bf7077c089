// SPDX-License-Identifier: Apache-2.0
// Checks images and depth maps, and collects the address ranges of their planes.
#ifndef STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
#define STARFOCUS_LIB_API_VALIDATE_IMAGE_H_

#include "lib/base/geometry.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct PictureSize {
  int32_t width, height;
};

// Checks `count` views.
starfocus_status CheckViews(const starfocus_light_field& light_field, int32_t count,
                            const PictureSize& size, starfocus_problem* problem);

// Checks the depth map of a picture of the given size.
starfocus_status CheckDepthMap(const starfocus_depth_map& map, const PictureSize& size,
                               starfocus_problem* problem);

// Checks a depth map and the size of its picture, which no configuration has checked.
starfocus_status CheckLoneMap(const starfocus_depth_map& map, const PictureSize& size);

// Checks that `count` views have formats that are read in place.
starfocus_status CheckInPlace(const starfocus_light_field& light_field, int32_t count,
                              starfocus_problem* problem);

// Checks that a depth map has a format that is read in place.
starfocus_status CheckInPlace(const starfocus_depth_map& map, const PictureSize& size,
                              starfocus_problem* problem);

// Checks a light field for an engine of `config`.
starfocus_status CheckLightField(const starfocus_config& config,
                                 const starfocus_light_field& light_field);

// Adds the address range of a depth map to *extents.
void AddDepthMap(const starfocus_depth_map& map, Extents* extents);

// Adds the address ranges of all planes of a light field to *extents.
void AddLightField(const starfocus_config& config, const starfocus_light_field& light_field,
                   Extents* extents);

// Adds the address ranges of the planes of a picture of the given size to *extents.
void AddImage(const starfocus_image& image, const PictureSize& size, Extents* extents);

// Checks an output picture of the given size, except for overlaps with other memory.
starfocus_status CheckOutput(const starfocus_config& config, const starfocus_image& image,
                             const PictureSize& size);

// Checks that an output picture does not overlap the inputs.
starfocus_status CheckOutputApart(const starfocus_image& image, const PictureSize& size,
                                  const Extents& read, starfocus_problem* problem);

// If `status` is the error of a wrong disparity, adds the place of the first disparity of `map`
// that is not finite or outside the range of *problem. `first` is the row of the whole map at which
// `map` begins. `problem` may be null. Returns `status`.
starfocus_status TellPlace(starfocus_status status, const starfocus_depth_map& map, int32_t first,
                           starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_IMAGE_H_
