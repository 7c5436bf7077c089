// SPDX-License-Identifier: Apache-2.0
// Runs the program on pictures of more than 8 bits, with alpha and with light beyond white, and
// checks the light of the pictures that it writes. The PNG files of the inputs are written byte by
// byte.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/colour_description.h"
#include "platform/deep_image.h"
#include "platform/gain_map.h"
#include "platform/image_io.h"
#include "platform/pfm.h"
#include "platform/readers/capture.h"
#include "platform/readers/xmp.h"
#include "platform/writers/exr.h"
#include "platform/writers/tiff.h"
#include "platform/writers/ultra_hdr.h"
#include "platform/writers/webp.h"
#include "tests/programs/session.h"
#include "tests/support/photo_files.h"

namespace starfocus::deep_program_test {
namespace {

using namespace photos;

constexpr int kWide = 96, kHigh = 64;
// Columns of the near half that no blur reaches.
constexpr int kSharp = 40;
// A lamp in the far half.
constexpr int kLampLeft = 68, kLampTop = 28, kLampSide = 8;

constexpr char kFocus[] = " --near white --focus-at 9,9 -o ";

bool InLamp(int x, int y) {
  return x >= kLampLeft && x < kLampLeft + kLampSide && y >= kLampTop && y < kLampTop + kLampSide;
}

// Returns a random code of 16 bits.
uint32_t Random(uint32_t* seed) {
  *seed = *seed * 1664525 + 1013904223;
  return *seed >> 16;
}

// Returns a PNG file of random codes. Codes of alpha are opaque in the near half.
std::string DeepPng(int bytes, int channels, const std::string& more) {
  uint32_t seed = 1;
  std::string samples;
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) {
      for (int c = 0; c < channels; ++c) {
        const uint32_t code = c == 3 && x < kWide / 2 ? 65535 : Random(&seed);
        samples += Big(code >> 8 * (2 - bytes), bytes);
      }
    }
  }
  return Png(kWide, kHigh, {8 * bytes, channels == 4 ? 6 : 2, more}, samples,
             size_t(bytes) * size_t(channels) * kWide);
}

// Returns the chunk that describes PQ with the primaries of BT.2020.
std::string PqChunk() { return Chunk("cICP", std::string("\x09\x10\0\x01", 4)); }

// Returns the chunk that describes Display P3 with a transfer of H.273.
std::string P3Chunk(const std::string& transfer) {
  return Chunk("cICP", "\x0c" + transfer + std::string("\0\x01", 2));
}

// Returns a grey photo whose lamp is 8 times as bright as white.
std::string GainMapPhoto() {
  Image base = Plain(kWide, kHigh, 100);
  GainMap map;
  map.width = kWide;
  map.height = kHigh;
  map.max = {3, 3, 3};
  map.capacity_max = 3;
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) {
      if (InLamp(x, y)) std::fill_n(base.row(y) + 3 * x, 3, uint8_t{255});
      map.levels.push_back(InLamp(x, y) ? 65535 : 0);
    }
  }
  const Bytes file = ValueOf(EncodeUltraHdr("gain.jpg", base, map, 100, {}));
  return {file.begin(), file.end()};
}

// Returns linear light with a pixel that is not a number, two negative ones and a too bright one.
DeepImage DamagedLights() {
  DeepImage lights(kWide, kHigh, 3);
  lights.is_half = true;
  std::fill(lights.samples.begin(), lights.samples.end(), HalfOfFloat(0.5F));
  lights.row(9)[30] = HalfOfFloat(NAN);
  lights.row(9)[60] = lights.row(20)[62] = HalfOfFloat(-0.25F);
  lights.row(30)[90] = HalfOfFloat(100);
  return lights;
}

