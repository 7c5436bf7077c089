// SPDX-License-Identifier: Apache-2.0
// Middlebury's stereo pairs of 2014 and later: im0.png, im1.png, disp0.pfm with inf where nothing
// is known, calib.txt.
#ifndef STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_
#define STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_

#include <string>

#include "platform/readers/capture.h"

namespace starfocus {

// Adds what calib.txt says to a folder that is open already.
std::string ReadMiddlebury(const std::string& folder, Capture* capture);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MIDDLEBURY_H_
