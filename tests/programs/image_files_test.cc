// SPDX-License-Identifier: Apache-2.0
// Tests the pictures that the programs read and write. exiftool and webpinfo, if installed, read
// the files of the writers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "platform/base64.h"
#include "platform/container.h"
#include "platform/icc_profile.h"
#include "platform/image_io.h"
#include "platform/png.h"
#include "platform/writers/depth_photo.h"
#include "platform/writers/exif.h"
#include "platform/writers/jpeg.h"
#include "platform/writers/md5.h"
#include "platform/writers/png.h"
#include "platform/writers/webp.h"
#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"
#include "tests/support/temp_folder.h"

namespace starfocus::image_files_test {
namespace {

Image Pattern(int width, int height) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<uint8_t>(i * 37 + i / 7);
  }
  return image;
}

Bytes FromText(const std::string& text) { return Bytes(text.begin(), text.end()); }

std::string ToText(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// Returns the first bytes of a file.
Bytes Cut(const Bytes& bytes, size_t size) {
  return Bytes(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size));
}

// Reads `bytes` as a picture.
Result<Image> ReadBytes(const Bytes& bytes) {
  TempFolder folder;
  const std::string path = folder.file("picture");
  REQUIRE(WriteFile(path, bytes) == "");
  return ReadImage(path);
}

// Returns the largest difference of the samples of two pictures, or 256 if their sizes differ.
int Difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return 256;
  int most = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
  }
  return most;
}

// Returns the picture of the seeds of the fuzz targets: red 40 + 7 x, green 60 + 8 y, and blue 128,
// times `share`.
Image SeedPicture(double share) {
  Image image(24, 16);
  for (int k = 0; k < 24 * 16; ++k) {
    const int codes[] = {40 + 7 * (k % 24), 60 + 8 * (k / 24), 128};
    for (int c = 0; c < 3; ++c) {
      image.pixels[size_t(3 * k + c)] = static_cast<uint8_t>(std::lround(codes[c] * share));
    }
  }
  return image;
}

TEST_CASE("image_io: PNG and PPM are read back exactly at any size, and JPEG approximately") {
  TempFolder folder;
  const auto difference = [&](const std::string& name, const Image& image) {
    REQUIRE(WriteImage(folder.file(name), image) == "");
    return Difference(ValueOf(ReadImage(folder.file(name))), image);
  };
  for (const char* name : {"a.png", "a.ppm", "a.PNG"}) {
    for (const int width : {1, 2, 3, 17, 64}) {
      for (const int height : {1, 5, 31}) CHECK(difference(name, Pattern(width, height)) == 0);
    }
  }
  CHECK(difference("a.jpg", SeedPicture(1)) <= 8);
  CHECK(folder.count() == 4);  // no temporary file is left
}

TEST_CASE("image_io: all variants of PPM headers are read") {
  Image image = ValueOf(ReadBytes(FromText("P6 # comment\n1\t1\n255\nabc")));
  CHECK(image.pixels == FromText("abc"));
  image = ValueOf(ReadBytes(FromText("P5 2 1 100 \x32\x64")));
  CHECK(image.pixels == Bytes{128, 128, 128, 255, 255, 255});
  Bytes wide = FromText("P6 1 1 65535\n");
  for (int value : {0xff, 0xff, 0x80, 0x00, 0x00, 0x00}) wide.push_back(uint8_t(value));
  image = ValueOf(ReadBytes(wide));
  CHECK(image.pixels == Bytes{255, 128, 0});
}

TEST_CASE("image_io: malformed files cause one-line errors") {
  for (const char* text : {"", "P", "P6", "P6 2 2 255\nabc", "P6 0 1 255\n", "P6 -1 1 255\n",
                           "P6 70000 1 255\n", "P6 1 1 0\nabc", "P6 1 1 70000\nabc",
                           "P3 1 1 255\n1 2 3", "garbage", "\x89PNG\r\n\x1a\n", "\xff\xd8\xff"}) {
    CAPTURE(text);
    const std::string error = ReadBytes(FromText(text)).error().line();
    CHECK(Contains(error, "expected "));
    CHECK(Contains(error, ", found "));
    CHECK(!Contains(error, "\n"));
  }
}

// Returns a picture of 24x18 pixels, written in the format of the extension.
Bytes Written(const std::string& name) {
  TempFolder folder;
  REQUIRE(WriteImage(folder.file(name), Pattern(24, 18)) == "");
  return ValueOf(ReadFile(folder.file(name)));
}

