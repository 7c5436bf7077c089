// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/jpeg_parts.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

#include "platform/container.h"
#include "platform/icc_profile.h"

namespace starfocus {
namespace {

constexpr size_t kMostSegments = 4096;  // limit on the number of segments, 256 MiB in total
constexpr size_t kGuidSize = 32;

constexpr uint8_t kApp1 = 0xe1, kApp2 = 0xe2, kApp13 = 0xed;

// Removes `name` and its terminating zero byte from the start of a segment. Returns false if the
// segment does not start with `name`.
template <size_t kSize>
bool Strip(const char (&name)[kSize], Span* segment) {
  if (segment->size < kSize || std::memcmp(segment->data, name, kSize) != 0) return false;
  segment->data += kSize;
  segment->size -= kSize;
  return true;
}

void TakeExif(Span segment, Bytes* exif) {
  if (!exif->empty() || segment.empty()) return;
  // Skip the second zero byte after "Exif".
  exif->assign(segment.data + 1, segment.data + segment.size);
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
  if (Strip("http://ns.adobe.com/xap/1.0/", &segment)) parts->xmp.push_back(segment);
}

void TakeApp2(Span segment, std::vector<Span>* profile, JpegParts* parts) {
  if (parts->multi_picture.empty() && Strip("MPF", &segment)) parts->multi_picture = segment;
  if (Strip("ICC_PROFILE", &segment) && segment.size >= 2) profile->push_back(segment);
  // In a photo that has a gain map, the segment contains only two version numbers of 16 bits.
  if (Strip("urn:iso:std:iso:ts:21496:-1", &segment) && segment.size > 4) {
    parts->iso_gain_map = segment;
  }
}

// Joins the parts of an ICC profile (ICC.1 annex B.4). Each part of the profile starts with its own
// number, counted from 1, and the total number of parts.
void JoinProfile(std::vector<Span> profile, JpegParts* result) {
  if (profile.empty()) return;
  std::stable_sort(profile.begin(), profile.end(),
                   [](const Span& a, const Span& b) { return a.data[0] < b.data[0]; });
  const size_t count = profile[0].data[1];
  bool whole = profile.size() == count;
  Bytes icc;
  for (size_t k = 0; k < profile.size(); ++k) {
    whole = whole && profile[k].data[0] == k + 1 && profile[k].data[1] == count;
    icc.insert(icc.end(), profile[k].data + 2, profile[k].data + profile[k].size);
  }
  if (whole && IsRgbProfile(icc)) {
    result->metadata.icc = std::move(icc);
    return;
  }
  result->ignored = std::string("the colour profile is ignored: ") +
                    (whole ? "it is damaged or not of RGB colours"
                           : "some of its " + std::to_string(count) + " parts are missing");
}

// Finds IPTC records among the image resources of Photoshop, which may extend over several
// segments. An image resource consists of "8BIM", a number, a name and data. The name and the data
// of an image resource each start with a length and are padded to an even size.
Bytes FindIptc(const std::vector<Span>& segments) {
  constexpr size_t kHeader = 6;
  constexpr uint8_t kIptc[] = {'8', 'B', 'I', 'M', 0x04, 0x04};
  Bytes all;
  for (const Span& segment : segments) {
    all.insert(all.end(), segment.data, segment.data + segment.size);
  }
  for (size_t at = 0; at + kHeader < all.size();) {
    const size_t name = (size_t(all[at + kHeader]) + 2) / 2 * 2, sizes = at + kHeader + name;
    if (!std::equal(kIptc, kIptc + 4, &all[at]) || sizes + 4 > all.size()) return {};
    const size_t size = ReadBigEndian32(&all[sizes]), data = sizes + 4;
    if (size > all.size() - data) return {};
    if (std::equal(kIptc, kIptc + kHeader, &all[at])) {
      return {all.begin() + static_cast<ptrdiff_t>(data),
              all.begin() + static_cast<ptrdiff_t>(data + size)};
    }
    at = data + (size + 1) / 2 * 2;
  }
  return {};
}

// Compares hexadecimal GUIDs of extended XMP. The XMP specification requires upper case, but files
// may use lower case.
bool SameHex(const std::string& a, const std::string& b) {
  const auto same = [](char x, char y) { return std::toupper(x) == std::toupper(y); };
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same);
}

}  // namespace

bool Contains(Span text, const std::string& part) {
  const uint8_t* end = text.data + text.size;
  return std::search(text.data, end, part.begin(), part.end()) != end;
}

bool IsJpeg(Span file) {
  return file.size >= 3 && file.data[0] == 0xff && file.data[1] == 0xd8 && file.data[2] == 0xff;
}

Result<JpegParts> ReadJpegParts(const std::string& where, Span file) {
  JpegParts result;
  std::vector<Span> profile, resources;
  size_t segments = 0;
  size_t at = 2;
  while (const auto next = NextJpegSegment(file.data, file.size, at)) {
    at = next->end;
    if (next->marker == kJpegEndOfImage) {
      result.end = at;
      JoinProfile(std::move(profile), &result);
      result.metadata.iptc = FindIptc(resources);
      return result;
    }
    if (next->end < next->begin) {
      return Expected(where, "an undamaged JPEG file",
                      "a segment of " + std::to_string(next->end + 2 - next->begin) + " bytes");
    }
    if (++segments > kMostSegments) {
      return Expected(where, "at most " + std::to_string(kMostSegments) + " segments", "more");
    }
    Span segment = {file.data + next->begin, next->end - next->begin};
    if (next->marker == kApp1) TakeApp1(segment, &result);
    if (next->marker == kApp2) TakeApp2(segment, &profile, &result);
    if (next->marker == kApp13 && Strip("Photoshop 3.0", &segment)) resources.push_back(segment);
  }
  return Truncated(where, "JPEG");
}

Result<std::string> JoinExtensions(const std::string& where, const JpegParts& parts,
                                   const std::string& guid) {
  std::vector<const XmpExtension*> chosen;
  for (const XmpExtension& extension : parts.extensions) {
    if (SameHex(extension.guid, guid)) chosen.push_back(&extension);
  }
  std::stable_sort(chosen.begin(), chosen.end(), [](const XmpExtension* a, const XmpExtension* b) {
    return a->offset < b->offset;
  });
  std::string joined;
  for (const XmpExtension* extension : chosen) {
    if (extension->offset < joined.size()) continue;  // a repeated part
    if (extension->offset > joined.size()) break;
    joined.append(reinterpret_cast<const char*>(extension->text.data), extension->text.size);
  }
  const size_t total = chosen.empty() ? 0 : chosen[0]->total;
  if (chosen.empty()) {
    return Expected(where,
                    "the extended XMP " + guid.substr(0, kGuidSize) + " that the XMP refers to",
                    parts.extensions.empty() ? "none" : "another");
  }
  if (joined.size() != total) {
    return Expected(where, std::to_string(total) + " bytes of extended XMP",
                    std::to_string(joined.size()) + " contiguous bytes");
  }
  return joined;
}

}  // namespace starfocus
