// SPDX-License-Identifier: Apache-2.0
// Checks the structure of PNG and JPEG files before stb_image relies on this structure, and
// recognizes file types.
#ifndef STARFOCUS_PLATFORM_CONTAINER_H_
#define STARFOCUS_PLATFORM_CONTAINER_H_

#include <cstdint>
#include <optional>
#include <string>

#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

enum class Container {
  kUnknown,    // File that is neither PNG nor JPEG.
  kWhole,      // Complete file, including its end marker.
  kTruncated,  // File that ends within one of its parts, or without an end marker.
  kBroken,     // A PNG chunk has a wrong checksum, or a JPEG table has more codes than bytes.
};

Container CheckContainer(const Bytes& bytes);

// Returns the error for a truncated file of the format `format`.
Error Truncated(const std::string& where, const std::string& format);

// Returns a description of an unsupported file, for use in error messages: "a text file", "a GIF
// file", "an empty file". Returns "a file of an unknown format" if the format is not recognized. If
// the file is a picture of an unsupported format, appends `advice`, which states how to convert it.
std::string DescribeFile(const Bytes& bytes, const std::string& advice = "");

// Returns true if a PNG file ends within a chunk, or lacks its last chunk.
bool IsTruncatedPng(const Bytes& png);

// Returns true if the first bytes may belong to a picture: PNG, JPEG, WebP, HEIF, TIFF,
// OpenEXR, PPM or PGM.
bool MayBePicture(const Bytes& beginning);

// Returns true if the bytes start with the signature of PNG files.
bool IsPng(const Bytes& bytes);

// Returns true if the bytes start with the signature of OpenEXR files.
bool IsExr(const Bytes& bytes);

// A segment of a JPEG file: its marker, and the range of its content after the length field.
struct JpegSegment {
  uint8_t marker;
  size_t begin, end;
};
constexpr uint8_t kJpegEndOfImage = 0xd9;  // JPEG marker that no length field follows.

// Returns the first segment at or after byte `at`, or nullopt if the file ends within that segment.
// Skips coded data between segments. In coded data, 0xff is followed by a zero byte or is part of a
// restart marker.
std::optional<JpegSegment> NextJpegSegment(const uint8_t* jpeg, size_t size, size_t at);

// Computes the 32-bit CRC of PNG chunks and of files in ZIP archives.
uint32_t Crc32(const uint8_t* bytes, size_t size);

// Returns a big-endian 32-bit integer.
uint32_t ReadBigEndian32(const uint8_t* bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CONTAINER_H_
