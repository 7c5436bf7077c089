// SPDX-License-Identifier: Apache-2.0
// Tests the gain maps of new pictures, and the Ultra HDR files that store them. The suite exiftool
// validates a file, the suite python decodes files with ultra_hdr.py, and the suite data_sets tests
// a photograph of a phone.
#include "platform/writers/ultra_hdr.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "platform/decoders/jpeg.h"
#include "platform/deep_image.h"
#include "platform/gain_map.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/xmp.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::ultra_hdr_test {
namespace {

using namespace photos;

DeepImage Light(int width, int height) {
  DeepImage light(width, height, 3);
  light.is_half = true;
  return light;
}

// Returns light that changes smoothly from 0.01 to 8 along the diagonal, with a tint.
DeepImage SmoothLight(int width, int height) {
  DeepImage light = Light(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double place = (x + 0.5) / width * 0.6 + (y + 0.5) / height * 0.4;
      for (size_t c = 0; c < 3; ++c) {
        const double stops = -6.6 + 9.6 * place + 0.2 * (double(c) - 1) * std::sin(6 * place);
        light.row(y)[3 * size_t(x) + c] = HalfOfFloat(static_cast<float>(std::exp2(stops)));
      }
    }
  }
  return light;
}

// Returns the base picture of some light: it is compressed so that all light keeps its order.
Image BaseOf(const DeepImage& light) {
  Image base(light.width, light.height);
  for (size_t k = 0; k < light.samples.size(); ++k) {
    const double value = double{FloatOfHalf(light.samples[k])};
    const double shown = value * (1 + value / 64) / (1 + value);
    const double code =
        shown <= 0.0031308 ? shown * 12.92 : 1.055 * std::pow(shown, 1 / 2.4) - 0.055;
    base.pixels[k] = static_cast<uint8_t>(std::lround(255 * std::min(code, 1.0)));
  }
  return base;
}

// Code of SMPTE ST 2084 for light of which 1 has 203 cd/m2, white of ITU-R BT.2408.
double Pq(double light) {
  const double power = std::pow(light * 203 / 10000, 2610.0 / 16384);
  return std::pow((3424.0 / 4096 + 2413.0 / 128 * power) / (1 + 2392.0 / 128 * power), 2523.0 / 32);
}

// Returns a map without levels that limits no gain.
GainMap Like(int channels, double offset = 1.0 / 1024) {
  GainMap map;
  map.channels = channels;
  map.min.fill(-64);
  map.max.fill(64);
  map.offset_sdr.fill(offset);
  map.offset_hdr = map.offset_sdr;
  map.capacity_max = 3;
  return map;
}

struct Errors {
  double largest = 0;  // largest error in stops of light + 1/64
  double psnr = 0;     // of codes of PQ, in dB
};

Errors Compare(const DeepImage& a, const DeepImage& b) {
  REQUIRE(a.samples.size() == b.samples.size());
  Errors errors;
  double squares = 0;
  const size_t every = a.samples.size() > 1000000 ? 37 : 1;
  for (size_t k = 0; k < a.samples.size(); k += every) {
    const double x = double{FloatOfHalf(a.samples[k])}, y = double{FloatOfHalf(b.samples[k])};
    errors.largest =
        std::max(errors.largest, std::fabs(std::log2((x + 1.0 / 64) / (y + 1.0 / 64))));
    squares += std::pow(Pq(x) - Pq(y), 2);
  }
  errors.psnr = -10 * std::log10(squares * double(every) / double(a.samples.size()) + 1e-12);
  return errors;
}

Result<DepthPhoto> Decode(const Bytes& file) {
  return DecodeDepthPhoto("photo.jpg", {file.data(), file.size()}, true, Near::kUnknown);
}

TEST_CASE("gain maps: the map of a picture that a map made is that map") {
  const Image base = Noise(64, 48);
  for (const int step : {2, 4}) {
    for (const int channels : {1, 3}) {
      CAPTURE(step);
      CAPTURE(channels);
      GainMap map;
      map.width = 64 / step;
      map.height = 48 / step;
      map.channels = channels;
      map.max.fill(3);
      for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
          for (int c = 0; c < channels; ++c) {
            const double wave = std::sin(0.3 * x * (c + 1)) * std::cos(0.2 * y);
            map.levels.push_back(static_cast<uint16_t>(257 * std::lround(127.5 + 120 * wave)));
          }
        }
      }
      const DeepImage light = ApplyGainMap(base, map);
      const GainMap again = ComputeGainMap(base, light, step, map);
      REQUIRE(again.width == map.width);
      REQUIRE(again.channels == channels);
      CHECK(Compare(light, ApplyGainMap(base, again)).psnr > 50);
    }
  }
}