// Writes photos whose left half is near, each with its depth picture.
void MakeDeepPhotos(const TempFolder& folder) {
  Image map = Plain(kWide, kHigh, 0);
  for (int y = 0; y < kHigh; ++y) std::fill_n(map.row(y), 3 * kWide / 2, uint8_t{255});
  const std::string depth = Encode(map, ".png");
  const std::pair<const char*, std::string> kFiles[] = {
      {"rgb16.png", DeepPng(2, 3, "")},
      {"rgba16.png", DeepPng(2, 4, "")},
      {"rgba8.png", DeepPng(1, 4, "")},
      {"pq.png", DeepPng(2, 3, PqChunk())},
      {"p3.png", DeepPng(1, 3, P3Chunk("\r"))},
      {"linear.png", DeepPng(1, 3, P3Chunk("\b"))},
      {"gain.jpg", GainMapPhoto()}};
  for (const auto& [name, bytes] : kFiles) {
    Write(folder.file(name), bytes);
    Write(folder.file(std::filesystem::path(name).stem().string() + "-depth.png"), depth);
  }
  const DeepImage lights = DamagedLights();
  const Bytes exr = ValueOf(EncodeExr("a.exr", lights, {}));
  Write(folder.file("damaged.exr"), {exr.begin(), exr.end()});
  DeepImage codes(kWide, kHigh, 3);
  std::string ppm = "P6 96 64 65535\n";
  uint32_t seed = 2;
  for (uint16_t& code : codes.samples) {
    code = static_cast<uint16_t>(Random(&seed));
    ppm += Big(code, 2);
  }
  Write(folder.file("wide.ppm"), ppm);
  const Bytes tiff = ValueOf(EncodeTiff("a.tif", codes, {}));
  Write(folder.file("deep.tif"), {tiff.begin(), tiff.end()});
  // One colour, of which the lower half is half transparent.
  constexpr char kWebp[] =
      "RIFF\x28\0\0\0WEBPVP8L\x1c\0\0\0/"
      "_\xc0\x0f\x10\x0f\x30P\x83<(\xff\x03\x8c\x07\x88\x05\x93\xfc\xa5S\xd8\x19"
      "\xd1\xff\x9c?~";
  Write(folder.file("clear.webp"), std::string(kWebp, sizeof(kWebp) - 1));
  for (const char* name : {"damaged", "wide", "deep", "clear"}) {
    Write(folder.file(std::string(name) + "-depth.png"), depth);
  }
  Write(folder.file("map.png"), depth);
}

DecodedPicture Decoded(const TempFolder& folder, const std::string& name) {
  return ValueOf(DecodeImage(name, ValueOf(ReadFile(folder.file(name)))));
}

DeepImage Deep(const TempFolder& folder, const std::string& name) {
  const DecodedPicture picture = Decoded(folder, name);
  REQUIRE_MESSAGE(picture.deep.has_value(), name);
  return *picture.deep;
}

// Returns true if this build reads and writes the files of the tests.
bool HasLibraries() {
  const Result<DecodedPicture> deep = DecodeImage(
      "a", [](const std::string& png) { return Bytes(png.begin(), png.end()); }(DeepPng(2, 4, "")));
  const bool writes =
      !CheckExrEncoder("a.exr") && !CheckTiffEncoder("a.tif") && !WebpWriter::Check("a.webp", 1, 1);
  if (CanReadXmp() && deep && deep->deep && writes) return true;
  std::printf("SKIPPED: this build lacks libpng, libwebp, libtiff, OpenEXR or an XML parser\n");
  return false;
}

TEST_CASE("deep pictures: every session of the table succeeds") {
  if (!HasLibraries()) return;
  RunSessions("programs/deep_sessions.txt", {{"deep photos", MakeDeepPhotos}});
}

