// SPDX-License-Identifier: Apache-2.0
// The segments of a JPEG file that hold no pixels: EXIF, the colour profile, XMP, IPTC.
#ifndef STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_
#define STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

// Each appends segments to others, nothing for empty metadata. False where the format has no room
// for so much: EXIF has one segment, a profile 255 of them.
bool AppendExif(const Bytes& tiff, Bytes* segments);
bool AppendProfile(const Bytes& icc, Bytes* segments);

// The records of IPTC-IIM.
bool AppendIptc(const Bytes& iptc, Bytes* segments);

// A packet of XMP with these descriptions (Metadata::xmp).
bool AppendXmp(const std::string& descriptions, Bytes* segments);

// The same as a whole packet, for the files of other formats. Empty for no descriptions.
std::string XmpPacket(const std::string& descriptions);

// A packet of XMP: `descriptions`, the attributes of one more, and an extended packet of `extended`
// ones, which may be of any length below 4 GiB, named by the first. An attribute is '
// prefix:Name="value"', escaped as XML; `namespaces` declares the prefixes, ' xmlns:prefix="..."'
// each.
bool AppendExtendedXmp(const std::string& namespaces, const std::string& attributes,
                       const std::string& extended, const std::string& descriptions,
                       Bytes* segments);

// Puts the segments into a whole JPEG file, before all but its JFIF header.
void InsertSegments(const Bytes& segments, Bytes* jpeg);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_
