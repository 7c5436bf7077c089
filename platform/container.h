// SPDX-License-Identifier: Apache-2.0
// What a PNG or JPEG file says of its parts, checked before stb_image takes its word for it.
#ifndef STARFOCUS_PLATFORM_CONTAINER_H_
#define STARFOCUS_PLATFORM_CONTAINER_H_

#include <cstdint>
#include <optional>
#include <string>

#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

enum class Container {
  kUnknown,    // neither PNG nor JPEG
  kWhole,      // all parts are there, to the one that ends it
  kTruncated,  // a part reaches beyond the end of the file, or the last one is missing
  kBroken,     // a PNG chunk does not have its checksum, or a JPEG table more codes than bytes
};

Container CheckContainer(const Bytes& bytes);

// The error of a file of that format which ends before its last part.
Error Truncated(const std::string& where, const std::string& format);

// Describes a file that is no picture this program reads, for errors: "a text file", "a GIF file",
// "an empty file". "a file of an unknown format" if nothing is recognised.
std::string DescribeFile(const Bytes& bytes);

// Returns true if a chunk of a PNG file reaches beyond its end, or the last chunk is missing.
bool IsTruncatedPng(const Bytes& png);

// Whether the file may be a picture by its first bytes: PNG, JPEG, WebP, HEIF, PPM or PGM.
bool MayBePicture(const Bytes& beginning);

// Whether the file begins as a PNG file does.
bool IsPng(const Bytes& bytes);

// A segment of a JPEG file: its marker, and where what follows its length begins and ends.
struct JpegSegment {
  uint8_t marker;
  size_t begin, end;
};
constexpr uint8_t kJpegEndOfImage = 0xd9;  // a marker without a length

// The first segment from byte `at` on. Coded data lies between segments, where 0xff is stuffed or
// restarts the coder. None if the file ends before the segment does.
std::optional<JpegSegment> NextJpegSegment(const uint8_t* jpeg, size_t size, size_t at);

// The whole number in four bytes, the highest first.
uint32_t ReadBigEndian32(const uint8_t* bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CONTAINER_H_
