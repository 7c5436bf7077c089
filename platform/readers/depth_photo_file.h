// SPDX-License-Identifier: Apache-2.0
// Reads a photograph with a depth map from a file of any supported format.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Files that belong to a photograph.
struct PhotoFiles {
  std::string depth = {};  // depth picture; empty: in the photo's file or next to it
  std::string matte = {};  // matte; empty: in the photo's file
};

// Reads a photograph, its depth map and its matte. The map is read from the depth picture
// `files.depth` if the path is not empty. If the path is empty, the map is read from the file of
// the photograph. If this file has no map, the map is read from a depth picture next to the file. A
// file without a map may be a stereo pair, or the left picture of a pair in the folders `left` and
// `right`; in both cases, `right` of the result is the right picture. The function ignores damaged
// optional data and adds a note. For a photograph without depth, options.estimate computes the
// depth picture if it is set. `options` apply to a separate depth picture. If the map is in the
// file of the photograph, any option except `near` and `estimate` is an error. For a stereo pair,
// `near` is an error, too.
//
// The matte comes from `files.matte`, the file of the photograph, or options.estimate_matte.
// DepthOptions::orientation applies to `files.matte` as well. A photograph without depth must have
// a matte. A stereo pair must not have a `files.matte`.
Result<DepthPhoto> ReadDepthPhotoFile(const std::string& path, const DepthOptions& options,
                                      const PhotoFiles& files);

// Returns true if the file of a photograph stores a readable depth map, matte or stereo pair. Reads
// a depth map in a JPEG file without the picture.
bool StoresDepth(const std::string& path);

// Decodes a photograph in memory, and its depth map if `with_map` is true. The map is empty if the
// file has no readable map.
Result<DepthPhoto> DecodeDepthPhoto(const std::string& where, Span file, bool with_map, Near near);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_PHOTO_FILE_H_
