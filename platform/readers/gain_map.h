// SPDX-License-Identifier: Apache-2.0
// Reads gain maps (platform/gain_map.h): finds the map among the pictures of a JPEG file, and reads
// its metadata. The metadata are XMP of Adobe and Android (Ultra HDR 1.0), ISO 21496-1, or Apple's
// (apple_gain_map.h). ISO 21496-1 overrides XMP, as Ultra HDR 1.1 requires.
#ifndef STARFOCUS_PLATFORM_READERS_GAIN_MAP_H_
#define STARFOCUS_PLATFORM_READERS_GAIN_MAP_H_

#include <vector>

#include "platform/gain_map.h"
#include "platform/readers/appended_pictures.h"
#include "platform/readers/apple_mattes.h"
#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

// Sets the parameters of `map` to the properties hdrgm of the XMP of a gain map. Properties may be
// single numbers or lists of three. Returns an error if GainMapMax is absent, if a property is
// invalid, or if the base is the brighter picture.
Error ReadGainMapXmp(const XmpNode& xmp, GainMap* map);

// Sets the parameters of `map` to the metadata of ISO 21496-1 (C.2.2): `metadata` follows the name
// of the segment. Returns an error if the metadata are truncated, invalid or of a later version, if
// the base is the brighter picture, or if the gains are those of other primaries than the base's.
Error ReadGainMapIso(Span metadata, GainMap* map);

// Sets photo->gain_map to the gain map among the pictures that follow the first picture of a JPEG
// file. Returns an error if the file has gain maps, but none that is readable and has the shape of
// photo->picture. The caller must have read photo->picture and EXIF.
Error ReadGainMap(const std::vector<AppendedPicture>& appended, DepthPhoto* photo);

// Returns the fact about a gain map that was read, or not because of `problem`.
std::string GainMapFact(const GainMap& map, const Error& problem);

// Sets photo->gain_map to an auxiliary picture of a HEIF file whose type is kAppleGainMap, or
// returns an error. The caller must have read photo->picture and EXIF.
Error ReadAppleGainMap(const AuxiliaryPicture& picture, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_GAIN_MAP_H_
