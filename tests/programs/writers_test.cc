// SPDX-License-Identifier: Apache-2.0
// Tests the files that the writers of platform/writers/ make. exiftool and webpinfo, if installed,
// read the files.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>

#include "platform/base64.h"
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

namespace starfocus::writers_test {
namespace {

Bytes FromText(const std::string& text) { return Bytes(text.begin(), text.end()); }

Image Ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.row(y)[3 * x] = static_cast<uint8_t>(255 * x / width);
      image.row(y)[3 * x + 1] = static_cast<uint8_t>(255 * y / height);
      image.row(y)[3 * x + 2] = static_cast<uint8_t>((x * 31 + y * 17) % 256);
    }
  }
  return image;
}

// A TIFF structure in either byte order.
class TiffBuilder {
 public:
  explicit TiffBuilder(bool little) : little_(little) {
    bytes = FromText(little ? "II" : "MM");
    Put(42, 2);
    Put(8, 4);
  }
  void Put(uint32_t value, int size) {
    for (int i = 0; i < size; ++i) {
      bytes.push_back(static_cast<uint8_t>(value >> (8 * (little_ ? i : size - 1 - i))));
    }
  }
  void Entry(uint32_t tag, uint32_t type, uint32_t count, uint32_t value) {
    Put(tag, 2);
    Put(type, 2);
    Put(count, 4);
    Put(value, type == 3 ? 2 : 4);
    if (type == 3) Put(0, 2);
  }
  Bytes bytes;

 private:
  const bool little_;
};

// Returns the EXIF of a camera that was held upright: the make, orientation 6, sizes in a separate
// directory, and a thumbnail.
Bytes CameraExif(bool little) {
  TiffBuilder tiff(little);
  tiff.Put(3, 2);                            // Number of entries of the directory at offset 8.
  tiff.Entry(0x010f, 2, 8, 8 + 2 + 36 + 4);  // Make.
  tiff.Entry(0x0112, 3, 1, 6);               // Orientation.
  tiff.Entry(0x8769, 4, 1, 58);              // Directory of sizes.
  tiff.Put(58 + 2 + 24 + 4, 4);              // Directory of the thumbnail.
  for (const char c : std::string("Holgaro")) tiff.bytes.push_back(static_cast<uint8_t>(c));
  tiff.bytes.push_back(0);
  tiff.Put(2, 2);  // at offset 58
  tiff.Entry(0xa002, 4, 1, 4000);
  tiff.Entry(0xa003, 3, 1, 3000);
  tiff.Put(0, 4);
  tiff.Put(1, 2);
  tiff.Entry(0x0103, 3, 1, 6);
  tiff.Put(0, 4);
  return tiff.bytes;
}

Bytes Profile(size_t size) { return FromText(photos::Profile(size)); }

TEST_CASE("profiles: only complete RGB profiles are accepted") {
  const auto changed = [](size_t at, uint8_t value) {
    Bytes icc = Profile(200);
    icc[at] = value;
    return icc;
  };
  CHECK(IsRgbProfile(Profile(132)));
  CHECK(IsRgbProfile(Profile(150000)));
  for (const char* space : {"GRAY", "CMYK", "Lab ", "XYZ "}) {
    CHECK_FALSE(IsRgbProfile(FromText(photos::Profile(200, space))));
  }
  for (const size_t size : {size_t{0}, size_t{3}, size_t{131}, size_t{199}, size_t{201}}) {
    Bytes icc = Profile(200);
    icc.resize(size);
    CHECK_FALSE(IsRgbProfile(icc));
  }
  CHECK_FALSE(IsRgbProfile(changed(36, 'x')));
  // The 6 tags require 132 + 6 * 12 bytes, which is more than the profile has.
  CHECK_FALSE(IsRgbProfile(changed(131, 6)));
  Bytes tagged = changed(131, 1);
  std::fill(tagged.begin() + 132, tagged.end(), uint8_t{0});
  tagged[132 + 7] = 190, tagged[132 + 11] = 10;  // the data of the tag are 10 bytes from offset 190
  CHECK(IsRgbProfile(tagged));
  ++tagged[132 + 11];
  CHECK_FALSE(IsRgbProfile(tagged));
  tagged[132 + 4] = 0xff;
  CHECK_FALSE(IsRgbProfile(tagged));
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
  const Bytes bytes = ValueOf(ReadFile(out));
  return std::string(bytes.begin(), bytes.end());
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
    const Bytes cut(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size));
    const Bytes edited = EditedExif(cut, 1, 1);
    CHECK((edited.empty() || edited.size() > cut.size()));
  }
  for (size_t at = 0; at < whole.size(); ++at) {
    Bytes changed = whole;
    changed[at] = 0xff;
    // Any result is acceptable, provided that memory accesses are within bounds.
    EditedExif(changed, 1, 1);
  }
  const Bytes none = FromText("IM*\0\0\0\0\0");
  CHECK(EditedExif(none, 1, 1).empty());
}