// Returns the position of the first marker of a kind in a JPEG file, or the first after `from`.
Bytes::iterator FindMarker(uint8_t marker, Bytes* jpeg, ptrdiff_t from = 0) {
  const uint8_t bytes[] = {0xff, marker};
  const auto at = std::search(jpeg->begin() + from, jpeg->end(), bytes, bytes + 2);
  REQUIRE(at != jpeg->end());
  return at;
}

TEST_CASE(
    "image_io: PNG and JPEG that are truncated anywhere, and a PNG with any byte changed, are "
    "rejected") {
  for (const char* name : {"a.png", "a.jpg"}) {
    const Bytes bytes = Written(name);
    REQUIRE(ReadBytes(bytes) == "");
    for (size_t size = 0; size + 20 < bytes.size(); size += 13) {
      CAPTURE(name);
      CAPTURE(size);
      CHECK(ReadBytes(Cut(bytes, size)) != "");
    }
  }
  Bytes png = Written("a.png");
  for (uint8_t& byte : png) {
    byte ^= 0x10;
    CHECK(ReadBytes(png) != "");
    byte ^= 0x10;
  }
}

TEST_CASE("image_io: parts of a file that are too long for it are rejected before they are read") {
  Bytes png = Written("a.png"), jpeg = Written("a.jpg"), table = jpeg;
  png[33] = 0x67;  // sets the length of the first chunk after the header to 1.7 GB
  CHECK(Contains(ReadBytes(png), "truncated"));
  std::fill_n(FindMarker(0xc0, &jpeg) + 5, 4, uint8_t{0x3f});  // height and width
  CHECK(Contains(ReadBytes(jpeg), "truncated"));
  // A table with more codes than bytes. stb_image skips repeated 0xff bytes.
  const auto codes = FindMarker(0xc4, &table);
  REQUIRE(table.end() - codes > 4 + 17);
  std::fill_n(codes + 4 + 1, 16, uint8_t{17});
  Bytes repeated = table;
  repeated.insert(FindMarker(0xc4, &repeated), 3, 0xff);
  for (const Bytes& broken : {table, repeated}) {
    const Result<Image> read = ReadBytes(broken);  // the error is from libjpeg-turbo or stb_image
    CHECK((Contains(read, "Huffman table") || Contains(read, "code table")));
  }
}

TEST_CASE("image_io: a JPEG table has at most 256 codes") {
  for (const int codes : {255, 256, 257}) {
    CAPTURE(codes);
    const int length = 2 + 17 + codes;
    Bytes jpeg = {0xff, 0xd8, 0xff, 0xc4, uint8_t(length >> 8), uint8_t(length & 255), 0};
    jpeg.insert(jpeg.end(), 15, 16);
    jpeg.push_back(uint8_t(codes - 15 * 16));
    jpeg.insert(jpeg.end(), size_t(codes), 1);
    jpeg.insert(jpeg.end(), {0xff, 0xd9});
    CHECK(CheckContainer(jpeg) == (codes <= 256 ? Container::kWhole : Container::kBroken));
  }
}

TEST_CASE("image_io: no file remains if a picture cannot be written") {
  TempFolder folder;
  Image large;
  large.width = large.height = 40000;
  // The encoders count bytes in an int. A larger picture would overflow the count, and the encoder
  // would write out of bounds.
  for (const char* name : {"a.png", "a.jpg"}) {
    CHECK(Contains(WriteImage(folder.file(name), large), "40000x40000"));
  }
  for (const char* name : {"a.bmp", "none/a.png"}) {
    CHECK(Contains(WriteImage(folder.file(name), Pattern(3, 3)), name));
  }
  CHECK(folder.count() == 0);
}

// Returns a PNG file of one row.
Bytes MakePng(uint32_t width, uint32_t height, photos::PngKind kind, const Bytes& palette,
              const Bytes& row) {
  if (!palette.empty()) {
    kind.more = photos::Chunk("PLTE", {palette.begin(), palette.end()}) +
                photos::Chunk("tRNS", std::string("\0\x80\xff", 3));
  }
  return FromText(photos::Png(width, height, kind, {row.begin(), row.end()}, row.size()));
}

