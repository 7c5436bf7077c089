// SPDX-License-Identifier: Apache-2.0
// The segments of a JPEG file that tell of its picture, without decoding it.
#ifndef STARFOCUS_PLATFORM_READERS_JPEG_PARTS_H_
#define STARFOCUS_PLATFORM_READERS_JPEG_PARTS_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Bytes of a file that somebody else keeps.
struct Span {
  const uint8_t* data = nullptr;
  size_t size = 0;

  bool empty() const { return size == 0; }
};

// One segment of extended XMP (XMP specification part 3, 1.1.3.1).
struct XmpExtension {
  std::string guid;
  uint32_t total = 0, offset = 0;  // of the whole text, and where this part of it lies
  Span text;
};

struct JpegParts {
  Metadata metadata;      // EXIF, the profile and IPTC
  std::string ignored;    // why a profile was left out; empty if none was
  std::vector<Span> xmp;  // packets; a second one is against the specification, but is found
  std::vector<XmpExtension> extensions;
  Span multi_picture;  // from the TIFF header of CIPA DC-007 to the end of the segment
  size_t end = 0;      // of the first picture: what follows belongs to others
};

// Whether the bytes begin as a JPEG file does.
bool IsJpeg(Span file);

// Reads the segments of the first picture. The parts of an ICC profile are joined by their numbers,
// in any order; a profile that is not whole or not of RGB colours is left out.
Result<JpegParts> ReadJpegParts(const std::string& where, Span file);

// The extended XMP of that GUID, put together.
Result<std::string> JoinExtensions(const std::string& where, const JpegParts& parts,
                                   const std::string& guid);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_JPEG_PARTS_H_
