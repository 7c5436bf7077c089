// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/exr_header.h"

#include <algorithm>
#include <utility>

namespace starfocus {
namespace {

constexpr int kMostParts = 1000, kMostAttributes = 10000;
constexpr size_t kMostName = 255;  // bytes of names that OpenEXR reads

// Types of attributes whose values have one size.
constexpr std::pair<const char*, size_t> kSizes[] = {
    {"box2f", 16},         {"box2i", 16},    {"chromaticities", 32},
    {"compression", 1},    {"double", 8},    {"envmap", 1},
    {"deepImageState", 1}, {"float", 4},     {"int", 4},
    {"keycode", 28},       {"lineOrder", 1}, {"m33d", 72},
    {"m33f", 36},          {"m44d", 128},    {"m44f", 64},
    {"rational", 8},       {"tiledesc", 9},  {"timecode", 8},
    {"v2d", 16},           {"v2f", 8},       {"v2i", 8},
    {"v3d", 24},           {"v3f", 12},      {"v3i", 12},
};

// Reads texts and numbers of a file. After an attempt to read beyond the end, `is_sound` is false.
struct ExrReader {
  const uint8_t *at, *end;
  bool is_sound = true;

  std::string Text() {
    const uint8_t* zero = std::find(at, end, 0);
    is_sound = is_sound && zero != end;
    std::string text(at, zero);
    is_sound = is_sound && text.size() <= kMostName;
    if (is_sound) at = zero + 1;
    return text;
  }
  uint32_t Number() {
    uint32_t value = 0;
    is_sound = is_sound && end - at >= 4;
    for (int k = 3; k >= 0 && is_sound; --k) value = value << 8 | at[k];
    if (is_sound) at += 4;
    return value;
  }
  void Skip(uint64_t bytes) {
    is_sound = is_sound && bytes <= static_cast<uint64_t>(end - at);
    if (is_sound) at += bytes;
  }
  bool IsAtEnd() const { return is_sound && at == end; }
};

// Returns true if a value consists of channels: names with 16 bytes each, and an empty name.
bool AreChannels(ExrReader value) {
  constexpr uint64_t kProperties = 16;
  while (value.is_sound && !value.Text().empty()) value.Skip(kProperties);
  return value.IsAtEnd();
}

bool AreTexts(ExrReader value) {
  while (value.is_sound && value.at != value.end) value.Skip(value.Number());
  return value.IsAtEnd();
}

bool IsPreview(ExrReader value) {
  const uint64_t width = value.Number(), height = value.Number();
  constexpr uint64_t kMostSide = 65535;
  if (width > kMostSide || height > kMostSide) return false;
  value.Skip(4 * width * height);
  return value.IsAtEnd();
}

// Returns true if OpenEXR reads the whole value and no byte more. OpenEXR reads values of unknown
// types by their sizes.
bool HasSizeOfType(const std::string& type, const ExrReader& value) {
  const auto size = static_cast<size_t>(value.end - value.at);
  for (const auto& [name, bytes] : kSizes) {
    if (type == name) return size == bytes;
  }
  if (type == "chlist") return AreChannels(value);
  if (type == "stringvector") return AreTexts(value);
  if (type == "preview") return IsPreview(value);
  if (type == "floatvector") return size % 4 == 0;
  return type != "idmanifest" || size >= 4;
}

}  // namespace

bool VisitExrAttributes(
    const uint8_t* file, size_t size,
    const std::function<void(const std::string& name, const uint8_t* value, size_t size)>& visit) {
  constexpr uint32_t kMultipleParts = 0x1000;
  ExrReader reader = {file, file + size};
  reader.Number();  // signature
  const bool has_parts = (reader.Number() & kMultipleParts) != 0;
  int parts = 0, attributes = 0;
  for (bool in_part = false; reader.is_sound;) {
    const std::string name = reader.Text();
    if (name.empty()) {
      // An empty name ends a part, and a second one ends the headers of several parts.
      if (!in_part || !has_parts) return reader.is_sound;
      in_part = false;
      continue;
    }
    if (!in_part && ++parts > kMostParts) return false;
    if (++attributes > kMostAttributes) return false;
    in_part = true;
    const std::string type = reader.Text();
    const uint32_t length = reader.Number();
    if (!reader.is_sound || length > static_cast<size_t>(reader.end - reader.at)) return false;
    if (!HasSizeOfType(type, {reader.at, reader.at + length})) return false;
    visit(name, reader.at, length);
    reader.at += length;
  }
  return false;
}

}  // namespace starfocus
