// SPDX-License-Identifier: Apache-2.0
// Defines the result of all readers of depth photographs: a picture, a depth map of any size, and
// the meaning of the values of the map.
#ifndef STARFOCUS_PLATFORM_READERS_PHOTO_H_
#define STARFOCUS_PLATFORM_READERS_PHOTO_H_

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/pfm.h"
#include "platform/readers/depth_options.h"

namespace starfocus {

// Properties of an input that programs display, each with a name and a value.
using Facts = std::vector<std::pair<std::string, std::string>>;

enum class MapMeaning {
  kInverseMetres,  // 1 / distance in metres
  kInverse,        // 1 / distance, up to an unknown factor
  kOrder,          // an order without distances: larger is nearer
  kDisparity       // disparities in pixels of the upright photo
};

struct DepthPhoto {
  std::string format;
  Image picture;
  FloatMap map;             // depth map; NaN: unknown depth; empty: no readable map
  std::string map_problem;  // reason why the map in the file cannot be read; may be empty
  std::string depth_path;   // path of the depth picture; empty: the map is in the file
  Image right;              // right picture of a stereo pair; empty: no stereo pair
  MapMeaning meaning = MapMeaning::kOrder;
  int orientation = 1;    // EXIF orientation that has not been applied yet
  double focal_35mm = 0;  // 35 mm equivalent focal length in millimetres; 0: unknown
  bool has_focus = false;
  double focus_x = 0, focus_y = 0;  // focus point, as fractions of width and height before rotation
  bool has_subject = false;
  double subject_x = 0, subject_y = 0;  // subject position in EXIF, in units of focus_x and focus_y
  // True if the map requires no repair, because starfocus wrote the file.
  bool is_ready = false;
  double focus_value = NAN;  // value of `map` that is in focus; NaN: unknown
  Metadata metadata;
  Facts facts;
  std::vector<std::string> notes;  // assumptions that the user may correct
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PHOTO_H_
