// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/ultra_hdr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>

#include "platform/container.h"
#include "platform/writers/jpeg.h"
#include "platform/writers/jpeg_segments.h"

namespace starfocus {
namespace {

using Colours = std::array<double, 3>;

const std::string kGainMapSpace = " xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"";
const std::string kVersion = " hdrgm:Version=\"1.0\"";
const std::string kIsoName = "urn:iso:std:iso:ts:21496:-1", kIndexName = "MPF";
constexpr size_t kNoVersion = 4;  // bytes of two version numbers, which are 0

bool IsEqual(const Colours& colours) {
  return colours[0] == colours[1] && colours[0] == colours[2];
}

std::string BigEndian(uint32_t value, int bytes) {
  std::string text;
  for (int k = bytes - 1; k >= 0; --k) text += static_cast<char>(value >> 8 * k & 255);
  return text;
}

std::string Number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

// Writes the properties hdrgm of a gain map. Numbers that apply to all colours are attributes,
// since some readers search only attributes; others are lists.
std::string MapXmp(const GainMap& map) {
  std::string attributes = kVersion, lists;
  const auto write = [&](const std::string& name, const Colours& colours) {
    if (IsEqual(colours)) {
      attributes += " hdrgm:" + name + "=\"" + Number(colours[0]) + "\"";
      return;
    }
    lists += "<hdrgm:" + name + "><rdf:Seq>";
    for (const double value : colours) lists += "<rdf:li>" + Number(value) + "</rdf:li>";
    lists += "</rdf:Seq></hdrgm:" + name + ">";
  };
  write("GainMapMin", map.min);
  write("GainMapMax", map.max);
  write("Gamma", map.gamma);
  write("OffsetSDR", map.offset_sdr);
  write("OffsetHDR", map.offset_hdr);
  for (const auto& [name, value] : {std::pair("HDRCapacityMin", map.capacity_min),
                                    std::pair("HDRCapacityMax", map.capacity_max)}) {
    attributes += std::string(" hdrgm:") + name + "=\"" + Number(value) + "\"";
  }
  attributes += " hdrgm:BaseRenditionIsHDR=\"False\"";
  return "<rdf:Description rdf:about=\"\"" + kGainMapSpace + attributes + ">" + lists +
         "</rdf:Description>";
}

// Writes the directory of the base picture, which states the size of the map's file in bytes.
std::string BaseXmp(size_t map_bytes) {
  const auto item = [](const std::string& semantic, const std::string& length) {
    return "<rdf:li rdf:parseType=\"Resource\"><Container:Item Item:Semantic=\"" + semantic +
           "\" Item:Mime=\"image/jpeg\"" + length + "/></rdf:li>";
  };
  return "<rdf:Description rdf:about=\"\"" + kGainMapSpace +
         " xmlns:Container=\"http://ns.google.com/photos/1.0/container/\""
         " xmlns:Item=\"http://ns.google.com/photos/1.0/container/item/\"" +
         kVersion + "><Container:Directory><rdf:Seq>" + item("Primary", "") +
         item("GainMap", " Item:Length=\"" + std::to_string(map_bytes) + "\"") +
         "</rdf:Seq></Container:Directory></rdf:Description>";
}

// Writes the metadata of ISO 21496-1, whose numbers are fractions. Their denominator represents the
// numbers of ComputeGainMap exactly, and all numbers that pass CheckGainMap to 2^-21.
std::string MapIso(const GainMap& map) {
  constexpr uint32_t kDivisor = 1u << 20;
  constexpr uint32_t kThreeChannels = 0x80, kBasePrimaries = 0x40;
  const auto fraction = [](double value) {
    const auto whole = static_cast<int32_t>(std::lround(value * kDivisor));
    return BigEndian(static_cast<uint32_t>(whole), 4) + BigEndian(kDivisor, 4);
  };
  bool is_equal = true;
  for (const Colours* colours :
       {&map.min, &map.max, &map.gamma, &map.offset_sdr, &map.offset_hdr}) {
    is_equal = is_equal && IsEqual(*colours);
  }
  std::string text(kNoVersion, '\0');
  text += BigEndian(is_equal ? kBasePrimaries : kBasePrimaries | kThreeChannels, 1);
  for (const double capacity : {map.capacity_min, map.capacity_max}) {
    text += fraction(std::max(capacity, 0.0));
  }
  for (size_t c = 0; c < (is_equal ? 1 : 3); ++c) {
    for (const Colours* colours :
         {&map.min, &map.max, &map.gamma, &map.offset_sdr, &map.offset_hdr}) {
      text += fraction((*colours)[c]);
    }
  }
  return text;
}

// Writes the multi-picture index of two pictures. `base_bytes` and `map_bytes` are the sizes of
// their files, and `offset` is the position of the map, counted from the header "MM".
std::string Index(uint32_t base_bytes, uint32_t map_bytes, uint32_t offset) {
  constexpr uint32_t kUndefined = 7, kNumber = 4, kPictures = 2, kRecord = 16, kPrimary = 0x030000;
  const auto tag = [](uint32_t number, uint32_t type, uint32_t count, const std::string& value) {
    return BigEndian(number, 2) + BigEndian(type, 2) + BigEndian(count, 4) + value;
  };
  constexpr uint32_t kEntries = 8 + 2 + 3 * 12 + 4;  // behind the header and the directory
  const std::string none = BigEndian(0, 4);
  return "MM" + BigEndian(42, 2) + BigEndian(8, 4) + BigEndian(3, 2) +
         tag(0xb000, kUndefined, 4, "0100") + tag(0xb001, kNumber, 1, BigEndian(kPictures, 4)) +
         tag(0xb002, kUndefined, kPictures * kRecord, BigEndian(kEntries, 4)) + none +
         BigEndian(kPrimary, 4) + BigEndian(base_bytes, 4) + none + none +  // the base
         none + BigEndian(map_bytes, 4) + BigEndian(offset, 4) + none;      // the map
}

// Returns the position of the multi-picture index behind its name.
std::optional<size_t> FindIndex(const Bytes& jpeg) {
  const size_t name = kIndexName.size() + 1;
  for (size_t at = 2; const auto segment = NextJpegSegment(jpeg.data(), jpeg.size(), at);) {
    at = segment->end;
    if (segment->marker == kJpegEndOfImage) break;
    if (segment->end < segment->begin + name) continue;
    if (std::memcmp(&jpeg[segment->begin], kIndexName.c_str(), name) == 0) {
      return segment->begin + name;
    }
  }
  return std::nullopt;
}

Result<Bytes> EncodeMap(const std::string& path, const GainMap& map, int quality) {
  std::vector<uint8_t> levels;
  levels.reserve(map.levels.size());
  for (const uint16_t level : map.levels) {
    levels.push_back(static_cast<uint8_t>((level + 128) / 257));
  }
  Result<Bytes> jpeg = EncodeJpegPixels(path, {map.width, map.height, map.channels, levels.data()},
                                        quality, nullptr);
  if (!jpeg) return jpeg;
  Bytes segments;
  AppendXmp(MapXmp(map), &segments);
  AppendApp2(kIsoName, MapIso(map), &segments);
  InsertSegments(segments, &*jpeg);
  return jpeg;
}

}  // namespace

Result<Bytes> EncodeUltraHdr(const std::string& path, const Image& base, const GainMap& map,
                             int quality, const Metadata& metadata) {
  constexpr int kMapQuality = 95;
  const Result<Bytes> second = EncodeMap(path, map, std::max(quality, kMapQuality));
  if (!second) return second;
  const std::string directory = BaseXmp(second->size());
  Bytes segments;
  // Omit the rdf:Descriptions of `metadata` if they do not fit into the XMP packet.
  if (!AppendXmp(directory + metadata.xmp, &segments)) AppendXmp(directory, &segments);
  AppendApp2(kIsoName, std::string(kNoVersion, '\0'), &segments);
  AppendApp2(kIndexName, Index(0, 0, 0), &segments);
  Metadata others = metadata;
  others.xmp.clear();  // a JPEG file may have only one XMP packet
  Result<Bytes> jpeg = EncodeJpeg(path, base, quality, others, segments);
  if (!jpeg) return jpeg;
  const std::optional<size_t> at = FindIndex(*jpeg);
  if (!at) return Error::Internal(path, "a multi-picture index", "none");
  const std::string index =
      Index(static_cast<uint32_t>(jpeg->size()), static_cast<uint32_t>(second->size()),
            static_cast<uint32_t>(jpeg->size() - *at));
  std::copy(index.begin(), index.end(), jpeg->begin() + static_cast<ptrdiff_t>(*at));
  jpeg->insert(jpeg->end(), second->begin(), second->end());
  return jpeg;
}

}  // namespace starfocus
