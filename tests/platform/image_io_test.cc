#include "platform/image_io.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/temp_folder.h"

namespace starfocus {
namespace {

Image Pattern(int width, int height) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<uint8_t>(i * 37 + i / 7);
  }
  return image;
}

Bytes FromText(const std::string& text) { return Bytes(text.begin(), text.end()); }

// Reads `bytes` as a picture; returns the error.
std::string ReadBytes(const Bytes& bytes, Image* image) {
  TempFolder folder;
  const std::string path = folder.file("picture");
  REQUIRE(WriteFile(path, bytes) == "");
  return ReadImage(path, image);
}

TEST_CASE("image_io: PNG and PPM come back exactly, at any size") {
  TempFolder folder;
  for (const char* extension : {".png", ".ppm", ".PNG"}) {
    for (int width : {1, 2, 3, 17, 64}) {
      for (int height : {1, 5, 31}) {
        CAPTURE(extension);
        const std::string path = folder.file(std::string("a") + extension);
        const Image image = Pattern(width, height);
        REQUIRE(WriteImage(path, image) == "");
        Image back;
        REQUIRE(ReadImage(path, &back) == "");
        CHECK(back.width == width);
        CHECK(back.height == height);
        CHECK(back.pixels == image.pixels);
      }
    }
  }
  CHECK(folder.count() == 3);  // no temporary file stays
}

TEST_CASE("image_io: JPEG comes back nearly") {
  TempFolder folder;
  Image image(40, 24);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 120; ++x) image.row(y)[x] = static_cast<uint8_t>(40 + x + y);
  }
  REQUIRE(WriteImage(folder.file("a.jpg"), image) == "");
  Image back;
  REQUIRE(ReadImage(folder.file("a.jpg"), &back) == "");
  REQUIRE(back.pixels.size() == image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    CHECK(std::abs(int{back.pixels[i]} - int{image.pixels[i]}) <= 8);
  }
}

TEST_CASE("image_io: PPM header variants") {
  Image image;
  CHECK(ReadBytes(FromText("P6 # comment\n1\t1\n255\nabc"), &image) == "");
  CHECK(image.pixels == FromText("abc"));
  CHECK(ReadBytes(FromText("P5 2 1 100 \x32\x64"), &image) == "");
  CHECK(image.pixels == Bytes{128, 128, 128, 255, 255, 255});
  Bytes wide = FromText("P6 1 1 65535\n");
  for (int value : {0xff, 0xff, 0x80, 0x00, 0x00, 0x00}) wide.push_back(uint8_t(value));
  CHECK(ReadBytes(wide, &image) == "");
  CHECK(image.pixels == Bytes{255, 128, 0});
}

TEST_CASE("image_io: broken files are one-line errors") {
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
    Image image = Pattern(2, 2);
    const std::string error = ReadBytes(FromText(text), &image);
    CHECK(error.find(": expected ") != std::string::npos);
    CHECK(error.find(", found ") != std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
    CHECK(image.width == 2);  // untouched
  }
}

// A picture of 24x18, written as the name's extension says.
Bytes Written(const std::string& name) {
  TempFolder folder;
  REQUIRE(WriteImage(folder.file(name), Pattern(24, 18)) == "");
  Bytes bytes;
  REQUIRE(ReadFile(folder.file(name), &bytes) == "");
  Image image;
  REQUIRE(ReadBytes(bytes, &image) == "");
  return bytes;
}

TEST_CASE("image_io: truncated PNG and JPEG are refused at every length") {
  for (const char* name : {"a.png", "a.jpg"}) {
    const Bytes bytes = Written(name);
    for (size_t size = 0; size + 20 < bytes.size(); size += 13) {
      CAPTURE(name);
      CAPTURE(size);
      Image image;
      CHECK(ReadBytes(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size)), &image) != "");
    }
  }
}

TEST_CASE("image_io: a PNG with any byte changed is refused") {
  const Bytes bytes = Written("a.png");
  for (size_t at = 0; at < bytes.size(); ++at) {
    CAPTURE(at);
    Bytes changed = bytes;
    changed[at] ^= 0x10;
    Image image;
    CHECK(ReadBytes(changed, &image) != "");
  }
}

TEST_CASE("image_io: a PNG chunk longer than its file is refused before it is read") {
  Bytes bytes = Written("a.png");
  Image image;
  bytes[33] = 0x67;  // the length of the chunk behind the header: 1.7 GB
  CHECK(ReadBytes(bytes, &image).find("truncated") != std::string::npos);
}

TEST_CASE("image_io: a JPEG table of more codes than it has room for is refused") {
  Bytes bytes = Written("a.jpg");
  Image image;
  const uint8_t marker[] = {0xff, 0xc4};
  const auto table = std::search(bytes.begin(), bytes.end(), marker, marker + 2);
  REQUIRE(bytes.end() - table > 4 + 17);
  std::fill_n(table + 4 + 1, 16, uint8_t{17});
  CHECK(ReadBytes(bytes, &image).find("checksum or code table") != std::string::npos);
  // stb_image takes several 0xff for one.
  bytes.insert(table, 3, 0xff);
  CHECK(ReadBytes(bytes, &image).find("checksum or code table") != std::string::npos);
}

TEST_CASE("image_io: outputs that cannot be written leave nothing") {
  TempFolder folder;
  const Image image = Pattern(3, 3);
  CHECK(WriteImage(folder.file("a.bmp"), image).find(".bmp") != std::string::npos);
  CHECK(WriteImage(folder.file("a"), image).find("no extension") != std::string::npos);
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

TEST_CASE("file: a link stays a link") {
  TempFolder folder;
  REQUIRE(WriteFile(folder.file("real"), FromText("old")) == "");
  std::filesystem::create_symlink("real", folder.file("link"));
  REQUIRE(WriteFile(folder.file("link"), FromText("new")) == "");
  CHECK(std::filesystem::is_symlink(folder.file("link")));
  Bytes bytes;
  REQUIRE(ReadFile(folder.file("real"), &bytes) == "");
  CHECK(bytes == FromText("new"));
}

TEST_CASE("file: errors are one line") {
  CHECK(Expected("a\nb", "c", "d\te") == "a b: expected c, found d e");
  Bytes bytes;
  CHECK(ReadFile("/", &bytes) != "");
  CHECK(ReadFile("/no such file", &bytes) != "");
}

}  // namespace
}  // namespace starfocus
