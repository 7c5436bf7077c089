// SPDX-License-Identifier: Apache-2.0
#include "platform/image_io.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "platform/container.h"
#include "platform/writers/webp.h"
#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"
#include "tests/support/temp_folder.h"

namespace starfocus::image_io_test {
namespace {

Image Pattern(int width, int height) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<uint8_t>(i * 37 + i / 7);
  }
  return image;
}

Bytes FromText(const std::string& text) { return Bytes(text.begin(), text.end()); }

// Reads `bytes` as a picture.
Result<Image> ReadBytes(const Bytes& bytes) {
  TempFolder folder;
  const std::string path = folder.file("picture");
  REQUIRE(WriteFile(path, bytes) == "");
  return ReadImage(path);
}

TEST_CASE("image_io: PNG and PPM are read back exactly at any size") {
  TempFolder folder;
  for (const char* extension : {".png", ".ppm", ".PNG"}) {
    for (int width : {1, 2, 3, 17, 64}) {
      for (int height : {1, 5, 31}) {
        CAPTURE(extension);
        const std::string path = folder.file(std::string("a") + extension);
        const Image image = Pattern(width, height);
        REQUIRE(WriteImage(path, image) == "");
        Image back = ValueOf(ReadImage(path));
        CHECK(back.width == width);
        CHECK(back.height == height);
        CHECK(back.pixels == image.pixels);
      }
    }
  }
  CHECK(folder.count() == 3);  // no temporary file is left
}

TEST_CASE("image_io: JPEG is read back with small differences") {
  TempFolder folder;
  Image image(40, 24);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 120; ++x) image.row(y)[x] = static_cast<uint8_t>(40 + x + y);
  }
  REQUIRE(WriteImage(folder.file("a.jpg"), image) == "");
  Image back = ValueOf(ReadImage(folder.file("a.jpg")));
  REQUIRE(back.pixels.size() == image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    CHECK(std::abs(int{back.pixels[i]} - int{image.pixels[i]}) <= 8);
  }
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
  const std::string bad[] = {"",
                             "P",
                             "P6",
                             "P6 2 2 255\nabc",
                             "P6 0 1 255\n",
                             "P6 -1 1 255\n",
                             "P6 70000 1 255\n",
                             "P6 1 1 0\nabc",
                             "P6 1 1 70000\nabc",
                             "P3 1 1 255\n1 2 3",
                             "garbage",
                             "\x89PNG\r\n\x1a\n",
                             "\xff\xd8\xff"};
  for (const std::string& text : bad) {
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
  const Bytes bytes = ValueOf(ReadFile(folder.file(name)));
  Image image = ValueOf(ReadBytes(bytes));
  return bytes;
}

// Returns the position of a marker in a JPEG file.
Bytes::iterator FindMarker(uint8_t marker, Bytes* jpeg) {
  const uint8_t bytes[] = {0xff, marker};
  const auto at = std::search(jpeg->begin(), jpeg->end(), bytes, bytes + 2);
  REQUIRE(at != jpeg->end());
  return at;
}

TEST_CASE("image_io: PNG and JPEG that are truncated at any length are rejected") {
  for (const char* name : {"a.png", "a.jpg"}) {
    const Bytes bytes = Written(name);
    for (size_t size = 0; size + 20 < bytes.size(); size += 13) {
      CAPTURE(name);
      CAPTURE(size);
      CHECK(ReadBytes(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size))) != "");
    }
  }
}

TEST_CASE("image_io: a PNG with any byte changed is rejected") {
  const Bytes bytes = Written("a.png");
  for (size_t at = 0; at < bytes.size(); ++at) {
    CAPTURE(at);
    Bytes changed = bytes;
    changed[at] ^= 0x10;
    CHECK(ReadBytes(changed) != "");
  }
}

TEST_CASE("image_io: a PNG chunk longer than its file is rejected before it is read") {
  Bytes bytes = Written("a.png");
  bytes[33] = 0x67;  // sets the length of the first chunk after the header to 1.7 GB
  CHECK(Contains(ReadBytes(bytes), "truncated"));
}

TEST_CASE("image_io: a JPEG too short for its size is rejected before it is decoded") {
  Bytes bytes = Written("a.jpg");
  const auto at = FindMarker(0xc0, &bytes);
  for (int k = 5; k < 9; ++k) at[k] = 0x3f;  // height and width
  CHECK(Contains(ReadBytes(bytes), "truncated"));
}

