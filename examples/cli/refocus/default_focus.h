// SPDX-License-Identifier: Apache-2.0
// Chooses the focus if the command line does not specify a focus.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_DEFAULT_FOCUS_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_DEFAULT_FOCUS_H_

#include <string>

#include "platform/readers/capture.h"

namespace starfocus {

struct DefaultFocus {
  bool at_pixel = true;
  int x = 0, y = 0;      // Pixel in focus.
  double disparity = 0;  // Disparity in focus if at_pixel is false.
  std::string source;    // Description of the origin of the focus, for users.
};

// Returns the subject of the matte if the photo has no depth. Otherwise returns, in this order of
// preference, the subject in EXIF, the focus stored in the file, the subject of the matte, or the
// result of FindSurface. The disparity of the subject is the median of the map where alpha is at
// least 3/4, or 1/2 if none of 256x256 places has
// 3/4. Coordinates are pixels of the picture. The map must be
// loaded. The map may contain unknown values and may differ in size from the picture.
DefaultFocus FindDefaultFocus(const Capture& capture);

// Returns a pixel of the nearest large surface near the centre. A large surface has similar
// disparities, and covers at least a tenth of the central area with half the width and height of
// the map. Returns the centre of the map if all disparities in the middle half are unknown.
// Coordinates are pixels of the map.
DefaultFocus FindSurface(const FloatMap& map);

// Prints the origin of the focus to stderr.
void TellFocus(const std::string& path, const DefaultFocus& focus);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_DEFAULT_FOCUS_H_
