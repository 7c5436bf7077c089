// SPDX-License-Identifier: Apache-2.0
// Where a picture is focused when the command line does not say.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_DEFAULT_FOCUS_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_DEFAULT_FOCUS_H_

#include <string>

#include "platform/readers/capture.h"

namespace starfocus {

struct DefaultFocus {
  bool at_pixel = true;
  int x = 0, y = 0;      // that pixel
  double disparity = 0;  // without a pixel
  std::string source;    // where the focus comes from, for people
};

// The subject that EXIF names, else the focus of the file, else FindSurface, in pixels of the
// picture. The map is read already; it may have unknown values and another size than the picture.
DefaultFocus FindDefaultFocus(const Capture& capture);

// A pixel of the nearest large surface near the centre: disparities alike on a tenth, at least, of
// the middle half of width and height. The centre where no disparity is known there. In pixels of
// the map.
DefaultFocus FindSurface(const FloatMap& map);

// Prints the focus and its source to stderr.
void TellFocus(const std::string& path, const DefaultFocus& focus);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_DEFAULT_FOCUS_H_
