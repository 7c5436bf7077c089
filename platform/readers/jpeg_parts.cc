// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/jpeg_parts.h"

#include <algorithm>
#include <cstring>

#include "platform/container.h"

namespace starfocus {
namespace {

constexpr size_t kMostSegments = 4096;  // 256 MiB of them
constexpr size_t kGuidSize = 32;

enum Marker : uint8_t {
  kStuffed = 0x00,
  kTemporary = 0x01,
  kFirstRestart = 0xd0,
  kLastRestart = 0xd7,
  kEndOfImage = 0xd9,
  kApp1 = 0xe1,
  kApp2 = 0xe2
};

// The rest of a segment that begins with `name` and its zero byte.
template <size_t kSize>
bool Strip(const char (&name)[kSize], Span* segment) {
  if (segment->size < kSize || std::memcmp(segment->data, name, kSize) != 0) return false;
  segment->data += kSize;
  segment->size -= kSize;
  return true;
}

void TakeExif(Span segment, Bytes* exif) {
  if (!exif->empty() || segment.empty()) return;
  exif->assign(segment.data + 1, segment.data + segment.size);  // a second zero byte stands first
}

void TakeExtension(Span segment, std::vector<XmpExtension>* extensions) {
  constexpr size_t kHeader = kGuidSize + 8;
  if (segment.size < kHeader) return;
  XmpExtension extension;
  extension.guid.assign(reinterpret_cast<const char*>(segment.data), kGuidSize);
  extension.total = ReadBigEndian32(segment.data + kGuidSize);
  extension.offset = ReadBigEndian32(segment.data + kGuidSize + 4);
  extension.text = {segment.data + kHeader, segment.size - kHeader};
  extensions->push_back(extension);
}

void TakeApp1(Span segment, JpegParts* parts) {
  if (Strip("Exif", &segment)) return TakeExif(segment, &parts->metadata.exif);
  if (Strip("http://ns.adobe.com/xmp/extension/", &segment)) {
    return TakeExtension(segment, &parts->extensions);
  }
  if (parts->xmp.empty() && Strip("http://ns.adobe.com/xap/1.0/", &segment)) parts->xmp = segment;
}

// ICC.1 annex B.4: a number from 1 on and how many there are, then a part of the profile.
void TakeApp2(Span segment, size_t* profiles, JpegParts* parts) {
  if (parts->multi_picture.empty() && Strip("MPF", &segment)) parts->multi_picture = segment;
  if (!Strip("ICC_PROFILE", &segment) || segment.size < 2) return;
  if (segment.data[0] != *profiles + 1) return;
  ++*profiles;
  parts->metadata.icc.insert(parts->metadata.icc.end(), segment.data + 2,
                             segment.data + segment.size);
}

bool HasNoLength(uint8_t marker) {
  return marker == kStuffed || marker == kTemporary ||
         (marker >= kFirstRestart && marker <= kLastRestart);
}

}  // namespace

bool IsJpeg(Span file) {
  return file.size >= 3 && file.data[0] == 0xff && file.data[1] == 0xd8 && file.data[2] == 0xff;
}

std::string ReadJpegParts(const std::string& where, Span file, JpegParts* parts) {
  JpegParts result;
  size_t segments = 0, profiles = 0;
  for (size_t at = 2; at + 1 < file.size;) {
    const uint8_t marker = file.data[at + 1];
    if (file.data[at] != 0xff || marker == 0xff) {
      ++at;
      continue;
    }
    at += 2;
    if (HasNoLength(marker)) continue;
    if (marker == kEndOfImage) {
      result.end = at;
      *parts = std::move(result);
      return "";
    }
    if (at + 2 > file.size) break;
    const size_t length = size_t(file.data[at]) * 256 + file.data[at + 1];
    if (length < 2 || length > file.size - at) break;
    if (++segments > kMostSegments) {
      return Expected(where, "at most " + std::to_string(kMostSegments) + " segments", "more");
    }
    const Span segment = {file.data + at + 2, length - 2};
    if (marker == kApp1) TakeApp1(segment, &result);
    if (marker == kApp2) TakeApp2(segment, &profiles, &result);
    at += length;
  }
  return Expected(where, "an undamaged picture", "a truncated one");
}

std::string JoinExtensions(const std::string& where, const JpegParts& parts,
                           const std::string& guid, std::string* text) {
  std::vector<const XmpExtension*> chosen;
  for (const XmpExtension& extension : parts.extensions) {
    if (extension.guid == guid) chosen.push_back(&extension);
  }
  std::stable_sort(chosen.begin(), chosen.end(), [](const XmpExtension* a, const XmpExtension* b) {
    return a->offset < b->offset;
  });
  std::string joined;
  for (const XmpExtension* extension : chosen) {
    if (extension->offset != joined.size()) break;
    joined.append(reinterpret_cast<const char*>(extension->text.data), extension->text.size);
  }
  const size_t total = chosen.empty() ? 0 : chosen[0]->total;
  if (chosen.empty() || joined.size() != total) {
    return Expected(where, "the extended XMP that it names, " + std::to_string(total) + " bytes",
                    std::to_string(joined.size()) + " of them in a row");
  }
  *text = std::move(joined);
  return "";
}

}  // namespace starfocus