TEST_CASE("image_io: a JPEG table that is too short for its number of codes is rejected") {
  Bytes bytes = Written("a.jpg");
  const auto table = FindMarker(0xc4, &bytes);
  REQUIRE(bytes.end() - table > 4 + 17);
  std::fill_n(table + 4 + 1, 16, uint8_t{17});
  const auto names_table = [](const Bytes& broken) {
    const Result<Image> read = ReadBytes(broken);  // the error is from libjpeg-turbo or stb_image
    return Contains(read, "Huffman table") || Contains(read, "code table");
  };
  CHECK(names_table(bytes));
  // stb_image skips repeated 0xff bytes.
  bytes.insert(table, 3, 0xff);
  CHECK(names_table(bytes));
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

TEST_CASE("image_io: no file remains if an output cannot be written") {
  TempFolder folder;
  const Image image = Pattern(3, 3);
  CHECK(Contains(WriteImage(folder.file("a.bmp"), image), ".bmp"));
  CHECK(Contains(WriteImage(folder.file("a"), image), "no extension"));
  CHECK(WriteImage(folder.file("none/a.png"), image) != "");
  std::filesystem::create_directory(folder.file("folder.png"));
  CHECK(WriteImage(folder.file("folder.png"), image) != "");
  CHECK(folder.count() == 1);
  CHECK(CheckImageOutput(folder.file("a.gif")) != "");
  CHECK(CheckImageOutput(folder.file("none/a.png")) != "");
  CHECK(CheckImageOutput(folder.file("folder.png")) != "");
  CHECK(CheckImageOutput(folder.file("a.jpeg")) == "");
  CHECK(CheckImageOutput("a.PPM") == "");
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
      Bytes row(size_t(per_byte == 8 ? 1 : 8 / per_byte), 0);
      for (int x = 0; x < 8; ++x) {
        const int index = x == 7 ? last : x % colours;
        row[size_t(x / per_byte)] |= uint8_t(index << (8 - depth - x % per_byte * depth));
      }
      const Result<Image> read = ReadBytes(MakePng(8, 1, {depth, 3}, palette, row));
      if (last >= 3) {
        CHECK(Contains(read, "palette indices below 3, found " + std::to_string(last)));
        continue;
      }
      const Image image = ValueOf(read);
      REQUIRE(image.width == 8);
      for (int x = 0; x < 8; ++x) {
        const int index = x == 7 ? last : x % colours;
        for (int c = 0; c < 3; ++c) {
          CHECK(image.row(0)[3 * x + c] == palette[size_t(3 * index + c)]);
        }
      }
    }
  }
  CHECK(ReadBytes(MakePng(8, 1, {8, 3}, {}, Bytes(8))) != "");        // The palette is missing.
  CHECK(ReadBytes(MakePng(8, 1, {8, 3}, Bytes(7), Bytes(8))) != "");  // One colour is incomplete.
  CHECK(ReadBytes(MakePng(4, 1, {16, 3}, palette, Bytes(8))) != "");  // Indices have 16 bits.
  CHECK(ValueOf(ReadBytes(MakePng(8, 1, {8, 0}, {}, Bytes(8, 99)))).pixels == Bytes(24, 99));
}

TEST_CASE("image_io: bytes after the end of a PNG file are ignored") {
  const Bytes palette = {10, 20, 30, 40, 50, 60, 70, 80, 90};
  Bytes png = MakePng(8, 1, {8, 3}, palette, Bytes(8, 1));
  // Appends another palette and the start of a chunk of 1000 bytes.
  const std::string more = photos::Chunk("PLTE", std::string(9, '\xc8')) + photos::Big(1000, 4) +
                           "PLTE" + std::string(4, '\0');
  png.insert(png.end(), more.begin(), more.end());
  Image image = ValueOf(ReadBytes(png));
  CHECK(std::equal(&palette[3], &palette[6], image.row(0)));
}

TEST_CASE(
    "image_io: the error for a picture too large for its format states the size of the picture") {
  const struct {
    uint32_t width, height;
    const char* expected;
  } sizes[] = {{65536, 1, "1 to 65535, found 65536x1"},
               {1, 0x7fffffff, "1 to 65535, found 1x2147483647"},
               {20000, 20000, "2^28 pixels, found 20000x20000"},
               {65535, 65535, "2^28 pixels, found 65535x65535"}};
  for (const auto& size : sizes) {
    const Bytes png = MakePng(size.width, size.height, {8, 0}, {}, Bytes(8));
    CHECK(Contains(ReadBytes(png), size.expected));
  }
  // The encoders count bytes in an int. A larger picture would overflow the count, and the encoder
  // would write out of bounds.
  TempFolder folder;
  Image large;
  large.width = large.height = 40000;
  for (const char* name : {"a.png", "a.jpg"}) {
    CHECK(Contains(WriteImage(folder.file(name), large), "40000x40000"));
  }
  CHECK(folder.count() == 0);
}