TEST_CASE("deep pictures: transparent and opaque pixels in focus keep their codes of 8 bits") {
  if (!HasLibraries()) return;
  TempFolder folder;
  MakeDeepPhotos(folder);
  Succeed(folder, "refocus rgba8.png" + std::string(kFocus) + "near.png");
  Succeed(folder, "refocus rgba8.png --near white --focus-at 90,9 -o far.png");
  const DeepImage in = Deep(folder, "rgba8.png"), near = Deep(folder, "near.png"),
                  far = Deep(folder, "far.png");
  REQUIRE(near.channels == 4);
  REQUIRE(far.channels == 4);
  int changed = 0, blurred = 0;
  for (int y = 0; y < kHigh; ++y) {
    for (int k = 0; k < 4 * kSharp; ++k) {
      const int other = 4 * kWide - 1 - k;
      changed += near.row(y)[k] != in.row(y)[k];
      // Colours of almost transparent pixels lose bits, because light is multiplied by alpha.
      const bool exact = other % 4 == 3 || in.row(y)[other / 4 * 4 + 3] > 32768;
      changed += exact && far.row(y)[other] != in.row(y)[other];
      blurred += near.row(y)[other] != in.row(y)[other];
    }
  }
  CHECK(changed == 0);
  CHECK(blurred > 4 * kSharp * kHigh / 2);
}

// Returns light over grey light, as codes of 16 bits.
DeepImage OverGrey(const DeepImage& codes, float grey) {
  const DeepImage half = ToHalf(codes);
  DeepImage result(codes.width, codes.height, 3);
  for (size_t k = 0; k < half.samples.size() / 4; ++k) {
    const float rest = 1 - FloatOfHalf(half.samples[4 * k + 3]);
    for (size_t c = 0; c < 3; ++c) {
      const double light = double{FloatOfHalf(half.samples[4 * k + c]) + rest * grey};
      const double code = CodeOfLight(STARFOCUS_TRANSFER_SRGB, light);
      result.samples[3 * k + c] =
          static_cast<uint16_t>(std::lround(65535 * std::clamp(code, 0.0, 1.0)));
    }
  }
  return result;
}

TEST_CASE("deep pictures: a flat surface is the same if it is composited before and afterwards") {
  if (!HasLibraries()) return;
  TempFolder folder;
  constexpr float kGrey = 0.3F;
  const std::string view = "/view_+0.0_+0.0.png";
  for (const char* name : {"clear", "opaque"}) {
    std::filesystem::create_directory(folder.file(name));
    const FloatMap map = {kWide, kHigh, std::vector<float>(size_t(kWide) * kHigh, 3)};
    REQUIRE(WritePfm(folder.file(name + std::string("/disparity.pfm")), map) == "");
  }
  Write(folder.file("clear" + view), DeepPng(2, 4, ""));
  const DeepImage over = OverGrey(Deep(folder, "clear" + view), kGrey);
  std::string samples;
  for (const uint16_t code : over.samples) samples += Big(code, 2);
  Write(folder.file("opaque" + view), Png(kWide, kHigh, {16, 2}, samples, size_t(6) * kWide));
  Succeed(folder, "refocus clear --focus 0 -o clear.png");
  Succeed(folder, "refocus opaque --focus 0 -o opaque.png");
  const DeepImage clear = OverGrey(Deep(folder, "clear.png"), kGrey),
                  opaque = Deep(folder, "opaque.png"), sharp = Deep(folder, "opaque" + view);
  REQUIRE(opaque.samples.size() == clear.samples.size());
  int largest = 0, blur = 0;
  for (size_t k = 0; k < clear.samples.size(); ++k) {
    largest = std::max(largest, std::abs(int{clear.samples[k]} - int{opaque.samples[k]}));
    blur = std::max(blur, std::abs(int{sharp.samples[k]} - int{opaque.samples[k]}));
  }
  CHECK(largest <= 257);  // one level of 8 bits
  CHECK(blur > 10000);
}

