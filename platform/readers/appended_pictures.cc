// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/appended_pictures.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "platform/container.h"

namespace starfocus {
namespace {

// Limit on the number of start codes that are tried, because a start code without a picture causes
// a scan of the rest of the file.
constexpr size_t kMostPictures = 64;

constexpr uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

bool IsPngStart(Span file) {
  return file.size >= sizeof(kPng) && std::memcmp(file.data, kPng, sizeof(kPng)) == 0;
}

Span From(Span file, size_t at) { return {file.data + at, file.size - at}; }

// Returns the size of the video at the start of `file`, which consists of boxes (ISO/IEC 14496-12,
// 4.2), or 0 if `file` does not start with the file type box of a video.
size_t VideoSize(Span file) {
  constexpr size_t kToTheEnd = 0, kLong = 1;  // special values of the size field of a box
  constexpr size_t kLargestFirst = 1024;      // the file type box contains a list of brands
  if (file.size < 16 || std::memcmp(file.data + 4, "ftyp", 4) != 0) return 0;
  if (ReadBigEndian32(file.data) > kLargestFirst) return 0;
  size_t at = 0;
  while (file.size - at >= 16) {
    const uint8_t* box = file.data + at;
    const auto is_name = [](uint8_t c) { return c >= ' ' && c < 0x7f; };
    uint64_t size = ReadBigEndian32(box);
    if (size == kLong) size = uint64_t{ReadBigEndian32(box + 8)} << 32 | ReadBigEndian32(box + 12);
    if (!std::all_of(box + 4, box + 8, is_name)) break;
    if (size == kToTheEnd) return file.size;
    if (size < 8 || size > file.size - at) break;
    at += static_cast<size_t>(size);
  }
  return at;
}

// Returns the size of the PNG file at the start of `file`, or 0 if the file is incomplete.
size_t PngFileSize(Span file) {
  constexpr size_t kAround = 12;  // length, name and checksum of a chunk
  for (size_t at = sizeof(kPng); file.size - at >= kAround;) {
    const size_t length = ReadBigEndian32(file.data + at);
    if (length > file.size - at - kAround) return 0;
    const bool is_last = std::memcmp(file.data + at + 4, "IEND", 4) == 0;
    at += kAround + length;
    if (is_last) return at;
  }
  return 0;
}

// Returns the first position from `at` on where a JPEG or PNG file may start, or the size of `file`
// if no start is found. Skips videos.
size_t FindBeginning(Span file, size_t at) {
  while (at + 2 < file.size) {
    const Span rest = From(file, at);
    if (IsJpeg(rest) || IsPngStart(rest)) return at;
    at += std::max(VideoSize(rest), size_t{1});
  }
  return file.size;
}

// Returns true if the segments of a JPEG file describe a gain map: by XMP of Adobe or Apple, or by
// the segment of ISO 21496-1. A photo that has a gain map also names Adobe's version, but lists the
// gain map in its directory.
bool IsGainMap(const JpegParts& parts) {
  return !parts.iso_gain_map.empty() ||
         std::any_of(parts.xmp.begin(), parts.xmp.end(), [](const Span& xmp) {
           return Contains(xmp, "hdrgainmap") ||
                  (Contains(xmp, "hdr-gain-map") && !Contains(xmp, "Directory"));
         });
}

}  // namespace

std::vector<AppendedPicture> ListAppendedPictures(Span file, size_t begin) {
  std::vector<AppendedPicture> pictures;
  size_t at = begin;
  for (size_t attempt = 0; attempt < kMostPictures; ++attempt) {
    at = FindBeginning(file, at);
    if (at >= file.size) break;
    AppendedPicture picture;
    const Span rest = From(file, at);
    picture.is_png = !IsJpeg(rest);
    size_t size = 0;
    if (picture.is_png) {
      size = PngFileSize(rest);
    } else if (!ReadJpegParts("", rest).MoveTo(&picture.parts)) {
      size = picture.parts.end;
      picture.is_gain_map = IsGainMap(picture.parts);
    }
    picture.file = {rest.data, size};
    at += std::max(size, size_t{1});
    if (size > 0) pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace starfocus
