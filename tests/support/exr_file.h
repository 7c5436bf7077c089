// SPDX-License-Identifier: Apache-2.0
// Writes OpenEXR files byte by byte ("OpenEXR File Layout"), without compression.
#ifndef STARFOCUS_TESTS_SUPPORT_EXR_FILE_H_
#define STARFOCUS_TESTS_SUPPORT_EXR_FILE_H_

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "platform/deep_image.h"

namespace starfocus::exr_file {

inline std::string Little(uint64_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> 8 * k);
  return text;
}

inline std::string LittleFloat(float value) {
  uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return Little(bits, 4);
}

// A channel of an OpenEXR file. `values` are its samples in rows.
struct Channel {
  std::string name;
  bool is_half;
  std::vector<float> values;
};

struct Box {
  int left, top, right, bottom;
};

inline std::string Attribute(const std::string& name, const std::string& type,
                             const std::string& value) {
  return name + '\0' + type + '\0' + Little(value.size(), 4) + value;
}

inline std::string BoxText(const Box& box) {
  std::string text;
  for (const int side : {box.left, box.top, box.right, box.bottom}) {
    text += Little(static_cast<uint32_t>(side), 4);
  }
  return text;
}

struct ExrPart {
  std::vector<Channel> channels;  // sorted by name
  Box data, display;
  std::string more = {};
};

inline std::string HeaderOf(const ExrPart& part) {
  std::string list;
  for (const Channel& channel : part.channels) {
    list += channel.name + '\0' + Little(channel.is_half ? 1 : 2, 4) + std::string(4, '\0') +
            Little(1, 4) + Little(1, 4);
  }
  const std::string zero = std::string(1, '\0'), one = LittleFloat(1);
  return Attribute("channels", "chlist", list + zero) +
         Attribute("compression", "compression", zero) +
         Attribute("dataWindow", "box2i", BoxText(part.data)) +
         Attribute("displayWindow", "box2i", BoxText(part.display)) +
         Attribute("lineOrder", "lineOrder", zero) + Attribute("pixelAspectRatio", "float", one) +
         Attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         Attribute("screenWindowWidth", "float", one) + part.more + zero;
}

// Returns an OpenEXR file without compression ("OpenEXR File Layout").
inline std::string Exr(const std::vector<ExrPart>& parts) {
  const bool multi = parts.size() > 1;
  std::string file = "v/1\1" + Little(multi ? 0x1002 : 2, 4);
  size_t rows = 0;
  for (const ExrPart& part : parts) {
    file += HeaderOf(part);
    rows += size_t(part.data.bottom - part.data.top + 1);
  }
  if (multi) file += '\0';
  const size_t first = file.size() + 8 * rows;
  std::string table, chunks;
  for (size_t number = 0; number < parts.size(); ++number) {
    const ExrPart& part = parts[number];
    const auto width = size_t(part.data.right - part.data.left + 1);
    for (int y = part.data.top; y <= part.data.bottom; ++y) {
      std::string samples;
      for (const Channel& channel : part.channels) {
        for (size_t x = 0; x < width; ++x) {
          const float value = channel.values.at(size_t(y - part.data.top) * width + x);
          samples += channel.is_half ? Little(HalfOfFloat(value), 2) : LittleFloat(value);
        }
      }
      table += Little(first + chunks.size(), 8);
      if (multi) chunks += Little(number, 4);
      chunks += Little(uint32_t(y), 4) + Little(samples.size(), 4) + samples;
    }
  }
  return file + table + chunks;
}

// Attributes that a part of a file of several parts has.
inline std::string Named(const std::string& name, int rows) {
  return Attribute("chunkCount", "int", Little(uint32_t(rows), 4)) +
         Attribute("name", "string", name) + Attribute("type", "string", "scanlineimage");
}

inline const Box kTwo = {0, 0, 1, 0};  // two pixels in a row

inline ExrPart Colours(float red, const std::string& more = {}) {
  return {
      {{"B", true, {3, 0.5F}}, {"G", true, {-1, 0.25F}}, {"R", false, {red, 0}}}, kTwo, kTwo, more};
}

}  // namespace starfocus::exr_file

#endif  // STARFOCUS_TESTS_SUPPORT_EXR_FILE_H_
