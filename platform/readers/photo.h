// SPDX-License-Identifier: Apache-2.0
// Defines the result of all readers of depth photographs: a picture, a depth map or a matte of any
// size, and the meaning of the values of the map.
#ifndef STARFOCUS_PLATFORM_READERS_PHOTO_H_
#define STARFOCUS_PLATFORM_READERS_PHOTO_H_

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "platform/file.h"
#include "platform/gain_map.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/pfm.h"
#include "platform/readers/depth_options.h"
#include "platform/readers/map_survey.h"

namespace starfocus {

// Properties of an input that programs display, each with a name and a value.
using Facts = std::vector<std::pair<std::string, std::string>>;

enum class MapMeaning {
  kInverseMetres,  // Inverse distances in 1 / metre.
  kInverse,        // Inverse distances, up to an unknown factor.
  kOrder,          // An order without distances: larger is nearer.
  kDisparity       // Disparities in pixels of the upright photo.
};

struct DepthPhoto {
  std::string format;
  Image picture;
  // The same picture, if the file has more than 8 bits or alpha, and the colours that its file
  // describes. `picture` and `metadata` describe the picture in 8 bits.
  std::optional<DeepImage> deep;
  ColourDescription deep_colours;
  FloatMap map;             // Depth map; NaN: unknown depth; empty: no readable map.
  std::string map_problem;  // Reason why the map in the file cannot be read; may be empty.
  std::string depth_path;   // Path of the depth picture; empty: the map is in the file.
  GainMap gain_map;         // Light of `picture` beyond white; no levels: no readable gain map.
  FloatMap matte;           // Alpha of the subject, 0 to 1, of any size; empty: no matte.
  bool is_mask = false;     // True if `matte` is a mask of the subject in the file.
  std::string matte_path;   // Path of the matte; empty: the matte is in the file, or computed.
  std::vector<std::string> matte_notes;  // Notes that apply if the matte in the file is used.
  Image right;                           // Right picture of a stereo pair; empty: no stereo pair.
  std::string right_path;                // Path of the right picture; empty: both are in one file.
  MapMeaning meaning = MapMeaning::kOrder;
  bool guesses_near = false;  // True if it is unknown whether larger values of `map` are nearer.
  MapSurvey survey;           // Figures of `map`.
  int orientation = 1;        // EXIF orientation that has not been applied yet.
  // EXIF orientation that has been applied to `picture`, `map` and `matte`.
  int applied_orientation = 1;
  double focal_35mm = 0;  // Equivalent focal length on full frame in millimetres; 0: unknown.
  // True if the camera has blurred the background of `picture`, as its EXIF states.
  bool is_blurred = false;
  bool has_focus = false;
  // Focus point, as fractions of the width and height before rotation.
  double focus_x = 0, focus_y = 0;
  bool has_subject = false;
  // Position of the subject in EXIF, in the units of focus_x and focus_y.
  double subject_x = 0, subject_y = 0;
  // True if the map requires no repair, because starfocus wrote the file.
  bool is_ready = false;
  bool is_linear = false;    // True if light is proportional to the codes of `picture`.
  double focus_value = NAN;  // Value of `map` that is in focus; NaN: unknown.
  Metadata metadata;
  Facts facts;
  std::vector<std::string> notes;
  std::vector<std::string> lost;  // Notes on what `picture` lacks, but `deep` has.  // Assumptions
                                  // that the user may correct.
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PHOTO_H_
