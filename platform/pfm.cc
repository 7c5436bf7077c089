// SPDX-License-Identifier: Apache-2.0
#include "platform/pfm.h"

#include <cstring>
#include <new>

#include "platform/image.h"
#include "platform/text.h"
#include "platform/text_header.h"

namespace starfocus {
namespace {

void AppendFloat(float value, ByteOrder order, Bytes* bytes) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  for (int i = 0; i < 4; ++i) {
    const int shift = order == ByteOrder::kLittle ? 8 * i : 24 - 8 * i;
    bytes->push_back(static_cast<uint8_t>(bits >> shift));
  }
}

struct Header {
  int width, height;
  ByteOrder order;
};

Result<Header> ParseHeader(const std::string& path, TextHeader* header) {
  const std::string magic = header->Token();
  if (magic != "Pf") return Expected(path, "a one-channel PFM (Pf)", "'" + magic + "'");
  const std::string width = header->Token(), height = header->Token(), scale = header->Token();
  const Header size = {ParseSize(width), ParseSize(height), ByteOrder::kBig};
  if (size.width == 0 || size.height == 0) {
    return Expected(path, "width and height from 1 to 65535",
                    "'" + width + "' and '" + height + "'");
  }
  const double factor = ParseNumber(scale).value_or(0);
  if (factor == 0) {
    return Expected(path, "a nonzero number as the scale", "'" + scale + "'");
  }
  return Header{size.width, size.height, factor < 0 ? ByteOrder::kLittle : ByteOrder::kBig};
}

Bytes Encode(const FloatMap& map, ByteOrder order) {
  const std::string header = "Pf\n" + std::to_string(map.width) + " " + std::to_string(map.height) +
                             "\n" + (order == ByteOrder::kLittle ? "-1.0" : "1.0") + "\n";
  Bytes bytes(header.begin(), header.end());
  bytes.reserve(bytes.size() + 4 * map.values.size());
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) AppendFloat(map.at(x, y), order, &bytes);
  }
  return bytes;
}

}  // namespace

Result<FloatMap> DecodePfm(const std::string& where, const Bytes& pfm) {
  TextHeader header(pfm);
  const Result<Header> parsed = ParseHeader(where, &header);
  if (!parsed) return parsed.error();
  if (!FitsMemory(parsed->width, parsed->height, sizeof(float))) {
    return OutOfMemory(where, "read it");
  }
  FloatMap result = {parsed->width, parsed->height, {}};
  const size_t width = size_t(result.width), height = size_t(result.height);
  if (header.remaining() != 4 * width * height) {
    return Expected(where, std::to_string(4 * width * height) + " bytes of data",
                    std::to_string(header.remaining()));
  }
  result.values.resize(width * height);
  const NumberType type = {NumberKind::kFloat, 4, parsed->order};
  const uint8_t* data = header.data();
  for (size_t y = height; y-- > 0; data += result.stride()) {
    ReadNumbers(type, data, width, result.values.data() + y * width);
  }
  return result;
}

Result<FloatMap> ReadPfm(const std::string& path) {
  try {
    const Result<Bytes> bytes = ReadFile(path);
    return bytes ? DecodePfm(path, *bytes) : bytes.error();
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "read it");
  }
}

Error WritePfm(const std::string& path, const FloatMap& map, ByteOrder order) {
  try {
    return WriteFile(path, Encode(map, order));
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "write it");
  }
}

}  // namespace starfocus
