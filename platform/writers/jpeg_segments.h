// SPDX-License-Identifier: Apache-2.0
// The segments of a JPEG file that hold no pixels: EXIF, the colour profile, XMP.
#ifndef STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_
#define STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

// Each appends segments to others. False where the format has no room for so much: EXIF has one
// segment, a profile 255 of them.
bool AppendExif(const Bytes& tiff, Bytes* segments);
bool AppendProfile(const Bytes& icc, Bytes* segments);

// A packet of XMP: the attributes of its description, and an extended packet of `extended` ones,
// which may be of any length below 4 GiB, named by the first. An attribute is '
// prefix:Name="value"', escaped as XML; `namespaces` declares the prefixes, ' xmlns:prefix="..."'
// each.
bool AppendXmp(const std::string& namespaces, const std::string& attributes,
               const std::string& extended, Bytes* segments);

// Puts the segments into a whole JPEG file, before all but its JFIF header.
void InsertSegments(const Bytes& segments, Bytes* jpeg);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_
