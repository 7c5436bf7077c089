// SPDX-License-Identifier: Apache-2.0
// User options for properties of a depth picture that the file of the picture does not state, and
// for the computation of a missing depth picture.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_

#include <cstdint>
#include <functional>
#include <vector>

#include "platform/image.h"
#include "platform/levels.h"
#include "platform/readers/map_survey.h"
#include "platform/result.h"

namespace starfocus {

// Meaning of the values of a depth picture.
enum class DepthUnit {
  kNone,       // Values without a unit, which define only an order of depth.
  kDistance,   // Distances in the unit DepthOptions::metres; +inf is infinitely far.
  kDepth16,    // Android's DEPTH16: millimetres in the lower 13 bits of 16-bit values.
  kDisparity,  // Disparities in pixels of the photo, for an aperture of radius 1.
};

// Orientation of a depth picture in its file, relative to the photo.
enum class DepthOrientation {
  kUnknown,  // Determined from the proportions and edges of photo and map.
  kPhoto,    // Oriented like the stored photo: EXIF's orientation applies to photo and map.
  kUpright,  // Upright: EXIF's orientation applies only to the photo.
};

struct DepthOptions {
  Near near = Near::kUnknown;
  DepthUnit unit = DepthUnit::kNone;
  double metres = 1;  // Unit of distances in metres.
  DepthOrientation orientation = DepthOrientation::kUnknown;
  // True if `unknown` lists the values that mean an unknown depth. If has_unknown is false,
  // MarkUnknown decides whether values up to 0 and 65535 are depths.
  bool has_unknown = false;
  std::vector<double> unknown;
  Alpha alpha = Alpha::kTransparent;  // By default, transparent pixels have unknown depth.
  const MapSurvey* clip = nullptr;    // Figures of all maps of a clip; null: a single photo.
  // True: the background of a matte comes nearer towards the lower edge of the picture.
  bool floor = false;
  // True: the photo is a frame of a clip, whose matte may be empty or full, because subjects leave
  // the picture.
  bool is_frame = false;
  // Computes a depth picture of an upright photo for which no depth is found; null: such a photo is
  // an error.
  // If `estimate` is set, the other options do not apply to a depth map in the file of a photo.
  std::function<Result<Samples>(const Image& photo)> estimate = nullptr;
  // Computes the matte of an upright photo that has no matte; null: such a photo has none.
  std::function<Result<Samples>(const Image& photo)> estimate_matte = nullptr;
  // Receives the bytes that decoding a photo or depth picture takes (decoding_memory.h), before it
  // is decoded; null: not needed.
  std::function<void(uint64_t bytes)> before_decoding = nullptr;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_
