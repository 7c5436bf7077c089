// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps in NPY and TIFF files, which the tests write byte by byte.
#include "platform/depth_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/error_line.h"

namespace starfocus::depth_file_test {
namespace {

Result<Samples> Decode(const std::string& file) {
  return DecodeDepthFile("map", true, Bytes(file.begin(), file.end()));
}

template <class T>
std::string BytesOf(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string Little(uint32_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> 8 * k);
  return text;
}

std::string Npy(const std::string& type, const std::string& shape, const std::string& values,
                int version = 1) {
  const std::string header =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }   \n";
  return "\x93NUMPY" + Little(static_cast<uint32_t>(version), 2) +
         Little(static_cast<uint32_t>(header.size()), version == 1 ? 2 : 4) + header + values;
}

// Entries of a TIFF directory: a tag and its number. The entries must be sorted by tag.
using Tags = std::vector<std::pair<uint32_t, uint32_t>>;

constexpr uint32_t kDataAt = 8;

// Returns the tags of a picture of 3x2 pixels in one strip of `bytes` bytes at kDataAt.
Tags TagsOf(uint32_t bits, uint32_t format, uint32_t bytes) {
  return {{256, 3},       {257, 2}, {258, bits}, {259, 1},     {262, 1},
          {273, kDataAt}, {277, 1}, {278, 2},    {279, bytes}, {339, format}};
}

void SetTag(uint32_t tag, uint32_t value, Tags* tags) {
  for (auto& [own, number] : *tags) {
    if (own == tag) number = value;
  }
}

std::string Tiff(const Tags& tags, const std::string& strip) {
  const auto end = static_cast<uint32_t>(kDataAt + strip.size());
  std::string file = "II*" + std::string(1, '\0') + Little(end, 4) + strip;
  file += Little(static_cast<uint32_t>(tags.size()), 2);
  constexpr uint32_t kLong = 4;
  for (const auto& [tag, value] : tags) {
    file += Little(tag, 2) + Little(kLong, 2) + Little(1, 4) + Little(value, 4);
  }
  return file + Little(0, 4);
}

const std::vector<float> kFloats = {0.5F, 1.25F, -3, 7, 1e-3F, 9};

void CheckSamples(const Result<Samples>& samples, int largest, const std::vector<float>& values) {
  REQUIRE(samples == "");
  CHECK(samples->map.width == 3);
  CHECK(samples->map.height == 2);
  CHECK(samples->largest == largest);
  CHECK(!samples->larger_is_nearer);
  CHECK(samples->map.values == values);
}

bool HasTiff() { return !Contains(Decode(Tiff({}, "")), "built without libtiff"); }

TEST_CASE("npy: floats and integers of all shapes for one map are read") {
  for (const char* shape : {"2, 3", "2,3", "1, 2, 3", "2, 3, 1", "1, 1, 2, 3"}) {
    CAPTURE(shape);
    CheckSamples(Decode(Npy("<f4", shape, BytesOf(kFloats))), 0, kFloats);
  }
  CheckSamples(Decode(Npy("<f4", "2, 3", BytesOf(kFloats), 2)), 0, kFloats);
  CheckSamples(Decode(Npy("<f8", "2, 3", BytesOf(std::vector<double>{0.5, 1, 2, 3, 4, -5}))), 0,
               {0.5F, 1, 2, 3, 4, -5});
  CheckSamples(Decode(Npy("|u1", "2, 3", BytesOf(std::vector<uint8_t>{0, 1, 2, 3, 4, 255}))), 255,
               {0, 1, 2, 3, 4, 255});
  CheckSamples(Decode(Npy("<u2", "2, 3", BytesOf(std::vector<uint16_t>{0, 1, 2, 3, 4, 65535}))),
               65535, {0, 1, 2, 3, 4, 65535});
  CheckSamples(Decode(Npy("<i2", "2, 3", BytesOf(std::vector<int16_t>{0, 1, 2, 3, 4, -5}))), 32767,
               {0, 1, 2, 3, 4, -5});
  const Result<Samples> gap = Decode(Npy("<f4", "1, 2", BytesOf(std::vector<float>{NAN, 1})));
  REQUIRE(gap == "");
  CHECK(std::isnan(gap->map.at(0, 0)));
  const std::vector<double> large = {1e39, -1e300, 3e38};
  const Result<Samples> most = Decode(Npy("<f8", "1, 3", BytesOf(large)));
  REQUIRE(most == "");
  CHECK(most->map.values == std::vector<float>{HUGE_VALF, -HUGE_VALF, 3e38F});
}

TEST_CASE("npy: other arrays are rejected with the found property and a conversion") {
  const std::string values = BytesOf(kFloats);
  for (const auto& pair :
       {std::pair{Npy("<f2", "2, 3", values), "<f2 (numpy.save(FILE, depth.astype('float32'))"},
        std::pair{Npy("<f4", "6,", values), "found the shape (6,) (numpy.save("},
        std::pair{Npy("<f4", "2, 3, 2", values), "found the shape (2, 3, 2)"},
        std::pair{Npy("<f4", "2, 4", values), "expected 32 bytes of values, found 24"},
        std::pair{Npy("<f4", "2, 2", values), "expected 16 bytes of values, found 24"},
        std::pair{Npy("<f4", "0, 3", ""), "found 3x0"},
        std::pair{Npy("<f4", "65535, 65535", values), "found 65535x65535"},
        std::pair{Npy("<f4", "2, 99999999999999999999", values), "from 1 to 65535"},
        std::pair{Npy("<f4', 'x': '", "2, 3", values), "found another header"},
        std::pair{Npy("<f4", "2, 3", values).substr(0, 40), "found another header"},
        std::pair{Npy("<f4", "2, 3", values, 4), "found another header"}}) {
    const char* const found = pair.second;
    CAPTURE(found);
    CHECK(Contains(Decode(pair.first), found));
  }
  std::string fortran = Npy("<f4", "2, 3", values);
  fortran.replace(fortran.find("False"), 5, "True ");
  CHECK(Contains(Decode(fortran), "another header"));
  fortran = Npy("<f4", "2, 3", values);
  const size_t at = fortran.find("False,");
  fortran.replace(at, 6, "True,").insert(fortran.find("}") + 1, " ");
  CHECK(Contains(Decode(fortran), "expected an array in C order, found Fortran order"));
}

TEST_CASE("tiff: floats and integers are read in both byte orders and compressed") {
  if (!HasTiff()) return;
  CheckSamples(Decode(Tiff(TagsOf(32, 3, 24), BytesOf(kFloats))), 0, kFloats);
  const std::vector<float> levels = {0, 1, 2, 3, 4, 255};
  const std::vector<uint8_t> bytes = {0, 1, 2, 3, 4, 255};
  CheckSamples(Decode(Tiff(TagsOf(8, 1, 6), BytesOf(bytes))), 255, levels);
  const std::vector<uint16_t> words = {0, 1, 2, 3, 4, 255};
  CheckSamples(Decode(Tiff(TagsOf(16, 1, 12), BytesOf(words))), 65535, levels);
  Tags packed = TagsOf(8, 1, 8);
  SetTag(259, 32773, &packed);  // PackBits: a count less one, and the bytes of each row.
  CheckSamples(Decode(Tiff(packed, {"\2\0\1\2\2\3\4\377", 8})), 255, levels);
  std::string big("MM\0*\0\0\0\16\0\0\0\1\0\2", 14);  // The values 0, 1, 2 before the directory.
  big += std::string("\0\7", 2);
  for (const auto& [tag, value] :
       Tags{{256, 3}, {257, 1}, {258, 16}, {262, 1}, {273, 8}, {278, 1}, {279, 6}}) {
    for (const uint32_t part : {tag << 16 | 4, uint32_t{1}, value}) {
      for (int shift = 24; shift >= 0; shift -= 8) big += static_cast<char>(part >> shift);
    }
  }
  const Result<Samples> samples = Decode(big + std::string(4, '\0'));
  REQUIRE(samples == "");
  CHECK(samples->map.values == std::vector<float>{0, 1, 2});
}

TEST_CASE("tiff: other layouts and damaged files are rejected with a conversion") {
  if (!HasTiff()) return;
  const std::string strip = BytesOf(kFloats);
  const auto changed = [&strip](uint32_t tag, uint32_t value) {
    Tags tags = TagsOf(32, 3, 24);
    SetTag(tag, value, &tags);
    return Decode(Tiff(tags, strip));
  };
  for (const auto& row :
       {std::tuple{258U, 64U, "found 64-bit floats (convert the map to PFM or NPY"},
        std::tuple{339U, 2U, "found 32-bit signed integers"},
        std::tuple{339U, 6U, "found 32-bit samples of another type"},
        std::tuple{262U, 0U, "found black as the largest value"},
        std::tuple{262U, 2U, "found photometric interpretation 2"},
        std::tuple{277U, 3U, "found 3 samples for each pixel"},
        std::tuple{259U, 50000U, "found compression 50000"},
        std::tuple{256U, 70000U, "found 70000x2"},
        std::tuple{257U, 60000U, "an undamaged TIFF file"},
        std::tuple{273U, 4000U, "an undamaged TIFF file"}}) {
    const uint32_t tag = std::get<0>(row), value = std::get<1>(row);
    CAPTURE(tag);
    CAPTURE(value);
    CHECK(Contains(changed(tag, value), std::get<2>(row)));
  }
  Tags huge = TagsOf(32, 3, 24);
  SetTag(256, 16384, &huge);
  SetTag(257, 16384, &huge);
  CHECK(Contains(Decode(Tiff(huge, strip)), "too small for its pixels"));
  Tags turned = TagsOf(32, 3, 24);
  turned.insert(turned.begin() + 6, {274, 6});
  CHECK(Contains(Decode(Tiff(turned, strip)), "a TIFF of orientation 1, found 6"));
  CHECK(Contains(Decode(std::string("II*\0\377\377\0\0", 8)), "an undamaged TIFF file"));
}

TEST_CASE("depth files: the content determines the format, and other formats are named") {
  const Result<Samples> pfm = Decode("Pf\n1 1\n-1\n" + BytesOf(std::vector<float>{3}));
  REQUIRE(pfm == "");
  CHECK(pfm->larger_is_nearer);
  CHECK(pfm->map.values == std::vector<float>{3});
  const Result<Samples> pgm = Decode("P5 2 1 9 \4\7");
  REQUIRE(pgm == "");
  CHECK(pgm->largest == 9);
  CHECK(Contains(Decode("v/1\1 and more bytes"), "found an OpenEXR file (convert the map to PFM"));
  CHECK(Contains(Decode("PK\3\4 of numpy.savez"), "found a ZIP archive (convert the map to PFM"));
}

}  // namespace
}  // namespace starfocus::depth_file_test
