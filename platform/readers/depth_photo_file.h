// SPDX-License-Identifier: Apache-2.0
// A photograph's file of any format, and which of the formats its depth map is in.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Reads a photograph and its map: from the depth picture *depth if that is named, else from within
// the file, else from a depth picture beside it, whose name *depth becomes.
// `options` are about the depth picture: what they say of a map within the file beyond its near end
// is an error.
std::string ReadDepthPhotoFile(const std::string& path, const DepthOptions& options,
                               std::string* depth, DepthPhoto* photo);

// The same of bytes in memory, without what lies beside: photo->map is empty if they have none.
std::string DecodeDepthPhoto(const std::string& where, Span file, bool with_map, Near near,
                             DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
