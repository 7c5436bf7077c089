// SPDX-License-Identifier: Apache-2.0
// Reads the matte of a photograph from a file of its own, or computes it.
#ifndef STARFOCUS_PLATFORM_READERS_MATTE_FILE_H_
#define STARFOCUS_PLATFORM_READERS_MATTE_FILE_H_

#include <string>

#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Reads the matte of a photo from the file `path`, in a format of depth pictures (depth_file.h).
// Alpha is the alpha channel of a PNG file unless it is opaque everywhere, otherwise the grey
// level. Grey levels and values up to 1 are alpha from 0 to 1. Otherwise full alpha is the white of
// the picture, or 255 for floats and integers of more than 16 bits. options.orientation states
// whether the orientation of EXIF applies to the matte. The matte replaces a matte in the file of
// the photo. The function returns an error unless the matte belongs to the photo (CheckMatte).
Error ReadMatteFile(const std::string& path, const DepthOptions& options, DepthPhoto* photo);

// Interprets the samples of the matte picture `path` as the matte of the photo, like ReadMatteFile.
Error TakeMattePicture(const std::string& path, const DepthOptions& options, Samples samples,
                       DepthPhoto* photo);

// Computes the matte of a photo by options.estimate_matte, which must be set. `where` is the name
// of the photo.
Error EstimateMatte(const std::string& where, const DepthOptions& options, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MATTE_FILE_H_
