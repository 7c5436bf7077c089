// SPDX-License-Identifier: Apache-2.0
// A photograph's file of any format, and which of the formats its depth map is in.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Reads a photograph and its map: from the depth picture `depth` if that is named, else from within
// the file, else from a depth picture beside it. Where there is no map, the file may be a stereo
// pair: `right` of the photo is its other picture then. What cannot be read but is not needed is
// ignored, which the notes of the photo say. `options` are about the depth picture: an option
// beyond the near end is an error for a map within the file.
Result<DepthPhoto> ReadDepthPhotoFile(const std::string& path, const DepthOptions& options,
                                      const std::string& depth);

// The same of bytes in memory, without what lies beside: the map is empty if they have none that
// can be read.
Result<DepthPhoto> DecodeDepthPhoto(const std::string& where, Span file, bool with_map, Near near);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
