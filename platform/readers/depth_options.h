// SPDX-License-Identifier: Apache-2.0
// User options for properties of a depth picture that the file of the picture does not state.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_

#include <vector>

namespace starfocus {

// Near end of the value range of a depth picture.
enum class Near { kUnknown, kWhite, kBlack };

// Unit of the values of a depth picture.
enum class DepthUnit {
  kNone,         // only an order
  kMetres,       // distances in metres
  kMillimetres,  // distances in millimetres
  kDisparity,    // disparities: pixels of the photo for an aperture of radius 1
};

// How a depth picture is oriented in its file, relative to the photo.
enum class DepthOrientation {
  kUnknown,  // decided by comparing the edges of photo and map
  kPhoto,    // oriented as the photo's file: EXIF's orientation applies to both
  kUpright,  // oriented as the photo after EXIF's orientation is applied
};

struct DepthOptions {
  Near near = Near::kUnknown;
  DepthUnit unit = DepthUnit::kNone;
  DepthOrientation orientation = DepthOrientation::kUnknown;
  // True if `unknown` lists the values that mean an unknown depth. If false, MarkUnknown decides
  // whether 0 and 65535 are depths in 16-bit maps.
  bool has_unknown = false;
  std::vector<double> unknown;
  bool use_alpha = true;  // treat transparent pixels as unknown
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_OPTIONS_H_