TEST_CASE("gain maps: no light is cut off, and small bright places get no dark rims") {
  const Image base = Plain(32, 24, 255);
  DeepImage light = Light(32, 24);
  std::fill(light.samples.begin(), light.samples.end(), HalfOfFloat(1));
  for (int y = 8; y < 12; ++y) {
    for (int k = 3 * 8; k < 3 * 12; ++k) light.row(y)[k] = HalfOfFloat(100);
  }
  const GainMap map = ComputeGainMap(base, light, 4, Like(1));
  CHECK(map.min[0] == doctest::Approx(0));
  CHECK(map.max[0] == doctest::Approx(std::log2((100 + 1.0 / 1024) / (1 + 1.0 / 1024))));
  CHECK(map.capacity_min == 0);
  CHECK(map.capacity_max == 3);
  const DeepImage result = ApplyGainMap(base, map);
  for (const uint16_t half : result.samples) CHECK(FloatOfHalf(half) > 0.99F);
}

TEST_CASE("gain maps: gains that rounding causes do not widen the range") {
  Image base = Plain(32, 24, 255);
  DeepImage light = Light(32, 24);
  std::fill(light.samples.begin(), light.samples.end(), HalfOfFloat(4));
  for (int y = 0; y < 4; ++y) {
    // Light of half a code where the code is 0: 7 stops at the offset 0.
    std::fill_n(base.row(y), 3 * 16, uint8_t{0});
    std::fill_n(light.row(y), 3 * 16, HalfOfFloat(0.002F));
  }
  GainMap given = Like(1, 0);
  given.min.fill(0);
  given.max.fill(2.5);
  const GainMap map = ComputeGainMap(base, light, 4, given);
  CHECK(map.min[0] == doctest::Approx(2));
  CHECK(map.max[0] == 2.5);
  // Gains of different offsets have no such limit.
  given.offset_hdr.fill(1.0 / 1024);
  CHECK(ComputeGainMap(base, light, 4, given).max[0] > 2.6);
}

TEST_CASE("gain maps: pictures without a gain and with damaged light have valid maps") {
  const Image base = Ramp(7, 5);
  DeepImage light = Light(7, 5);
  for (const uint16_t half : {0x0000, 0x7c00, 0x7e00, 0xfe00, 0x8001, 0x3c00}) {
    std::fill(light.samples.begin(), light.samples.end(), half);
    for (const int channels : {1, 3}) {
      const GainMap map = ComputeGainMap(base, light, 4, Like(channels));
      CHECK(CheckGainMap("map", map) == "");
      CHECK(map.capacity_min < map.capacity_max);
      CHECK(map.width == 2);
      CHECK(map.height == 2);
    }
  }
}

TEST_CASE("Ultra HDR: a file gives the light from which it was made") {
  if (!CanReadXmp()) return;
  const DeepImage light = SmoothLight(320, 240);
  const Image base = BaseOf(light);
  // The largest errors are in the dark, where rounding and compression change the base by up to 2
  // codes. A map of one channel also loses the tint of the light: 0.2 stops.
  const struct {
    int step, channels;
    double stops, psnr;
  } kCases[] = {{2, 1, 0.25, 47}, {4, 1, 0.25, 47}, {2, 3, 0.15, 56}, {4, 3, 0.15, 56}};
  for (const auto& row : kCases) {
    const auto [step, channels, stops, psnr] = row;
    CAPTURE(&row - kCases);
    const GainMap map = ComputeGainMap(base, light, step, Like(channels));
    const Bytes file = ValueOf(EncodeUltraHdr("out.jpg", base, map, 100, {}));
    const DepthPhoto photo = ValueOf(Decode(file));
    REQUIRE(photo.gain_map.format == "ISO 21496-1");
    CHECK(photo.gain_map.channels == channels);
    CHECK(photo.gain_map.min == map.min);
    CHECK(photo.gain_map.max == map.max);
    const Errors errors = Compare(light, ApplyGainMap(photo.picture, photo.gain_map));
    CHECK(errors.largest < stops);
    CHECK(errors.psnr > psnr);
  }
}