TEST_CASE("writers: a higher quality makes a larger JPEG") {
  const Image image = Ramp(64, 48);
  size_t last = 0;
  for (const int quality : {10, 50, 89, 90, 100}) {
    CAPTURE(quality);
    Bytes jpeg = ValueOf(EncodeJpeg("a.jpg", image, quality, {}, {}));
    CHECK(jpeg.size() > last);
    last = jpeg.size();
  }
}

TEST_CASE("writers: EXIF and the profile are kept, and EXIF describes the written picture") {
  if (!Has("exiftool")) {
    MESSAGE("SKIPPED: exiftool is absent");
    return;
  }
  TempFolder folder;
  for (const bool little : {true, false}) {
    const PictureOptions how = {95, {CameraExif(little), Profile(150000)}};
    for (const std::string name : {"a.jpg", "a.png", "a.webp"}) {
      if (name == "a.webp" && WebpWriter::Check(name, 1, 1)) continue;
      if (name == "a.png" && !HasLibpng()) continue;
      CAPTURE(name);
      CAPTURE(little);
      const std::string path = folder.file(name);
      REQUIRE(WriteImage(path, Ramp(40, 30), how) == "");
      const std::string tags = Ask(folder, "exiftool -s -s -n '" + path + "'");
      CHECK(Contains(tags, "Software: starfocus 0."));
      CHECK(Contains(tags, "Make: Holgaro\n"));
      CHECK(Contains(tags, "Orientation: 1\n"));
      CHECK(Contains(tags, "ExifImageWidth: 40\n"));
      CHECK(Contains(tags, "ExifImageHeight: 30\n"));
      CHECK(!Contains(tags, "Compression: 6"));  // the thumbnail is removed
      CHECK(Ask(folder, "exiftool -b -icc_profile '" + path + "'").size() == 150000);
    }
  }
}

TEST_CASE("writers: metadata of PNG and WebP files can be read again") {
  TempFolder folder;
  PictureOptions how = {95, {CameraExif(true), Profile(588)}, PngSize::kQuick};
  // libpng rejects a profile whose compressed data are shorter than the longest keyword.
  for (size_t k = 132; k < 588; ++k) how.metadata.icc[k] = static_cast<uint8_t>(k * k >> 3);
  for (const std::string name : {"a.png", "a.webp"}) {
    if (name == "a.webp" && WebpWriter::Check(name, 1, 1)) continue;
    if (name == "a.png" && !HasLibpng()) continue;
    CAPTURE(name);
    REQUIRE(WriteImage(folder.file(name), Ramp(40, 30), how) == "");
    Bytes bytes = ValueOf(ReadFile(folder.file(name)));
    const Metadata metadata = ValueOf(DecodeImage(name, bytes)).metadata;
    CHECK(metadata.icc == how.metadata.icc);
    const std::string exif(metadata.exif.begin(), metadata.exif.end());
    CHECK(exif.find("II") == 0);
    CHECK(Contains(exif, "Holgaro"));
  }
}

TEST_CASE("writers: PngSize::kSmall makes smaller PNG files than kQuick, with the same pixels") {
  if (!HasLibpng()) return;
  const Image image = Ramp(200, 150);
  const Bytes quick = ValueOf(EncodePng("a.png", image, {}, PngSize::kQuick));
  const Bytes small = ValueOf(EncodePng("a.png", image, {}, PngSize::kSmall));
  CHECK(small.size() < quick.size());
  for (const Bytes* bytes : {&quick, &small}) {
    CHECK(ValueOf(DecodeImage("a.png", *bytes)).image.pixels == image.pixels);
  }
}

// Returns a PNG of one pixel with an additional chunk before its pixels.
Bytes PngWithChunk(const std::string& name, const std::string& content) {
  Bytes png = ValueOf(EncodePng("a.png", Ramp(1, 1), {}, PngSize::kQuick));
  const std::string chunk = photos::Chunk(name, content);
  png.insert(png.begin() + 33, chunk.begin(), chunk.end());
  return png;
}

TEST_CASE("writers: EXIF in a text chunk of a PNG, as ImageMagick writes it, is read") {
  if (!HasLibpng()) return;
  const Bytes exif = CameraExif(false);
  std::string digits, text = "Exif";
  text += std::string(2, '\0');
  text.append(exif.begin(), exif.end());
  for (size_t k = 0; k < text.size(); ++k) {
    constexpr char kDigits[] = "0123456789abcdef";
    if (k % 36 == 0) digits += '\n';
    digits += kDigits[static_cast<uint8_t>(text[k]) >> 4];
    digits += kDigits[static_cast<uint8_t>(text[k]) & 15];
  }
  for (const std::string type : {"exif", "APP1"}) {
    Bytes png = PngWithChunk("tEXt", "Raw profile type " + type + '\0' + "\n" + type + "\n     " +
                                         std::to_string(text.size()) + digits + "\n");
    const Metadata metadata = ValueOf(DecodeImage("a.png", png)).metadata;
    CHECK(metadata.exif == exif);
  }
  for (const std::string content : {"Raw profile type exif", "", "\n", "\nexif\n 4\n4578", "xx"}) {
    Bytes png = PngWithChunk("zTXt", "Raw profile type exif" + std::string(2, '\0') + content);
    const Metadata metadata = ValueOf(DecodeImage("a.png", png)).metadata;
    CHECK(metadata.exif.empty());
  }
}