// Returns a seed file of the fuzz targets: 24x16 pixels, red 40 + 7 x, green 60 + 8 y, blue 128.
Bytes Seed(const std::string& name) {
  return ValueOf(ReadFile(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/photo/" + name));
}

// Returns the largest difference from the seed picture, whose light is scaled by `share`.
int DifferenceFromSeed(const Image& image, double share) {
  REQUIRE(image.width == 24);
  REQUIRE(image.height == 16);
  int most = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 24; ++x) {
      const int right[] = {40 + 7 * x, 60 + 8 * y, 128};
      for (int c = 0; c < 3; ++c) {
        const int wanted = static_cast<int>(std::lround(right[c] * share));
        most = std::max(most, std::abs(image.row(y)[3 * x + c] - wanted));
      }
    }
  }
  return most;
}

// Returns true if the build has libjpeg-turbo. stb_image does not read arithmetic coding.
bool HasLibjpeg() { return bool(DecodeImage("arithmetic.jpg", Seed("arithmetic.jpg"))); }

TEST_CASE("image_io: JPEG of every kind that libjpeg-turbo reads has the right colours") {
  if (!HasLibjpeg()) return;
  for (const char* name : {"arithmetic.jpg", "progressive.jpg", "restart.jpg", "cmyk.jpg",
                           "cmyk_adobe.jpg", "ycck.jpg"}) {
    CAPTURE(name);
    Image image = ValueOf(ReadBytes(Seed(name)));
    // The black channel, if present, is 200 everywhere. Adobe stores inverted values: 255 is no
    // ink.
    const bool black = name[0] == 'c' || name[0] == 'y';
    CHECK(DifferenceFromSeed(image, black ? 200 / 255.0 : 1) <= 6);
  }
}

TEST_CASE("image_io: bytes between the parts of a JPEG are ignored") {
  if (!HasLibjpeg()) return;
  Bytes bytes = Seed("restart.jpg");
  const Bytes junk = {0xff, 0xd1, 0x55, 0x55, 0x55};
  bytes.insert(bytes.end() - 2, junk.begin(), junk.end());
  CHECK(DifferenceFromSeed(ValueOf(ReadBytes(bytes)), 1) <= 6);
  bytes.insert(bytes.end(), 100, 0xff);  // after its end
  CHECK(ReadBytes(bytes) == "");
}

TEST_CASE("image_io: a JPEG of more than 500 scans is rejected") {
  if (!HasLibjpeg()) return;
  const Bytes seed = Seed("progressive.jpg");
  const auto find = [&](uint8_t marker, size_t from) {
    const uint8_t bytes[] = {0xff, marker};
    return std::search(seed.begin() + ptrdiff_t(from), seed.end(), bytes, bytes + 2);
  };
  const auto scan = find(0xda, 0), next = find(0xc4, size_t(scan - seed.begin()));
  REQUIRE(next != seed.end());
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
  Image image = ValueOf(ReadBytes(Seed("interlaced16.png")));
  CHECK(DifferenceFromSeed(image, 1) == 0);
}

TEST_CASE("image_io: lossy and lossless WebP is read, and truncated WebP is rejected") {
  if (WebpWriter::Check("", 1, 1)) {
    CHECK(Contains(ReadBytes(Seed("lossless.webp")), "libwebp"));
    return;
  }
  CHECK(DifferenceFromSeed(ValueOf(ReadBytes(Seed("lossless.webp"))), 1) == 0);
  CHECK(DifferenceFromSeed(ValueOf(ReadBytes(Seed("lossy.webp"))), 1) <= 12);
  const Bytes whole = Seed("lossy.webp");
  for (size_t size = 12; size < whole.size(); ++size) {
    CAPTURE(size);
    const Bytes cut(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size));
    CHECK(Contains(ReadBytes(cut), "truncated"));
  }
}

TEST_CASE("image_io: an animation is rejected, and the error says that the file is an animation") {
  if (WebpWriter::Check("", 1, 1)) return;
  WebpWriter writer("a.webp", 90);
  Image image(32, 20);
  REQUIRE(writer.Add(image) == "");
  std::fill(image.pixels.begin(), image.pixels.end(), uint8_t{200});
  REQUIRE(writer.Add(image) == "");
  Bytes bytes = ValueOf(writer.Finish({}));
  CHECK(Contains(ReadBytes(bytes), "animation"));
}

}  // namespace
}  // namespace starfocus::image_io_test