TEST_CASE("image_io: a PNG has colours of its palette, and larger indices are rejected") {
  const Bytes palette = {10, 20, 30, 40, 50, 60, 70, 80, 90};
  for (const int depth : {1, 2, 4, 8}) {
    CAPTURE(depth);
    const int per_byte = 8 / depth, colours = depth == 1 ? 2 : 3;
    for (const int last : {colours - 1, (1 << depth) - 1}) {
      Bytes row(size_t(depth), 0), expected;
      for (int x = 0; x < 8; ++x) {
        const int index = x == 7 ? last : x % colours;
        row[size_t(x / per_byte)] |= uint8_t(index << (8 - depth - x % per_byte * depth));
        for (int c = 0; c < 3 && index < 3; ++c) expected.push_back(palette[size_t(3 * index + c)]);
      }
      const Result<Image> read = ReadBytes(MakePng(8, 1, {depth, 3}, palette, row));
      if (last < 3) {
        CHECK(ValueOf(read).pixels == expected);
      } else {
        CHECK(Contains(read, "palette indices below 3, found " + std::to_string(last)));
      }
    }
  }
  CHECK(ReadBytes(MakePng(8, 1, {8, 3}, {}, Bytes(8))) != "");        // The palette is missing.
  CHECK(ReadBytes(MakePng(8, 1, {8, 3}, Bytes(7), Bytes(8))) != "");  // One colour is incomplete.
  CHECK(ReadBytes(MakePng(4, 1, {16, 3}, palette, Bytes(8))) != "");  // Indices have 16 bits.
  CHECK(ValueOf(ReadBytes(MakePng(8, 1, {8, 0}, {}, Bytes(8, 99)))).pixels == Bytes(24, 99));
  // Bytes after the end are ignored: another palette and the start of a chunk of 1000 bytes.
  Bytes png = MakePng(8, 1, {8, 3}, palette, Bytes(8, 1));
  const std::string more = photos::Chunk("PLTE", std::string(9, '\xc8')) + photos::Big(1000, 4) +
                           "PLTE" + std::string(4, '\0');
  png.insert(png.end(), more.begin(), more.end());
  const Image image = ValueOf(ReadBytes(png));
  CHECK(std::equal(&palette[3], &palette[6], image.row(0)));
}

TEST_CASE(
    "image_io: the error for a picture too large for its format states the size of the picture") {
  for (const auto& [width, height, error] : {std::tuple{65536u, 1u, "1 to 65535, found 65536x1"},
                                             {1u, 0x7fffffffu, "1 to 65535, found 1x2147483647"},
                                             {20000u, 20000u, "2^28 pixels, found 20000x20000"},
                                             {65535u, 65535u, "2^28 pixels, found 65535x65535"}}) {
    CHECK(Contains(ReadBytes(MakePng(width, height, {8, 0}, {}, Bytes(8))), error));
  }
}

