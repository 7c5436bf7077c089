// SPDX-License-Identifier: Apache-2.0
// Reads Middlebury's stereo pairs. Middlebury's data sets of 2014 and later have im0.png, im1.png,
// calib.txt and disp0.pfm, with inf for unknown disparities. Older data sets store disparity maps
// as grey pictures. A grey level is a multiple of the disparity, or 0 if the disparity is unknown.
// The files of these older data sets are im2, im6 and disp2 (2003), or view1, view5 and disp1 (2005
// and 2006).
#ifndef STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_
#define STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_

#include <optional>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/result.h"

namespace starfocus {

// Adds the properties in calib.txt to the capture of an already opened folder.
Error ReadMiddlebury(const std::string& folder, Capture* capture);

// Finds a stereo pair whose map is a grey picture. Returns the files and the format of the pair, or
// nullopt if the folder has no such pair. `names` must be sorted.
std::optional<Capture> FindGreyMapPair(const std::string& folder,
                                       const std::vector<std::string>& names);

// Loads the grey map of a stereo pair whose views are already loaded. The ratio of grey levels to
// disparities follows from the picture size, unless both pictures agree clearly better with another
// ratio.
Error LoadGreyMap(Capture* capture);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_