TEST_CASE("deep pictures: a PNG file of PQ stays one, and keeps its light and its description") {
  if (!HasLibraries()) return;
  TempFolder folder;
  MakeDeepPhotos(folder);
  Succeed(folder, "refocus pq.png" + std::string(kFocus) + "out.png");
  CHECK(Contains(Text(folder.file("out.png")), PqChunk()));
  const DeepImage in = Deep(folder, "pq.png"), out = Deep(folder, "out.png");
  REQUIRE(out.transfer == STARFOCUS_TRANSFER_PQ);
  double largest = 0;
  for (int y = 0; y < kHigh; ++y) {
    for (int k = 0; k < 3 * kSharp; ++k) {
      const double before = LightOfCode(STARFOCUS_TRANSFER_PQ, in.row(y)[k] / 65535.0),
                   after = LightOfCode(STARFOCUS_TRANSFER_PQ, out.row(y)[k] / 65535.0);
      largest = std::max(largest, std::fabs(after - before) / (before / 200 + 6e-5));
    }
  }
  CHECK(largest < 1);  // measured: 5e-5 in the dark, and 0.4 % of bright light
  CHECK(LargestLight(in) > 40);
  // The blur averages random codes in light: a picture that is clipped at white has at most 1.
  double sum = 0;
  for (int y = 0; y < kHigh; ++y) {
    for (int k = 3 * (kWide - 20); k < 3 * kWide; ++k) {
      sum += LightOfCode(STARFOCUS_TRANSFER_PQ, out.row(y)[k] / 65535.0);
    }
  }
  CHECK(sum / (3 * 20 * kHigh) > 4);
}

// Returns the light of a photo that the program wrote, which gets the depth picture of the input.
DeepImage LightOf(const TempFolder& folder, const std::string& name) {
  Write(folder.file(std::filesystem::path(name).stem().string() + "-depth.png"),
        Text(folder.file("map.png")));
  const Capture capture = ValueOf(OpenCapture(folder.file(name), {}));
  REQUIRE_MESSAGE(!capture.gain_map.levels.empty(), name);
  return ApplyGainMap(capture.light_field.views[0], capture.gain_map);
}

TEST_CASE("deep pictures: the new gain map of a photo has the refocused light") {
  if (!HasLibraries()) return;
  TempFolder folder;
  MakeDeepPhotos(folder);
  Succeed(folder, "refocus gain.jpg" + std::string(kFocus) + "out.jpg --quality 100");
  Succeed(folder, "refocus gain.jpg" + std::string(kFocus) + "out.exr");
  Succeed(folder, "refocus gain.jpg" + std::string(kFocus) + "part.jpg --region 60,20,24,24");
  const DeepImage given = LightOf(folder, "gain.jpg"), jpeg = LightOf(folder, "out.jpg"),
                  exr = Deep(folder, "out.exr");
  REQUIRE(jpeg.samples.size() == exr.samples.size());
  CHECK(LargestLight(given) == doctest::Approx(8).epsilon(0.05));
  double largest = 0, moved = 0;  // in stops
  for (size_t k = 0; k < exr.samples.size(); ++k) {
    const auto stops = [k](const DeepImage& light) {
      return std::log2(double{FloatOfHalf(light.samples[k])} + 0.05);
    };
    largest = std::max(largest, std::fabs(stops(jpeg) - stops(exr)));
    moved = std::max(moved, std::fabs(stops(given) - stops(exr)));
  }
  CHECK(largest < 0.25);
  CHECK(moved > 1);  // The blur spreads the lamp.
  CHECK(Contains(Text(folder.file("part.jpg")), "hdrgm:GainMapMax"));
  if (std::system("command -v exiftool >/dev/null 2>&1") != 0) return;
  REQUIRE(RunShell(folder,
                   "exiftool -a -G1 -s out.jpg >first && exiftool -b -MPImage2 out.jpg >map.jpg && "
                   "exiftool -a -G1 -s map.jpg >second") == 0);
  const std::string first = Text(folder.file("first"));
  CHECK(Contains(first, "[MPF0]          NumberOfImages                  : 2"));
  CHECK(Contains(first, "[XMP-hdrgm]"));
  CHECK(Contains(first, "DirectoryItemSemantic           : GainMap"));
  CHECK(!Contains(first, "Warning"));
  CHECK(Contains(Text(folder.file("second")), "[XMP-hdrgm]     GainMapMax"));
}

