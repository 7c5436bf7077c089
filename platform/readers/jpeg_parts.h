// SPDX-License-Identifier: Apache-2.0
// Reads the segments of a JPEG file that describe its picture, without decoding the picture.
#ifndef STARFOCUS_PLATFORM_READERS_JPEG_PARTS_H_
#define STARFOCUS_PLATFORM_READERS_JPEG_PARTS_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// A range of bytes. Span does not own the bytes.
struct Span {
  const uint8_t* data = nullptr;
  size_t size = 0;

  bool empty() const { return size == 0; }
};

// A segment of extended XMP (XMP specification part 3, 1.1.3.1).
struct XmpExtension {
  std::string guid;
  // Length of the whole extended XMP in bytes, and offset of the segment in the extended XMP.
  uint32_t total = 0, offset = 0;
  Span text;
};

struct JpegParts {
  Metadata metadata;      // EXIF, ICC profile and IPTC.
  std::string ignored;    // Reason for ignoring an ICC profile; empty: no profile was ignored.
  std::vector<Span> xmp;  // XMP packets; some files have several, against the specification.
  std::vector<XmpExtension> extensions;
  Span multi_picture;  // Multi-picture index (CIPA DC-007), from its TIFF header to the end of the
                       // segment.
  Span iso_gain_map;   // Metadata by ISO 21496-1 of a picture that is a gain map.
  size_t end = 0;      // End of the first picture; other pictures may follow.
};

// Returns true if the bytes contain `part`.
bool Contains(Span text, const std::string& part);

// Returns true if the bytes start with the signature of JPEG files.
bool IsJpeg(Span file);

// Reads the segments of the first picture of a JPEG file. The parts of an ICC profile may be in any
// order. An ICC profile is ignored if it is incomplete or not for RGB colours.
Result<JpegParts> ReadJpegParts(const std::string& where, Span file);

// Joins the parts of the extended XMP that have the GUID `guid`.
Result<std::string> JoinExtensions(const std::string& where, const JpegParts& parts,
                                   const std::string& guid);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_JPEG_PARTS_H_
