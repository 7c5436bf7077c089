// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/npy.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <regex>
#include <vector>

#include "platform/decoders/limits.h"

namespace starfocus {
namespace {

constexpr char kSignature[] = "\x93NUMPY";
constexpr size_t kSignatureSize = 6;
// NumPy pads headers to a multiple of 64 bytes. The header of an array of numbers has at most 128
// bytes.
constexpr size_t kMostHeaderBytes = 1024;

Error Reject(const std::string& where, const std::string& expected, const std::string& found) {
  return Expected(
      where, expected,
      found + " (numpy.save(FILE, depth.astype('float32')) writes a file that can be read)");
}

// Loads a little-endian integer.
uint64_t LoadLittle(const uint8_t* data, size_t size) {
  uint64_t value = 0;
  for (size_t k = 0; k < size; ++k) value |= uint64_t{data[k]} << 8 * k;
  return value;
}

float LoadFloat32(const uint8_t* data) {
  const auto bits = static_cast<uint32_t>(LoadLittle(data, 4));
  float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

float LoadFloat64(const uint8_t* data) {
  const uint64_t bits = LoadLittle(data, 8);
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  constexpr float kMost = std::numeric_limits<float>::max(), kInfinity = HUGE_VALF;
  if (std::fabs(value) > double{kMost}) return value > 0 ? kInfinity : -kInfinity;
  return static_cast<float>(value);
}

// A type of values in NPY files.
struct ValueType {
  const char* name;
  size_t bytes;
  int largest;  // largest integer; 0 for floats
  float (*load)(const uint8_t* data);
};
constexpr ValueType kTypes[] = {
    {"<f4", 4, 0, LoadFloat32},
    {"<f8", 8, 0, LoadFloat64},
    {"|u1", 1, 255, [](const uint8_t* data) { return float(data[0]); }},
    {"<u2", 2, 65535, [](const uint8_t* data) { return float(LoadLittle(data, 2)); }},
    {"<i2", 2, 32767, [](const uint8_t* data) { return float(int16_t(LoadLittle(data, 2))); }},
};

struct Header {
  std::string type, shape;
  bool is_fortran_order;
  size_t end;  // position of the values in the file
};

// Parses a header as NumPy writes it. Returns nullopt for any other header.
std::optional<Header> ParseHeader(const Bytes& npy) {
  if (npy.size() < kSignatureSize + 6) return {};
  const int version = npy[kSignatureSize];
  if (version < 1 || version > 3) return {};
  const size_t length_bytes = version == 1 ? 2 : 4, begin = kSignatureSize + 2 + length_bytes;
  const auto length = static_cast<size_t>(LoadLittle(&npy[kSignatureSize + 2], length_bytes));
  if (length > kMostHeaderBytes || length > npy.size() - begin) return {};
  const std::string text(npy.begin() + ptrdiff_t(begin), npy.begin() + ptrdiff_t(begin + length));
  static const std::regex form(
      R"(\{'descr': '([^']*)', 'fortran_order': (True|False), 'shape': \(([0-9, ]*)\),? *\} *\n?)");
  std::smatch match;
  if (!std::regex_match(text, match, form)) return {};
  return Header{match[1], match[3], match[2] == "True", begin + length};
}

// Returns the dimensions of an array without dimensions of 1 before and after rows and columns.
std::vector<int64_t> DimensionsOf(const std::string& shape) {
  constexpr size_t kMostDigits = 9;
  static const std::regex number("[0-9]+");
  std::vector<int64_t> sizes;
  for (std::sregex_iterator at(shape.begin(), shape.end(), number), end; at != end; ++at) {
    const std::string digits = at->str();
    sizes.push_back(digits.size() > kMostDigits ? INT32_MAX : std::stoll(digits));
  }
  while (sizes.size() > 2 && sizes.front() == 1) sizes.erase(sizes.begin());
  while (sizes.size() > 2 && sizes.back() == 1) sizes.pop_back();
  return sizes;
}

}  // namespace

bool IsNpy(const Bytes& bytes) {
  return bytes.size() >= kSignatureSize &&
         std::memcmp(bytes.data(), kSignature, kSignatureSize) == 0;
}

Result<Samples> DecodeNpy(const std::string& where, const Bytes& npy) {
  const std::optional<Header> header = ParseHeader(npy);
  if (!header) return Reject(where, "an NPY file of one array of numbers", "another header");
  const auto* type =
      std::find_if(std::begin(kTypes), std::end(kTypes),
                   [&header](const ValueType& one) { return header->type == one.name; });
  if (type == std::end(kTypes)) {
    return Reject(where, "an array of type <f4, <f8, |u1, <u2 or <i2", header->type);
  }
  if (header->is_fortran_order) return Reject(where, "an array in C order", "Fortran order");
  const std::vector<int64_t> sizes = DimensionsOf(header->shape);
  if (sizes.size() != 2) {
    return Reject(where, "an array of rows and columns", "the shape (" + header->shape + ")");
  }
  if (Error error = CheckPictureSize(where, sizes[1], sizes[0])) return error;
  const auto count = static_cast<size_t>(sizes[0] * sizes[1]);
  const size_t bytes = npy.size() - header->end;
  if (bytes != count * type->bytes) {
    return Expected(where, std::to_string(count * type->bytes) + " bytes of values",
                    std::to_string(bytes));
  }
  Samples samples = {{static_cast<int>(sizes[1]), static_cast<int>(sizes[0]), {}}, type->largest};
  samples.map.values.resize(count);
  const uint8_t* data = npy.data() + header->end;
  for (float& value : samples.map.values) {
    value = type->load(data);
    data += type->bytes;
  }
  return samples;
}

}  // namespace starfocus