// Writes a light field of one view whose rows have the codes start + step * y of 16 bits.
void MakeRamp(const TempFolder& folder, const std::string& name, int start, int step) {
  std::filesystem::create_directory(folder.file(name));
  const FloatMap map = {kWide, kHigh, std::vector<float>(size_t(kWide) * kHigh, 3)};
  REQUIRE(WritePfm(folder.file(name + "/disparity.pfm"), map) == "");
  std::string samples;
  for (int y = 0; y < kHigh; ++y) {
    for (int k = 0; k < 3 * kWide; ++k) samples += Big(uint32_t(start + step * y), 2);
  }
  Write(folder.file(name + "/view_+0.0_+0.0.png"),
        Png(kWide, kHigh, {16, 2}, samples, size_t(6) * kWide));
}

TEST_CASE("deep pictures: 8 bits of a sky have its mean light, and whole codes stay flat") {
  if (!HasLibraries()) return;
  TempFolder folder;
  constexpr int kRows = 32;
  MakeRamp(folder, "sky", 25744, 6);   // from 100.2 on, a code of 8 bits every 43 rows
  MakeRamp(folder, "flat", 25708, 0);  // less than a sixteenth of a code above 100
  for (const char* output :
       {"sky --focus 0 -o sky.ppm", "sky --focus 0 -o sky.png", "flat --focus 0 -o flat.ppm"}) {
    Succeed(folder, std::string("refocus ") + output);
  }
  const Image sky = Decoded(folder, "sky.ppm").image, flat = Decoded(folder, "flat.ppm").image;
  const DeepImage exact = Deep(folder, "sky.png");
  double largest = 0;  // in codes of 8 bits; rounding errs by up to 0.4
  for (int top = 0; top + kRows <= kHigh; ++top) {
    double sum = 0;
    for (int y = top; y < top + kRows; ++y) {
      for (int k = 0; k < 3 * kWide; ++k) sum += sky.row(y)[k] - exact.row(y)[k] / 257.0;
    }
    largest = std::max(largest, std::fabs(sum / (3 * kWide * kRows)));
  }
  CHECK(largest < 0.1);
  CHECK(std::all_of(flat.pixels.begin(), flat.pixels.end(),
                    [&flat](uint8_t code) { return code == flat.pixels[0]; }));
}

TEST_CASE("deep pictures: linear photos of 8 bits keep their light and primaries in EXR files") {
  if (!HasLibraries()) return;
  TempFolder folder;
  MakeDeepPhotos(folder);
  Succeed(folder, "refocus linear.png" + std::string(kFocus) + "out.exr");
  const Image in = Decoded(folder, "linear.png").image;
  const DecodedPicture out = Decoded(folder, "out.exr");
  CHECK(PrimariesCodeOf(out.metadata.colours) == 12);
  REQUIRE(out.deep);
  double largest = 0;
  for (int y = 0; y < kHigh; ++y) {
    for (int k = 0; k < 3 * kSharp; ++k) {
      const double light = double{FloatOfHalf(out.deep->row(y)[k])};
      largest = std::max(largest, std::fabs(light - in.row(y)[k] / 255.0));
    }
  }
  CHECK(largest < 0.001);  // The curve of sRGB changes middle codes by 0.29.
}

TEST_CASE("deep pictures: an EXR light field keeps light beyond white, and other files tell") {
  if (!HasLibraries()) return;
  TempFolder folder;
  Succeed(folder, "scene lf --hdr --size 64x48 --views 5 --name lamps");
  Succeed(folder, "refocus lf --focus 0 -o out.exr");
  Succeed(folder, "refocus lf --focus 0 -o stream.exr --stream");
  CHECK(Text(folder.file("out.exr")) == Text(folder.file("stream.exr")));
  const DeepImage out = Deep(folder, "out.exr");
  CHECK(out.is_half);
  CHECK(LargestLight(out) > 1);
  for (const char* how : {"--focus 0 -o out.jpg", "--sweep 0:1:2 -o out.png"}) {
    CAPTURE(how);
    const Outcome outcome = Call(folder, std::string("refocus lf ") + how);
    CHECK(outcome.code == 0);
    CHECK(Contains(outcome.err, "lf: light brighter than white is clipped"));
  }
  const Outcome outcome = Call(folder, "refocus lf --focus 0 -o out.png");
  CHECK(Contains(outcome.err, "samples brighter than white"));
}

}  // namespace
}  // namespace starfocus::deep_program_test