// Returns what a command prints, without standard error. The command runs in `folder`.
std::string Printed(const TempFolder& folder, const std::string& command) {
  const std::string file = folder.file("printed");
  const std::string whole = "cd '" + folder.path() + "' && (" + command + ") >printed 2>&1";
  const int code = std::system(whole.c_str());
  const Bytes text = ValueOf(ReadFile(file));
  return std::string(text.begin(), text.end()) + (code == 0 ? "" : "\nfailed");
}

Metadata SomeMetadata() {
  Metadata metadata;
  const std::string exif = ExifSegment(1, 26), icc = Profile(400);
  metadata.exif.assign(exif.begin() + 10, exif.end());
  metadata.icc.assign(icc.begin(), icc.end());
  metadata.iptc = {0x1c, 2, 120, 0, 4, 'c', 'a', 't', 's'};
  metadata.xmp =
      "<rdf:Description rdf:about=\"\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\">"
      "<xmp:Rating>4</xmp:Rating></rdf:Description>";
  return metadata;
}

Bytes SomeFile(int channels, const Metadata& metadata) {
  const DeepImage light = SmoothLight(160, 120);
  const Image base = BaseOf(light);
  return ValueOf(EncodeUltraHdr("out.jpg", base, ComputeGainMap(base, light, 2, Like(channels)), 95,
                                metadata));
}

TEST_CASE("Ultra HDR: a file keeps EXIF, profile, captions and IPTC of the photo") {
  if (!CanReadXmp()) return;
  Metadata metadata = SomeMetadata();
  const DepthPhoto photo = ValueOf(Decode(SomeFile(1, metadata)));
  CHECK(photo.metadata.icc == metadata.icc);
  CHECK(photo.metadata.iptc == metadata.iptc);
  CHECK(!photo.metadata.exif.empty());
  CHECK(Contains(photo.metadata.xmp, "<xmp:Rating>4<"));
  CHECK(!photo.gain_map.levels.empty());
  // Captions that do not fit beside the directory are omitted.
  metadata.xmp.insert(metadata.xmp.find("4<"), std::string(65000, '0'));
  const DepthPhoto without = ValueOf(Decode(SomeFile(1, metadata)));
  CHECK(without.metadata.xmp.empty());
  CHECK(!without.gain_map.levels.empty());
}

// Requires that exiftool reports no error and no warning about a file. Versions before the standard
// ISO 21496-1 do not know its segment, and mention it in their validation.
void CheckValid(const TempFolder& folder, const std::string& file) {
  CHECK(Printed(folder, "exiftool -warning -error -a " + file) == "");
  const std::string text = Printed(folder, "exiftool -validate -warning -error -a -s3 " + file);
  CHECK((text == "OK\n" || text == "1 Warning (minor)\n[minor] Unknown APP2 segment\n"));
}

TEST_CASE("Ultra HDR: exiftool finds no fault in a file, and both pictures" *
          doctest::test_suite("exiftool")) {
  if (std::system("command -v exiftool >/dev/null 2>&1") != 0) {
    std::printf("SKIPPED: exiftool is not there\n");
    return;
  }
  for (const int channels : {1, 3}) {
    TempFolder folder;
    Metadata metadata = SomeMetadata();
    metadata.exif.clear();  // the EXIF and the profile of the test lack required parts
    metadata.icc.clear();
    REQUIRE(WriteFile(folder.file("a.jpg"), SomeFile(channels, metadata)) == "");
    CheckValid(folder, "a.jpg");
    const std::string tags = Printed(folder, "exiftool -a -G1 -s a.jpg");
    CHECK(Contains(tags, "DirectoryItemSemantic           : Primary"));
    CHECK(Contains(tags, "DirectoryItemSemantic           : GainMap"));
    CHECK(Contains(tags, "NumberOfImages                  : 2"));
    CHECK(Contains(tags, "Rating                          : 4"));
    Printed(folder, "exiftool -b -MPImage2 a.jpg >map.jpg");
    CHECK(Contains(Printed(folder, "exiftool -a -G1 -s map.jpg"), "GainMapMax"));
    CheckValid(folder, "map.jpg");
  }
}