// Returns a seed file of the fuzz targets.
Bytes Seed(const std::string& name) {
  return ValueOf(ReadFile(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/photo/" + name));
}

// Returns the largest difference of a file from the seed picture.
int DifferenceFromSeed(const Bytes& file, double share = 1) {
  return Difference(ValueOf(ReadBytes(file)), SeedPicture(share));
}

// Returns true if the build has libjpeg-turbo. stb_image does not read arithmetic coding.
bool HasLibjpeg() { return bool(DecodeImage("arithmetic.jpg", Seed("arithmetic.jpg"))); }

TEST_CASE("image_io: JPEG of every kind that libjpeg-turbo reads has the right colours") {
  if (!HasLibjpeg()) return;
  for (const char* name : {"arithmetic.jpg", "progressive.jpg", "restart.jpg", "cmyk.jpg",
                           "cmyk_adobe.jpg", "ycck.jpg"}) {
    CAPTURE(name);
    // The black channel, if present, is 200 everywhere. Adobe stores inverted values: 255 is no
    // ink.
    const bool black = name[0] == 'c' || name[0] == 'y';
    CHECK(DifferenceFromSeed(Seed(name), black ? 200 / 255.0 : 1) <= 6);
  }
  // Bytes between the parts and after the end are ignored.
  Bytes bytes = Seed("restart.jpg");
  const Bytes junk = {0xff, 0xd1, 0x55, 0x55, 0x55};
  bytes.insert(bytes.end() - 2, junk.begin(), junk.end());
  bytes.insert(bytes.end(), 100, 0xff);
  CHECK(DifferenceFromSeed(bytes) <= 6);
}

TEST_CASE("image_io: a JPEG of more than 500 scans is rejected") {
  if (!HasLibjpeg()) return;
  Bytes seed = Seed("progressive.jpg");
  const auto scan = FindMarker(0xda, &seed), next = FindMarker(0xc4, &seed, scan - seed.begin());
  Bytes bytes(seed.begin(), next);
  for (int i = 0; i < 501; ++i) bytes.insert(bytes.end(), scan, next);
  bytes.insert(bytes.end(), next, seed.end());
  CHECK(Contains(ReadBytes(bytes), "picture: expected at most 500 scans, found more"));
}

TEST_CASE("image_io: the errors for 12-bit JPEG and truncated JPEG name the cause") {
  if (!HasLibjpeg()) return;
  Bytes bytes = Seed("restart.jpg");
  FindMarker(0xc0, &bytes)[4] = 12;
  CHECK(Contains(ReadBytes(bytes), "precision 12"));
  for (const char* name : {"arithmetic.jpg", "progressive.jpg"}) {
    bytes = Seed(name);
    bytes.resize(bytes.size() * 2 / 3);
    CHECK(Contains(ReadBytes(bytes), "truncated"));
  }
  bytes = Seed("restart.jpg");
  bytes.resize(bytes.size() - 60);
  bytes.insert(bytes.end(), {0xff, 0xd9});
  CHECK(Contains(ReadBytes(bytes), "truncated"));
}

TEST_CASE("image_io: an interlaced 16-bit PNG with alpha is read as an 8-bit picture") {
  CHECK(DifferenceFromSeed(Seed("interlaced16.png")) == 0);
}

TEST_CASE("image_io: lossy and lossless WebP is read, and truncated WebP is rejected") {
  if (WebpWriter::Check("", 1, 1)) {
    CHECK(Contains(ReadBytes(Seed("lossless.webp")), "libwebp"));
    return;
  }
  CHECK(DifferenceFromSeed(Seed("lossless.webp")) == 0);
  CHECK(DifferenceFromSeed(Seed("lossy.webp")) <= 12);
  const Bytes whole = Seed("lossy.webp");
  for (size_t size = 12; size < whole.size(); ++size) {
    CAPTURE(size);
    CHECK(Contains(ReadBytes(Cut(whole, size)), "truncated"));
  }
}

// Returns the EXIF of a camera that was held upright: the make, orientation 6, sizes in a separate
// directory, and a thumbnail.
Bytes CameraExif(bool little) {
  Bytes tiff = FromText(little ? "II" : "MM");
  const auto put = [&](std::initializer_list<std::pair<uint32_t, int>> values) {  // and their sizes
    for (const auto& [value, size] : values) {
      for (int i = 0; i < size; ++i) {
        tiff.push_back(static_cast<uint8_t>(value >> (8 * (little ? i : size - 1 - i))));
      }
    }
  };
  put({{42, 2}, {8, 4}, {3, 2}});                           // Three entries at offset 8.
  put({{0x010f, 2}, {2, 2}, {8, 4}, {8 + 2 + 36 + 4, 4}});  // Make.
  put({{0x0112, 2}, {3, 2}, {1, 4}, {6, 2}, {0, 2}});       // Orientation.
  put({{0x8769, 2}, {4, 2}, {1, 4}, {58, 4}});              // Directory of sizes.
  put({{58 + 2 + 24 + 4, 4}});                              // Directory of the thumbnail.
  for (const char c : std::string("Holgaro\0", 8)) tiff.push_back(static_cast<uint8_t>(c));
  put({{2, 2}, {0xa002, 2}, {4, 2}, {1, 4}, {4000, 4}});               // Width, at offset 58.
  put({{0xa003, 2}, {3, 2}, {1, 4}, {3000, 2}, {0, 2}, {0, 4}});       // Height.
  put({{1, 2}, {0x0103, 2}, {3, 2}, {1, 4}, {6, 2}, {0, 2}, {0, 4}});  // Compression.
  return tiff;
}

Bytes Profile(size_t size) { return FromText(photos::Profile(size)); }

TEST_CASE("profiles: only complete RGB profiles are accepted") {
  CHECK(IsRgbProfile(Profile(132)));
  CHECK(IsRgbProfile(Profile(150000)));
  for (const char* space : {"GRAY", "CMYK", "Lab ", "XYZ "}) {
    CHECK_FALSE(IsRgbProfile(FromText(photos::Profile(200, space))));
  }
  for (const size_t size : {0, 3, 131, 199, 201}) {
    Bytes icc = Profile(200);
    icc.resize(size);
    CHECK_FALSE(IsRgbProfile(icc));
  }
  const struct {
    std::vector<std::pair<size_t, uint8_t>> changes;  // positions and values of bytes
    bool is_accepted;
  } rows[] = {{{{36, 'x'}}, false},
              // The 6 tags require 132 + 6 * 12 bytes, which is more than the profile has.
              {{{131, 6}}, false},
              // A tag whose data are 10 bytes from offset 190, and then one byte more.
              {{{131, 1}, {139, 190}, {143, 10}}, true},
              {{{131, 1}, {139, 190}, {143, 11}}, false},
              {{{131, 1}, {136, 0xff}, {139, 190}, {143, 10}}, false}};
  for (const auto& row : rows) {
    Bytes icc = Profile(200);
    std::fill(icc.begin() + 132, icc.end(), uint8_t{0});
    for (const auto& [at, value] : row.changes) icc[at] = value;
    CHECK(IsRgbProfile(icc) == row.is_accepted);
  }
}

bool Has(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

// Returns true if the build has libpng. Without libpng, PNG files have neither 16 bits nor
// metadata.
bool HasLibpng() { return bool(EncodeGreyPng("", {1, 1, {256}})); }

// Returns the output of a command.
std::string Ask(const TempFolder& folder, const std::string& command) {
  const std::string out = folder.file("said");
  CHECK(std::system((command + " >'" + out + "' 2>/dev/null").c_str()) == 0);
  return ToText(ValueOf(ReadFile(out)));
}

TEST_CASE("writers: base64 and MD5 follow their RFCs") {
  CHECK(EncodeBase64({}) == "");
  CHECK(EncodeBase64(FromText("f")) == "Zg==");
  CHECK(EncodeBase64(FromText("fo")) == "Zm8=");
  CHECK(EncodeBase64(FromText("foobar")) == "Zm9vYmFy");
  CHECK(EncodeBase64({0xff, 0xef, 0xbe}) == "/+++");
  CHECK(Md5("") == "D41D8CD98F00B204E9800998ECF8427E");
  CHECK(Md5("abc") == "900150983CD24FB0D6963F7D28E17F72");
  std::string digits;
  for (int i = 0; i < 8; ++i) digits += "1234567890";
  CHECK(Md5(digits) == "57EDF4A22BE3C955AC49DA2E2107B67A");
}

TEST_CASE("writers: editing EXIF that is truncated or changed anywhere stays within its memory") {
  const Bytes whole = CameraExif(true);
  for (size_t size = 0; size < whole.size(); ++size) {
    const Bytes edited = EditedExif(Cut(whole, size), 1, 1);
    CHECK((edited.empty() || edited.size() > size));
  }
  for (size_t at = 0; at < whole.size(); ++at) {
    Bytes changed = whole;
    changed[at] = 0xff;
    // Any result is acceptable, provided that memory accesses are within bounds.
    EditedExif(changed, 1, 1);
  }
  CHECK(EditedExif(FromText("IM*\0\0\0\0\0"), 1, 1).empty());
}

TEST_CASE(
    "writers: a higher quality makes a larger JPEG, and kSmall a smaller PNG of equal pixels") {
  const Image image = Pattern(200, 150);
  size_t last = 0;
  for (const int quality : {10, 50, 89, 90, 100}) {
    CAPTURE(quality);
    const size_t size = ValueOf(EncodeJpeg("a.jpg", image, quality, {}, {})).size();
    CHECK(size > last);
    last = size;
  }
  if (!HasLibpng()) return;
  const Bytes quick = ValueOf(EncodePng("a.png", image, {}, PngSize::kQuick));
  const Bytes small = ValueOf(EncodePng("a.png", image, {}, PngSize::kSmall));
  CHECK(small.size() < quick.size());
  for (const Bytes* bytes : {&quick, &small}) {
    CHECK(ValueOf(DecodeImage("a.png", *bytes)).image.pixels == image.pixels);
  }
}

TEST_CASE("writers: EXIF and the profile are kept, and EXIF describes the written picture") {
  const bool asks = Has("exiftool");
  if (!asks) MESSAGE("SKIPPED: exiftool is absent");
  TempFolder folder;
  for (const bool little : {true, false}) {
    PictureOptions how = {95, {CameraExif(little), Profile(150000)}};
    // libpng rejects a profile whose compressed data are shorter than the longest keyword.
    for (size_t k = 132; k < 588; ++k) how.metadata.icc[k] = static_cast<uint8_t>(k * k >> 3);
    for (const std::string name : {"a.jpg", "a.png", "a.webp"}) {
      if (name == "a.webp" && WebpWriter::Check(name, 1, 1)) continue;
      if (name == "a.png" && !HasLibpng()) continue;
      CAPTURE(name);
      CAPTURE(little);
      const std::string path = folder.file(name);
      REQUIRE(WriteImage(path, Pattern(40, 30), how) == "");
      if (name != "a.jpg") {  // other functions read the metadata of photos
        const Metadata metadata = ValueOf(DecodeImage(name, ValueOf(ReadFile(path)))).metadata;
        CHECK(metadata.icc == how.metadata.icc);
        const std::string exif = ToText(metadata.exif);
        CHECK(exif.find(little ? "II" : "MM") == 0);
        CHECK(Contains(exif, "Holgaro"));
      }
      if (!asks) continue;
      const std::string tags = Ask(folder, "exiftool -s -s -n '" + path + "'");
      for (const char* tag : {"Software: starfocus 0.", "Make: Holgaro\n", "Orientation: 1\n",
                              "ExifImageWidth: 40\n", "ExifImageHeight: 30\n"}) {
        CHECK(Contains(tags, tag));
      }
      CHECK(!Contains(tags, "Compression: 6"));  // the thumbnail is removed
      CHECK(Ask(folder, "exiftool -b -icc_profile '" + path + "'").size() == 150000);
    }
  }
}

// Returns a PNG of one pixel with an additional chunk before its pixels.
Bytes PngWithChunk(const std::string& name, const std::string& content) {
  Bytes png = ValueOf(EncodePng("a.png", Pattern(1, 1), {}, PngSize::kQuick));
  const std::string chunk = photos::Chunk(name, content);
  png.insert(png.begin() + 33, chunk.begin(), chunk.end());
  return png;
}

TEST_CASE("writers: EXIF in a text chunk of a PNG, as ImageMagick writes it, is read") {
  if (!HasLibpng()) return;
  const Bytes exif = CameraExif(false);
  const std::string text = std::string("Exif\0\0", 6) + ToText(exif);
  std::string digits;
  for (size_t k = 0; k < text.size(); ++k) {
    constexpr char kDigits[] = "0123456789abcdef";
    if (k % 36 == 0) digits += '\n';
    digits += kDigits[static_cast<uint8_t>(text[k]) >> 4];
    digits += kDigits[static_cast<uint8_t>(text[k]) & 15];
  }
  for (const std::string type : {"exif", "APP1"}) {
    Bytes png = PngWithChunk("tEXt", "Raw profile type " + type + '\0' + "\n" + type + "\n     " +
                                         std::to_string(text.size()) + digits + "\n");
    CHECK(ValueOf(DecodeImage("a.png", png)).metadata.exif == exif);
  }
  for (const std::string content : {"Raw profile type exif", "", "\n", "\nexif\n 4\n4578", "xx"}) {
    Bytes png = PngWithChunk("zTXt", "Raw profile type exif" + std::string(2, '\0') + content);
    CHECK(ValueOf(DecodeImage("a.png", png)).metadata.exif.empty());
  }
}

TEST_CASE(
    "writers: a long profile is stored in segments numbered from 1, and long EXIF is omitted") {
  const std::string text =
      ToText(ValueOf(EncodeJpeg("a.jpg", Pattern(8, 8), 95, {{}, Profile(150000)}, {})));
  size_t at = 0;
  for (char number = 1; number <= 3; ++number) {
    at = text.find(std::string("ICC_PROFILE\0", 12) + number + '\3', at);
    REQUIRE(at != std::string::npos);
  }
  // EXIF too long for its segment is omitted, and the picture is written.
  Metadata metadata = {CameraExif(true), {}};
  metadata.exif.resize(70000);
  CHECK(ValueOf(EncodeJpeg("a.jpg", Pattern(8, 8), 95, metadata, {})).size() < 5000);
}

TEST_CASE("writers: grey levels above 255 are written with 16 bits") {
  GreyImage grey = {300, 2, std::vector<uint16_t>(600)};
  std::iota(grey.levels.begin(), grey.levels.end(), uint16_t{0});
  if (!HasLibpng()) {
    CHECK(Contains(EncodeGreyPng("a.png", grey), "libpng"));
    return;
  }
  Bytes png = ValueOf(EncodeGreyPng("a.png", grey));
  CHECK(ReadPngHeader(png)->depth == 16);
  CHECK(int{ValueOf(ReadBytes(png)).pixels[3 * 599]} == 599 >> 8);
  grey.levels.assign(600, 255);
  png = ValueOf(EncodeGreyPng("a.png", grey));
  CHECK(ReadPngHeader(png)->depth == 8);
}

TEST_CASE("writers: an animation shows its pictures in their order, and is rejected as a picture") {
  TempFolder folder;
  const std::string path = folder.file("a.webp");
  if (Error absent = WebpWriter::Check(path, 1, 1)) {
    CHECK(Contains(absent, "libwebp"));
    return;
  }
  CHECK(WebpWriter::Check(path, 16384, 1) != "");
  WebpWriter writer(path, 90);
  for (int level : {10, 120, 240}) {
    CHECK(writer.Add(photos::Plain(32, 20, level)) == "");
  }
  WebpWriter other(path, 90);
  CHECK(other.Add(Image(32, 20)) == "");
  CHECK(other.Add(Image(31, 20)) != "");
  const Bytes bytes = ValueOf(writer.Finish({}));
  CHECK(Contains(ReadBytes(bytes), "animation"));
  REQUIRE(WriteFile(path, bytes) == "");
  if (!Has("webpinfo")) {
    MESSAGE("SKIPPED: webpinfo is absent");
    return;
  }
  const std::string said = Ask(folder, "webpinfo '" + path + "'");
  CHECK(Contains(said, "No error detected"));
  CHECK(Count(said, "Chunk ANMF") == 3);
  CHECK(Count(said, "Duration: 100\n") == 3);
}

TEST_CASE(
    "writers: a depth photo holds the map and the sharp original, and exiftool can read them") {
  TempFolder folder;
  const Image picture = Pattern(400, 300);
  FloatMap map = {400, 300, std::vector<float>(120000)};
  for (size_t i = 0; i < map.values.size(); ++i) {
    map.values[i] = -3 + 8 * static_cast<float>((i * 7919) % 120000) / 119999;
  }
  const SharpOriginal photo = {&picture, &map, 2, 0.5};
  const Bytes jpeg = ValueOf(EncodeDepthPhoto("a.jpg", picture, photo, 95, {}));
  REQUIRE(WriteFile(folder.file("a.jpg"), jpeg) == "");
  CHECK(ReadImage(folder.file("a.jpg")) == "");
  const std::string text = ToText(jpeg);
  CHECK(text.find("RangeInverse") < text.find("http://ns.adobe.com/xmp/extension/"));
  if (!Has("exiftool")) {
    MESSAGE("SKIPPED: exiftool is absent");
    return;
  }
  const std::string file = "'" + folder.file("a.jpg") + "'";
  const std::string tags = Ask(folder, "exiftool -s -s -G1 -n " + file);
  CHECK(Contains(tags, "Far: 1\n"));
  CHECK(Contains(tags, "Near: 0.11111"));             // The expected value is 1 / (8 + 1).
  CHECK(Contains(tags, "FocalDistance: 0.166666"));   // The expected value is 1 / (2 + 3 + 1).
  CHECK(Contains(tags, "BlurAtInfinity: 0.0075\n"));  // The expected value is 0.5 * 6 / 400.
  const std::string png = Ask(folder, "exiftool -b -XMP-GDepth:DepthImage " + file);
  const std::string sharp = Ask(folder, "exiftool -b -XMP-GImage:ImageData " + file);
  CHECK(ReadBytes(FromText(sharp)) == "");
  const Image depth = ValueOf(ReadBytes(FromText(png)));
  REQUIRE(depth.pixels.size() == 3 * map.values.size());
  for (size_t i = 0; i < map.values.size(); ++i) {
    const double level = 255 * (5 - double(map.values[i])) / 8;
    if (std::fabs(level - depth.pixels[3 * i]) > 0.51) FAIL("level of pixel " << i);
  }
  CHECK(Ask(folder, "exiftool -validate -warning -s3 " + file).find("OK") == 0);
}

}  // namespace
}  // namespace starfocus::image_files_test