TEST_CASE("writers: a long profile is stored in segments numbered from 1") {
  Bytes jpeg = ValueOf(EncodeJpeg("a.jpg", Ramp(8, 8), 95, {{}, Profile(150000)}, {}));
  const std::string text(jpeg.begin(), jpeg.end());
  size_t last = 0;
  for (char number = 1; number <= 3; ++number) {
    const std::string header = std::string("ICC_PROFILE\0", 12) + number + '\3';
    const size_t at = text.find(header);
    REQUIRE(at != std::string::npos);
    CHECK(at > last);
    last = at;
  }
}

TEST_CASE("writers: EXIF too long for its segment is omitted, and the picture is written") {
  Metadata metadata = {CameraExif(true), {}};
  metadata.exif.resize(70000);
  Bytes jpeg = ValueOf(EncodeJpeg("a.jpg", Ramp(8, 8), 95, metadata, {}));
  CHECK(jpeg.size() < 5000);
}

TEST_CASE("writers: grey levels above 255 are written with 16 bits") {
  TempFolder folder;
  GreyImage grey = {300, 2, std::vector<uint16_t>(600)};
  std::iota(grey.levels.begin(), grey.levels.end(), uint16_t{0});
  if (!HasLibpng()) {
    CHECK(Contains(EncodeGreyPng("a.png", grey), "libpng"));
    return;
  }
  Bytes png = ValueOf(EncodeGreyPng("a.png", grey));
  CHECK(ReadPngHeader(png)->depth == 16);
  Image back;
  REQUIRE(WriteFile(folder.file("a.png"), png) == "");
  back = ValueOf(ReadImage(folder.file("a.png")));
  CHECK(int{back.pixels[3 * 599]} == 599 >> 8);
  grey.levels.assign(600, 255);
  png = ValueOf(EncodeGreyPng("a.png", grey));
  CHECK(ReadPngHeader(png)->depth == 8);
}

TEST_CASE("writers: an animation shows its pictures in their order") {
  TempFolder folder;
  const std::string path = folder.file("a.webp");
  if (Error absent = WebpWriter::Check(path, 1, 1)) {
    CHECK(Contains(absent, "libwebp"));
    return;
  }
  CHECK(WebpWriter::Check(path, 16384, 1) != "");
  WebpWriter writer(path, 90);
  for (int level : {10, 120, 240}) {
    Image picture(32, 20);
    std::fill(picture.pixels.begin(), picture.pixels.end(), static_cast<uint8_t>(level));
    CHECK(writer.Add(picture) == "");
  }
  WebpWriter other(path, 90);
  CHECK(other.Add(Image(32, 20)) == "");
  CHECK(other.Add(Image(31, 20)) != "");
  Bytes bytes = ValueOf(writer.Finish({}));
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
  const Image picture = Ramp(400, 300), before = Ramp(400, 300);
  FloatMap map = {400, 300, std::vector<float>(120000)};
  for (size_t i = 0; i < map.values.size(); ++i) {
    map.values[i] = -3 + 8 * static_cast<float>((i * 7919) % 120000) / 119999;
  }
  const SharpOriginal photo = {&before, &map, 2, 0.5};
  const Bytes jpeg = ValueOf(EncodeDepthPhoto("a.jpg", picture, photo, 95, {}));
  REQUIRE(WriteFile(folder.file("a.jpg"), jpeg) == "");
  Image back = ValueOf(ReadImage(folder.file("a.jpg")));
  const std::string text(jpeg.begin(), jpeg.end());
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
  REQUIRE(WriteFile(folder.file("d.png"), FromText(png)) == "");
  back = ValueOf(ReadImage(folder.file("d.png")));
  REQUIRE(back.pixels.size() == 3 * map.values.size());
  for (size_t i = 0; i < map.values.size(); ++i) {
    const double level = 255 * (5 - double(map.values[i])) / 8;
    if (std::fabs(level - back.pixels[3 * i]) > 0.51) FAIL("level of pixel " << i);
  }
  REQUIRE(WriteFile(folder.file("s.jpg"), FromText(sharp)) == "");
  back = ValueOf(ReadImage(folder.file("s.jpg")));
  CHECK(Ask(folder, "exiftool -validate -warning -s3 " + file).find("OK") == 0);
}

}  // namespace
}  // namespace starfocus::writers_test