TEST_CASE("Ultra HDR: an independent decoder gives the same light" *
          doctest::test_suite("python")) {
  if (std::system("/usr/bin/python3 -c 'import PIL, numpy' >/dev/null 2>&1") != 0) {
    std::printf("SKIPPED: Python with Pillow and NumPy is not there\n");
    return;
  }
  if (!CanReadXmp()) return;
  for (const int channels : {1, 3}) {
    TempFolder folder;
    const Bytes file = SomeFile(channels, SomeMetadata());
    REQUIRE(WriteFile(folder.file("a.jpg"), file) == "");
    CHECK(Printed(folder, "/usr/bin/python3 '" STARFOCUS_SOURCE_DIR
                          "/tests/programs/ultra_hdr.py' a.jpg light") == "160x120\n");
    const DepthPhoto photo = ValueOf(Decode(file));
    const DeepImage light = ApplyGainMap(photo.picture, photo.gain_map);
    const Bytes bytes = ValueOf(ReadFile(folder.file("light")));
    REQUIRE(bytes.size() == 4 * light.samples.size());
    std::vector<float> theirs(light.samples.size());
    std::memcpy(theirs.data(), bytes.data(), bytes.size());
    for (size_t k = 0; k < theirs.size(); ++k) {
      // Half floats have 11 bits.
      CHECK(std::fabs(FloatOfHalf(light.samples[k]) - theirs[k]) <= theirs[k] / 1024 + 1e-5F);
    }
  }
}

TEST_CASE("Ultra HDR: a photograph keeps its light in a new map and in a new file" *
          doctest::test_suite("data_sets")) {
  const Result<Bytes> file = ReadFile(STARFOCUS_DATA_DIR "/hdr/ultrahdr_01.jpg");
  if (!file || !CanReadXmp()) {
    std::printf("SKIPPED: data set hdr is not there\n");
    return;
  }
  const DepthPhoto photo = ValueOf(Decode(*file));
  const GainMap& old = photo.gain_map;
  REQUIRE(old.width == 1020);
  CHECK(old.max[0] == doctest::Approx(2.656715));
  const DeepImage light = ApplyGainMap(photo.picture, old);
  const GainMap map = ComputeGainMap(photo.picture, light, 4, old);
  // Measured: 74.2 dB with the new map, 72.3 dB after its compression as JPEG, and 49.7 dB after
  // that of the base. With the default offset: 53.1 dB, as the old map has offsets of 0.
  CHECK(Compare(light, ApplyGainMap(photo.picture, map)).psnr > 73);
  const Bytes written = ValueOf(EncodeUltraHdr("out.jpg", photo.picture, map, 95, photo.metadata));
  const DepthPhoto again = ValueOf(Decode(written));
  CHECK(Compare(light, ApplyGainMap(photo.picture, again.gain_map)).psnr > 71);
  CHECK(Compare(light, ApplyGainMap(again.picture, again.gain_map)).psnr > 49);
}

TEST_CASE("gain maps: a photograph of Apple has the light that its maker note states" *
          doctest::test_suite("data_sets")) {
  const Result<Bytes> file = ReadFile(STARFOCUS_DATA_DIR "/photos/pug.heic");
  if (!file || !CanReadXmp()) {
    std::printf("SKIPPED: data set photos is not there\n");
    return;
  }
  const Result<DepthPhoto> photo = Decode(*file);
  if (Contains(photo, "built without libheif")) return;
  const GainMap& map = ValueOf(photo).gain_map;
  REQUIRE(map.format == "Apple");
  CHECK(map.width == photo->picture.width / 2);
  CHECK(map.max[0] == doctest::Approx(1.8));
  const DeepImage light = ApplyGainMap(photo->picture, map);
  // Apple's equation, computed by other programs from the same file, gives 1.353.
  float most = 0;
  for (const uint16_t half : light.samples) most = std::max(most, FloatOfHalf(half));
  CHECK(double{most} == doctest::Approx(1.353).epsilon(0.002));
}

}  // namespace
}  // namespace starfocus::ultra_hdr_test
