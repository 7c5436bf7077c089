// SPDX-License-Identifier: Apache-2.0
// Reads a photograph with a depth map from a file of any supported format.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Reads a photograph and its map. The map is read from the depth picture `depth` if the path is not
// empty. Otherwise, the map is read from the file of the photograph or, if the file has none, from
// a depth picture next to the file. If there is no map, the file may be a stereo pair; then
// photo.right is the right picture. Damaged optional data is ignored with a note. `options` apply
// to a depth picture. If the map is in the file, any option except `near` is an error.
Result<DepthPhoto> ReadDepthPhotoFile(const std::string& path, const DepthOptions& options,
                                      const std::string& depth);

// Decodes a photograph in memory, and its map if `with_map` is true. The map is empty if the file
// has no readable map.
Result<DepthPhoto> DecodeDepthPhoto(const std::string& where, Span file, bool with_map, Near near);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
