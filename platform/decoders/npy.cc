// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/npy.h"

#include <cstring>
#include <regex>
#include <utility>

#include "platform/decoders/limits.h"

namespace starfocus {
namespace {

constexpr char kSignature[] = "\x93NUMPY";
constexpr size_t kSignatureSize = 6;
// NumPy pads headers to a multiple of 64 bytes. The header of an array of numbers has at most 128
// bytes.
constexpr size_t kMostHeaderBytes = 1024;

Error Reject(const std::string& where, bool is_matte, const std::string& expected,
             const std::string& found) {
  return Expected(where, expected,
                  found + " (numpy.save(FILE, " + (is_matte ? "matte" : "depth") +
                      ".astype('float32')) writes a file that can be read)");
}

// Loads a little-endian integer.
size_t LoadLittle(const uint8_t* data, size_t size) {
  size_t value = 0;
  for (size_t k = 0; k < size; ++k) value |= size_t{data[k]} << 8 * k;
  return value;
}

// Parses NumPy's name of a type: a byte order, a kind and a number of bytes.
std::optional<NumberType> ParseType(const std::string& text) {
  if (text.size() != 3 || text[2] < '0') return {};
  const auto bytes = static_cast<size_t>(text[2] - '0');
  const ByteOrder order = text[0] == '>' ? ByteOrder::kBig : ByteOrder::kLittle;
  const bool is_bool = text[1] == 'b' && bytes == 1;
  if (text[1] != 'f' && text[1] != 'i' && text[1] != 'u' && !is_bool) return {};
  const NumberKind kind = text[1] == 'f'   ? NumberKind::kFloat
                          : text[1] == 'i' ? NumberKind::kSigned
                                           : NumberKind::kUnsigned;
  const NumberType type = {kind, bytes, order};
  return CanReadNumbers(type) ? std::optional(type) : std::nullopt;
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

// Converts a map that stores one column after another to rows.
FloatMap Transposed(const FloatMap& columns) {
  FloatMap map = {columns.height, columns.width, {}};
  map.values.reserve(columns.values.size());
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) map.values.push_back(columns.at(y, x));
  }
  return map;
}

// Returns an error unless the array is a map of a supported type and size whose file has `bytes`
// bytes.
Error CheckMap(const std::string& where, bool is_matte, const NpyHeader& header, uint64_t bytes) {
  if (!header.numbers) {
    return Reject(where, is_matte, "an array of floats of 16, 32 or 64 bits, integers or booleans",
                  "the type " + header.type);
  }
  if (!header.is_map()) {
    return Reject(where, is_matte, "an array of rows and columns",
                  "the shape (" + header.shape + ")");
  }
  if (Error error = CheckPictureSize(where, header.sizes[1], header.sizes[0])) return error;
  const uint64_t expected =
      static_cast<uint64_t>(header.sizes[0] * header.sizes[1]) * header.numbers->bytes;
  if (bytes == header.end + expected) return {};
  return Expected(where, std::to_string(expected) + " bytes of values",
                  std::to_string(bytes - header.end));
}

}  // namespace

bool IsNpy(const Bytes& bytes) {
  return bytes.size() >= kSignatureSize &&
         std::memcmp(bytes.data(), kSignature, kSignatureSize) == 0;
}

std::optional<NpyHeader> ParseNpyHeader(const Bytes& npy) {
  if (!IsNpy(npy) || npy.size() < kSignatureSize + 6) return {};
  const int version = npy[kSignatureSize];
  if (version < 1 || version > 3) return {};
  const size_t length_bytes = version == 1 ? 2 : 4, begin = kSignatureSize + 2 + length_bytes;
  const size_t length = LoadLittle(&npy[kSignatureSize + 2], length_bytes);
  if (length > kMostHeaderBytes || length > npy.size() - begin) return {};
  const auto first = npy.begin() + static_cast<ptrdiff_t>(begin);
  const std::string text(first, first + static_cast<ptrdiff_t>(length));
  static const std::regex form(
      R"(\{'descr': '([^']*)', 'fortran_order': (True|False), 'shape': \(([0-9, ]*)\),? *\} *\n?)");
  std::smatch match;
  if (!std::regex_match(text, match, form)) return {};
  NpyHeader header;
  header.type = match[1];
  header.shape = match[3];
  header.numbers = ParseType(header.type);
  header.sizes = DimensionsOf(header.shape);
  header.is_fortran_order = match[2] == "True";
  header.end = begin + length;
  return header;
}

Result<Samples> DecodeNpy(const std::string& where, bool is_matte, const Bytes& npy) {
  const std::optional<NpyHeader> header = ParseNpyHeader(npy);
  if (!header)
    return Reject(where, is_matte, "an NPY file of one array of numbers", "another header");
  if (Error error = CheckMap(where, is_matte, *header, npy.size())) return error;
  auto width = static_cast<int>(header->sizes[1]), height = static_cast<int>(header->sizes[0]);
  if (header->is_fortran_order) std::swap(width, height);
  Samples samples = {
      {width, height, {}}, LargestNumber(*header->numbers), header->numbers->bytes > 2};
  FloatMap& map = samples.map;
  map.values.resize(size_t(width) * size_t(height));
  ReadNumbers(*header->numbers, npy.data() + header->end, map.values.size(), map.values.data());
  if (header->is_fortran_order) map = Transposed(map);
  return samples;
}

}  // namespace starfocus
