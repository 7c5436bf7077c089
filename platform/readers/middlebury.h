// SPDX-License-Identifier: Apache-2.0
// Middlebury's stereo pairs. Those of 2014 and later have im0.png, im1.png, calib.txt and disp0.pfm
// with inf where nothing is known. Those of 2003 (im2, im6, disp2) and of 2005 and 2006 (view1,
// view5, disp1) have maps as grey pictures: a multiple of the disparity, and 0 where nothing is
// known.
#ifndef STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_
#define STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_

#include <optional>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/result.h"

namespace starfocus {

// Adds what calib.txt says to a folder that is open already.
Error ReadMiddlebury(const std::string& folder, Capture* capture);

// The pair of a folder whose map is a grey picture, its files and format; none if the folder has no
// such pair. `names` are sorted.
std::optional<Capture> FindGreyMapPair(const std::string& folder,
                                       const std::vector<std::string>& names);

// Loads the grey map of a pair whose views are loaded. The size of the pictures says which multiple
// of the disparity its levels are, unless the two pictures agree clearly better by another.
Error LoadGreyMap(Capture* capture);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_
