// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps in NPY, NPZ and TIFF files, which the tests write byte by byte.
#include "platform/depth_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"

namespace starfocus::depth_file_test {
namespace {

Result<Samples> Decode(const std::string& file) {
  return DecodeDepthFile("map", Alpha::kTransparent, Bytes(file.begin(), file.end()));
}

Result<Samples> DecodeMatte(const std::string& file) {
  return DecodeDepthFile("matte", Alpha::kTaken, Bytes(file.begin(), file.end()));
}

template <class T>
std::string BytesOf(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string Little(uint64_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> 8 * k);
  return text;
}

std::string Npy(const std::string& type, const std::string& shape, const std::string& values,
                int version = 1, bool is_fortran_order = false) {
  const std::string header = "{'descr': '" + type +
                             "', 'fortran_order': " + (is_fortran_order ? "True" : "False") +
                             ", 'shape': (" + shape + "), }   \n";
  return "\x93NUMPY" + Little(version, 2) + Little(header.size(), version == 1 ? 2 : 4) + header +
         values;
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
  file += Little(tags.size(), 2);
  constexpr uint32_t kLong = 4;
  for (const auto& [tag, value] : tags) {
    file += Little(tag, 2) + Little(kLong, 2) + Little(1, 4) + Little(value, 4);
  }
  return file + Little(0, 4);
}

const std::vector<float> kFloats = {0.5F, 1.25F, -3, 7, 1e-3F, 9};

void CheckSamples(const Result<Samples>& samples, int largest, const std::vector<float>& values) {
  REQUIRE(samples == "");
  const FloatMap& map = samples->map;
  CHECK(std::tuple(map.width, map.height, samples->largest, samples->larger_is_nearer) ==
        std::tuple(3, 2, largest, false));
  CHECK(map.values == values);
}

std::vector<float> ValuesOf(const Result<Samples>& samples) {
  REQUIRE(samples == "");
  return samples->map.values;
}

bool HasTiff() { return !Contains(Decode(Tiff({}, "")), "built without libtiff"); }

// Numbers of one type: names of the type in NPY without byte order and in TIFF, and the bytes of
// the values 0, 1, 2, 3, 5 and `last` in the byte order of this machine.
struct TypeCase {
  std::string npy;
  uint32_t tiff;
  int largest;
  std::string bytes;
  float last;
};

template <class T>
TypeCase CaseOf(const std::string& npy, uint32_t tiff, int largest, T last) {
  return {npy, tiff, largest, BytesOf(std::vector<T>{0, 1, 2, 3, 5, last}),
          static_cast<float>(last)};
}

std::vector<TypeCase> AllTypes() {
  constexpr uint32_t kUnsigned = 1, kSigned = 2, kFloat = 3;
  return {CaseOf<uint8_t>("u1", kUnsigned, 255, 255),
          CaseOf<int8_t>("i1", kSigned, 127, -128),
          CaseOf<uint16_t>("u2", kUnsigned, 65535, 65535),
          CaseOf<int16_t>("i2", kSigned, 32767, -5),
          CaseOf<uint32_t>("u4", kUnsigned, 65535, 4000000000),
          CaseOf<int32_t>("i4", kSigned, 65535, -70000),
          CaseOf<uint64_t>("u8", kUnsigned, 65535, uint64_t{1} << 40),
          CaseOf<int64_t>("i8", kSigned, 65535, -(int64_t{1} << 40)),
          // Half floats: 0, 1, 2, 3, 5 and -6.
          {"f2", kFloat, 0,
           BytesOf(std::vector<uint16_t>{0, 0x3C00, 0x4000, 0x4200, 0x4500, 0xC600}), -6},
          CaseOf<float>("f4", kFloat, 0, 1e-3F),
          CaseOf<double>("f8", kFloat, 0, -0.5)};
}

// Reverses the bytes of each number.
std::string Swapped(std::string bytes, size_t size) {
  for (size_t at = 0; at < bytes.size(); at += size) {
    std::reverse(bytes.begin() + ptrdiff_t(at), bytes.begin() + ptrdiff_t(at + size));
  }
  return bytes;
}

constexpr bool kIsBig = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

TEST_CASE("npy: all types, byte orders, orders of dimensions and shapes of one map are read") {
  for (const TypeCase& type : AllTypes()) {
    CAPTURE(type.npy);
    const std::vector<float> expected = {0, 1, 2, 3, 5, type.last};
    const size_t size = type.bytes.size() / 6;
    for (const bool big : {false, true}) {
      CAPTURE(big);
      const std::string bytes = big == kIsBig ? type.bytes : Swapped(type.bytes, size);
      const std::string name = (size == 1 ? "|" : big ? ">" : "<") + type.npy;
      for (const char* shape : {"2, 3", "2,3", "1, 2, 3", "2, 3, 1", "1, 1, 2, 3"}) {
        CAPTURE(shape);
        CheckSamples(Decode(Npy(name, shape, bytes)), type.largest, expected);
      }
      CheckSamples(Decode(Npy(name, "2, 3", bytes, 2)), type.largest, expected);
      // Columns follow each other: 0 1, 2 3, 5 and the last value.
      CheckSamples(Decode(Npy(name, "2, 3", bytes, 1, true)), type.largest,
                   {0, 2, 5, 1, 3, type.last});
    }
  }
  CheckSamples(Decode(Npy("|b1", "2, 3", std::string("\0\1\1\0\0\1", 6))), 255, {0, 1, 1, 0, 0, 1});
}

TEST_CASE("npy: values that are not finite keep their meaning in all floats") {
  const std::vector<uint16_t> halves = {0x7C00, 0xFC00, 0x7E01, 0x0001, 0x8200, 0x7BFF};
  const std::vector<float> floats = {HUGE_VALF, -HUGE_VALF, NAN, 0x1p-24F, -0x1p-15F, 65504};
  const std::vector<double> doubles(floats.begin(), floats.end());
  for (const std::string& file :
       {Npy("<f2", "2, 3", BytesOf(halves)), Npy("<f4", "2, 3", BytesOf(floats)),
        Npy("<f8", "2, 3", BytesOf(doubles))}) {
    const std::vector<float> values = ValuesOf(Decode(file));
    for (size_t k = 0; k < floats.size(); ++k) {
      CAPTURE(k);
      const float value = values[k];
      CHECK((std::isnan(floats[k]) ? std::isnan(value) : value == floats[k]));
    }
  }
  const std::vector<double> large = {1e39, -1e300, 3e38};
  CHECK(ValuesOf(Decode(Npy("<f8", "1, 3", BytesOf(large)))) ==
        std::vector<float>{HUGE_VALF, -HUGE_VALF, 3e38F});
}

TEST_CASE("npy: other arrays are rejected with the found property and a conversion") {
  const std::string values = BytesOf(kFloats);
  for (const auto& pair :
       {std::pair{Npy("<c8", "2, 3", values), "<c8 (numpy.save(FILE, depth.astype('float32'))"},
        std::pair{Npy("|O", "2, 3", values), "found the type |O"},
        std::pair{Npy("<f16", "2, 3", values), "found the type <f16"},
        std::pair{Npy("<f1", "2, 3", values), "found the type <f1"},
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
}

TEST_CASE("tiff: floats and integers are read in both byte orders and compressed") {
  if (!HasTiff()) return;
  for (const TypeCase& type : AllTypes()) {
    CAPTURE(type.npy);
    const auto size = static_cast<uint32_t>(type.bytes.size());
    const std::string bytes = kIsBig ? Swapped(type.bytes, size / 6) : type.bytes;
    CheckSamples(Decode(Tiff(TagsOf(8 * size / 6, type.tiff, size), bytes)), type.largest,
                 {0, 1, 2, 3, 5, type.last});
  }
  Tags packed = TagsOf(8, 1, 8);
  SetTag(259, 32773, &packed);  // PackBits: a count less one, and the bytes of each row.
  CheckSamples(Decode(Tiff(packed, {"\2\0\1\2\2\3\4\377", 8})), 255, {0, 1, 2, 3, 4, 255});
  std::string big("MM\0*\0\0\0\16\0\0\0\1\0\2", 14);  // The values 0, 1, 2 before the directory.
  big += std::string("\0\7", 2);
  for (const auto& [tag, value] :
       Tags{{256, 3}, {257, 1}, {258, 16}, {262, 1}, {273, 8}, {278, 1}, {279, 6}}) {
    for (const uint32_t part : {tag << 16 | 4, uint32_t{1}, value}) {
      for (int shift = 24; shift >= 0; shift -= 8) big += static_cast<char>(part >> shift);
    }
  }
  CHECK(ValuesOf(Decode(big + std::string(4, '\0'))) == std::vector<float>{0, 1, 2});
}

TEST_CASE("tiff: other layouts and damaged files are rejected with a conversion") {
  if (!HasTiff()) return;
  const struct {
    Tags changes;
    const char* error;
  } rows[] = {{{{258, 24}}, "found 24-bit floats (convert the map to PFM or NPY"},
              {{{258, 4}}, "found 4-bit floats"},
              {{{339, 6}}, "found 32-bit samples of another type"},
              {{{262, 0}}, "found black as the largest value"},
              {{{262, 2}}, "found photometric interpretation 2"},
              {{{277, 3}}, "found 3 samples for each pixel"},
              {{{259, 50000}}, "found compression 50000"},
              {{{256, 70000}}, "found 70000x2"},
              {{{257, 60000}}, "an undamaged TIFF file"},
              {{{273, 4000}}, "an undamaged TIFF file"},
              {{{256, 16384}, {257, 16384}}, "too small for its pixels"}};
  for (const auto& row : rows) {
    CAPTURE(row.error);
    Tags tags = TagsOf(32, 3, 24);
    for (const auto& [tag, value] : row.changes) SetTag(tag, value, &tags);
    CHECK(Contains(Decode(Tiff(tags, BytesOf(kFloats))), row.error));
  }
  Tags turned = TagsOf(32, 3, 24);
  turned.insert(turned.begin() + 6, {274, 6});
  CHECK(Contains(Decode(Tiff(turned, BytesOf(kFloats))), "a TIFF of orientation 1, found 6"));
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
  CHECK(Contains(Decode("v/1\1 and more bytes"), "OpenEXR"));
}

TEST_CASE("depth files: every text is described as a text, and the error names formats of maps") {
  for (const char* text : {"hi", "P2 2 1 9 4 7", "P5", "Pf", "Portrait, no map", "PFM of a map",
                           "0.5,1.25,3\n7,8,9\n", "RIFFs and other text", "BPM, version 4"}) {
    CAPTURE(text);
    const Result<Samples> samples = Decode(text);
    CHECK(Contains(samples, "expected a depth picture (PFM, TIFF, OpenEXR, NPY, "));
    CHECK(Contains(samples, "found a text file (convert the map to PFM or NPY"));
  }
  CHECK(Contains(Decode(""), "found an empty file"));
}

// A file of an archive. `deflated` selects Deflate, whose data is a block without compression.
struct ArchiveFile {
  std::string name, bytes;
  bool deflated = false;
};

// Fields of ZIP archives that a test changes.
struct ArchiveChange {
  bool is_64 = false;  // True: sizes and positions are in the fields of ZIP64.
  uint32_t flags = 0, method = 0, crc = 0, more_bytes = 0, more_packed = 0;
  std::string comment = "";
};

std::string Long(uint64_t value) { return Little(value, 8); }

// Writes a ZIP archive as APPNOTE.TXT of PKWARE describes it.
std::string Zip(const std::vector<ArchiveFile>& files, const ArchiveChange& change = {}) {
  std::string zip, directory;
  for (const ArchiveFile& file : files) {
    const auto size = static_cast<uint32_t>(file.bytes.size());
    const std::string packed =
        file.deflated ? "\1" + Little(size, 2) + Little(~size, 2) + file.bytes : file.bytes;
    const auto at = static_cast<uint32_t>(zip.size());
    const uint32_t bytes = size + change.more_bytes;
    const auto stored = static_cast<uint32_t>(packed.size()) + change.more_packed;
    const std::string checked = Little(change.flags, 2) +
                                Little(change.method + (file.deflated ? 8 : 0), 2) + Little(0, 4) +
                                Little(photos::Crc(file.bytes) ^ change.crc, 4);
    const auto name = Little(file.name.size(), 2);
    zip += "PK\3\4" + Little(20, 2) + checked + Little(0, 8) + name + Little(4, 2) + file.name +
           Little(0xCAFE, 4) + packed;
    const std::string extra = change.is_64
                                  ? Little(9, 2) + Little(1, 2) + "x" + Little(1, 2) +
                                        Little(24, 2) + Long(bytes) + Long(stored) + Long(at)
                                  : "";
    const std::string sizes = Little(stored, 4) + Little(bytes, 4), none(8, '\xff');
    directory += "PK\1\2" + Little(20, 2) + Little(20, 2) + checked +
                 (change.is_64 ? none : sizes) + name + Little(extra.size(), 2) + Little(0, 2) +
                 Little(0, 8) + (change.is_64 ? none.substr(4) : Little(at, 4)) + file.name + extra;
  }
  const auto at = static_cast<uint32_t>(zip.size()), size = static_cast<uint32_t>(directory.size());
  const auto count = static_cast<uint32_t>(files.size());
  zip += directory;
  if (change.is_64) {
    const std::string end = "PK\6\6" + Long(44) + Little(45, 2) + Little(45, 2) + Little(0, 8) +
                            Long(count) + Long(count) + Long(size) + Long(at);
    zip += end + "PK\6\7" + Little(0, 4) + Long(at + size) + Little(1, 4);
  }
  return zip + "PK\5\6" + Little(0, 4) + Little(change.is_64 ? 65535 : count, 2) +
         Little(change.is_64 ? 65535 : count, 2) + Little(size, 4) +
         Little(change.is_64 ? 0xffffffff : at, 4) + Little(change.comment.size(), 2) +
         change.comment;
}

std::string Floats(const std::string& shape, size_t count) {
  return Npy("<f4", shape, BytesOf(std::vector<float>(count, 9)));
}

TEST_CASE("npz: the array named depth, or the only map, is read from all forms of archives") {
  const std::string map = Npy("<f4", "2, 3", BytesOf(kFloats));
  const std::string wide = Npy("|u1", "5, 6", std::string(30, '\7'));
  const std::string mask = Npy("|b1", "5, 6", std::string(30, '\1'));
  for (const bool deflated : {false, true}) {
    const ArchiveFile focal = {"focallength_px.npy", Floats("", 1), deflated};
    const ArchiveFile matrix = {"K.npy", Floats("3, 3", 9), deflated};
    const std::vector<ArchiveFile> named = {
        {"wide.npy", wide, deflated}, focal, {"depth.npy", map, deflated}, {"notes.txt", "text"}};
    for (const ArchiveChange& change :
         {ArchiveChange(), ArchiveChange{true}, ArchiveChange{false, 0, 0, 0, 0, 0, "PK and more"},
          ArchiveChange{true, 0, 0, 0, 0, 0, std::string(65535, 'c')}}) {
      CheckSamples(Decode(Zip(named, change)), 0, kFloats);
    }
    CheckSamples(Decode(Zip({{"Depth.npy", map, deflated}, {"b.npy", wide, deflated}})), 0,
                 kFloats);
    const std::vector<ArchiveFile> other = {
        focal, matrix, {"mask.npy", mask, deflated}, {"pred.npy", wide, deflated}};
    CHECK(ValuesOf(Decode(Zip(other))) == std::vector<float>(30, 7));
    CHECK(Contains(Decode(Zip({{"a.npy", wide, deflated}, {"b.npy", wide, deflated}, focal})),
                   "found 2: a, b (numpy.save('depth.npy', numpy.load(FILE)['NAME'])"));
    CHECK(Contains(Decode(Zip({focal, {"clip.npy", Floats("2, 2, 3", 12), deflated}})),
                   "found other arrays: focallength_px, clip"));
  }
  CHECK(Contains(Decode(Zip({{"word/document.xml", "<text/>"}})), "a ZIP archive without arrays"));
  CHECK(Contains(Decode(Zip({{"depth.npy", Npy("|O", "2, 3", "")}})), "map: depth: expected"));
}

TEST_CASE("npz: of a matte, the array named matte or alpha is read, or the only array") {
  const std::string matte = Npy("<f4", "2, 3", BytesOf(kFloats));
  const std::string depth = Npy("|u1", "5, 6", std::string(30, '\7'));
  const std::string mask = Npy("|b1", "5, 6", std::string(30, '\1'));
  for (const char* name : {"matte.npy", "Alpha.npy"}) {
    CheckSamples(DecodeMatte(Zip({{"depth.npy", depth}, {name, matte}})), 0, kFloats);
  }
  CHECK(ValuesOf(DecodeMatte(Zip({{"mask.npy", mask}}))) == std::vector<float>(30, 1));
  CHECK(Contains(DecodeMatte(Zip({{"depth.npy", depth}, {"mask.npy", mask}})),
                 "expected an array named matte or alpha, or a single array of rows and columns, "
                 "found 2: depth, mask (numpy.save('matte.npy', numpy.load(FILE)['NAME'])"));
  CHECK(Contains(DecodeMatte(Npy("<c8", "2, 3", "")), "(numpy.save(FILE, matte.astype("));
}

TEST_CASE("npz: damaged archives and archives that promise too much are rejected") {
  const std::string map = Npy("<f4", "2, 3", BytesOf(kFloats));
  const auto found = [&](const ArchiveChange& change, bool deflated = false) {
    return Decode(Zip({{"depth.npy", map, deflated}}, change));
  };
  CHECK(Contains(found({false, 1}), "a ZIP archive without a password"));
  CHECK(Contains(found({false, 0, 12}), "found compression method 12"));
  CHECK(Contains(found({false, 0, 0, 1}), "a wrong checksum"));
  CHECK(Contains(found({false, 0, 0, 0, 1}), "two sizes of a file that is not compressed"));
  CHECK(Contains(found({true, 0, 0, 0, 1u << 31}, true), "too small for its files"));
  CHECK(Contains(found({false, 0, 0, 0, 0, 1000}), "too small for its files"));
  const Result<Samples> longer = found({false, 0, 0, 0, 1}, true);
  CHECK((Contains(longer, "cannot be decompressed") || Contains(longer, "libdeflate")));
  const std::string zip = Zip({{"depth.npy", map}});
  for (size_t size = 4; size < zip.size(); ++size) {
    CAPTURE(size);
    CHECK(Decode(zip.substr(0, size)) != "");
  }
  for (size_t at = 4; at < zip.size(); ++at) {  // No byte makes the decoder crash.
    std::string changed = zip;
    changed[at] = static_cast<char>(~changed[at]);
    CHECK((Decode(changed) == "" || !Decode(changed)));
  }
  const std::vector<ArchiveFile> many(1001, ArchiveFile{"a.npy", ""});
  CHECK(Contains(Decode(Zip(many)), "at most 1000 files, found 1001"));
}

}  // namespace
}  // namespace starfocus::depth_file_test
