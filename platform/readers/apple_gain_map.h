// SPDX-License-Identifier: Apache-2.0
// Reads the metadata of the gain maps that Apple's cameras store as auxiliary pictures of HEIC and
// JPEG files. Apple documents them in "Applying Apple HDR effect to your photos": for a level g,
// encoded by the curve of Rec. 709, the light of the base is multiplied with
// 1 + (headroom - 1) * decoded(g). EXIF states the headroom in the maker note.
#ifndef STARFOCUS_PLATFORM_READERS_APPLE_GAIN_MAP_H_
#define STARFOCUS_PLATFORM_READERS_APPLE_GAIN_MAP_H_

#include "platform/file.h"
#include "platform/gain_map.h"
#include "platform/readers/xmp.h"

namespace starfocus {

// Type of the auxiliary picture.
inline constexpr char kAppleGainMap[] = "urn:com:apple:photo:2020:aux:hdrgainmap";

// Returns true if `xmp` is that of one of Apple's gain maps.
bool IsAppleGainMap(const XmpNode& xmp);

// Returns the headroom in stops: the factor of 2 by which the brightest light exceeds white. `xmp`
// is that of the map, and `exif` that of the photograph. The property HDRGainMapHeadroom of the XMP
// overrides the tags 33 (0x21) and 48 (0x30) of the maker note. An absent tag counts as 0, as many
// cameras omit tag 48; without any, the headroom is 1.8 stops.
double AppleHeadroom(const XmpNode& xmp, const Bytes& exif);

// Converts the levels of Apple's gain map with the given headroom to the form of GainMap, and sets
// its parameters.
void ToStops(double headroom, GainMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_APPLE_GAIN_MAP_H_
