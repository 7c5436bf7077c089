// SPDX-License-Identifier: Apache-2.0
// What a user says about a depth picture that the picture does not say itself.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_

#include <vector>

namespace starfocus {

// Which end of a depth picture is near.
enum class Near { kUnknown, kWhite, kBlack };

// What the numbers of a depth picture are.
enum class DepthUnit {
  kNone,    // an order
  kMetres,  // distances
  kMillimetres,
  kDisparity,  // pixels of the photo, at an aperture of radius 1
};

// How a depth picture stands in its file.
enum class DepthOrientation {
  kUnknown,  // decided by the edges of photo and map
  kPhoto,    // as the pixels in the photo's file: EXIF's orientation turns both
  kUpright,  // as the photo after it is turned
};

struct DepthOptions {
  Near near = Near::kUnknown;
  DepthUnit unit = DepthUnit::kNone;
  DepthOrientation orientation = DepthOrientation::kUnknown;
  // Values that stand for an unknown depth. Without them, 0 and 65535 of 16 bits are judged.
  bool has_unknown = false;
  std::vector<double> unknown;
  bool use_alpha = true;  // transparent pixels are unknown
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_
