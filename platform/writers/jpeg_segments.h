// SPDX-License-Identifier: Apache-2.0
// Writes the segments of a JPEG file other than its pixels: EXIF, the colour profile, XMP and IPTC.
#ifndef STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_
#define STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

// Each function Append... appends segments to `segments`, or nothing if the metadata is empty. An
// Append function returns false if the metadata exceeds the limits of the format: one segment for
// EXIF, 255 segments for a profile.
bool AppendExif(const Bytes& tiff, Bytes* segments);
bool AppendProfile(const Bytes& icc, Bytes* segments);

// Appends the records of IPTC-IIM.
bool AppendIptc(const Bytes& iptc, Bytes* segments);

// Appends an XMP packet with the rdf:Descriptions in `descriptions` (Metadata::xmp).
bool AppendXmp(const std::string& descriptions, Bytes* segments);

// Appends a segment APP2: `name`, a zero byte and `content`, together at most 65533 bytes.
void AppendApp2(const std::string& name, const std::string& content, Bytes* segments);

// Returns a complete XMP packet for files that are not JPEG, or an empty string if `descriptions`
// is empty.
std::string XmpPacket(const std::string& descriptions);

// Appends an XMP packet and an extended packet of up to 4 GiB, to which the first packet refers.
// The first XMP packet contains `descriptions`, and a further rdf:Description with the attributes
// `attributes`. The extended XMP packet contains the attributes `extended`. Each attribute has the
// form `prefix:Name="value"`, escaped as XML and preceded by a space. `namespaces` declares each
// prefix in the form `xmlns:prefix="..."`, preceded by a space.
bool AppendExtendedXmp(const std::string& namespaces, const std::string& attributes,
                       const std::string& extended, const std::string& descriptions,
                       Bytes* segments);

// Inserts the segments into a complete JPEG file, after the JFIF header if the file has one.
void InsertSegments(const Bytes& segments, Bytes* jpeg);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_JPEG_SEGMENTS_H_
