// SPDX-License-Identifier: Apache-2.0
// A photograph with a depth map, as the reader of a format hands it on: a picture, a map of any
// size and what its numbers stand for.
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

// What was understood of an input, in words for people: a name, and a value.
using Facts = std::vector<std::pair<std::string, std::string>>;

enum class MapMeaning {
  kInverseMetres,  // 1 / distance in metres
  kInverse,        // 1 / distance, up to a factor that nobody knows
  kOrder,          // larger is nearer, and that is all
  kDisparity       // disparities of the upright photo, in pixels
};

struct DepthPhoto {
  std::string format;
  Image picture;
  FloatMap map;             // NaN: unknown; empty: none that can be read
  std::string map_problem;  // why a map in the file cannot be read
  std::string depth_path;   // the depth picture that the map is of; empty: it is in the file
  Image right;              // of a stereo pair, whose left picture is `picture`; empty: none
  MapMeaning meaning = MapMeaning::kOrder;
  int orientation = 1;    // of EXIF: what is still to be done to picture and map
  double focal_35mm = 0;  // equivalent focal length in millimetres; 0: nobody knows
  bool has_focus = false;
  double focus_x = 0, focus_y = 0;  // in parts of width and height, before `orientation`
  bool has_subject = false;
  double subject_x = 0, subject_y = 0;  // of EXIF, likewise
  bool is_ready = false;                // the map has made pictures: nothing is to be repaired
  double focus_value = NAN;             // of the map, where a distance in focus is told
  Metadata metadata;
  Facts facts;
  std::vector<std::string> notes;  // what was guessed, for whoever may know better
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PHOTO_H_
