// SPDX-License-Identifier: Apache-2.0
// Reads photos whose colours are described without an ICC profile, in every form: the chunks of
// PNG, the box nclx of HEIF, and EXIF. The output must keep the description as an equivalent
// profile or in the form of PNG, or a note must report the loss. Also tests the notes about alpha
// channels.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "platform/colour_description.h"
#include "platform/icc_profile.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heic.h"
#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"

namespace starfocus::colours_test {
namespace {

using namespace photos;

constexpr int kGiven = ColourDescription::kGiven, kAdobe = ColourDescription::kAdobeRgb;

Span SpanOf(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

// Returns the numbers of a tagged element of a profile, which start `skip` bytes after its type.
std::vector<double> ElementOf(const Bytes& icc, const std::string& tag, size_t skip = 4) {
  const std::string text(icc.begin(), icc.end());
  const auto number = [&](size_t at) {
    uint32_t value = 0;
    for (size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<uint8_t>(text[at + k]);
    return value;
  };
  std::vector<double> values;
  for (size_t k = 0; k < number(128); ++k) {
    const size_t entry = 132 + 12 * k;
    if (text.compare(entry, 4, tag) != 0) continue;
    const size_t begin = number(entry + 4), end = begin + number(entry + 8);
    for (size_t at = begin + 4 + skip; at + 4 <= end; at += 4) {
      values.push_back(static_cast<int32_t>(number(at)) / 65536.0);
    }
  }
  return values;
}

// Returns the light of a code, by the curve of a profile.
double LightOf(const Bytes& icc, double code) {
  const std::vector<double> curve = ElementOf(icc, "rTRC", 8);
  if (curve.size() == 1) return std::pow(code, curve[0]);
  REQUIRE(curve.size() == 5);
  return code < curve[4] ? curve[3] * code : std::pow(curve[1] * code + curve[2], curve[0]);
}

TEST_CASE("profiles: primaries are adapted to D50, and equal codes are neutral") {
  struct Case {
    int primaries;
    double red[3], green[3], blue[3];
  };
  // Published matrices of sRGB, Display P3 and Adobe RGB (1998) for D50.
  const Case cases[] = {
      {1, {0.4361, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7142}},
      {12, {0.5151, 0.2412, -0.0011}, {0.2920, 0.6922, 0.0419}, {0.1571, 0.0666, 0.7841}},
      {kAdobe, {0.6097, 0.3111, 0.0195}, {0.2053, 0.6257, 0.0609}, {0.1492, 0.0632, 0.7448}},
  };
  for (const Case& one : cases) {
    CAPTURE(one.primaries);
    const Bytes icc = ProfileOf({"test", one.primaries, 8});
    for (size_t k = 0; k < 3; ++k) {
      CHECK(ElementOf(icc, "rXYZ")[k] == doctest::Approx(one.red[k]).epsilon(0.0003));
      CHECK(ElementOf(icc, "gXYZ")[k] == doctest::Approx(one.green[k]).epsilon(0.0003));
      CHECK(ElementOf(icc, "bXYZ")[k] == doctest::Approx(one.blue[k]).epsilon(0.0003));
    }
  }
  const double d50[] = {0.9642, 1, 0.8249};
  size_t profiles = 0;
  for (int primaries = 0; primaries < 256; ++primaries) {
    const Bytes icc = ProfileOf({"test", primaries, 13});
    if (icc.empty()) continue;
    ++profiles;
    CAPTURE(primaries);
    CHECK(IsRgbProfile(icc));
    CHECK(icc.size() % 4 == 0);
    for (size_t k = 0; k < 3; ++k) {
      const double sum =
          ElementOf(icc, "rXYZ")[k] + ElementOf(icc, "gXYZ")[k] + ElementOf(icc, "bXYZ")[k];
      CHECK(std::fabs(sum - d50[k]) < 3.0 / 65536);
      CHECK(std::fabs(ElementOf(icc, "wtpt")[k] - d50[k]) < 1.0 / 65536);
    }
  }
  CHECK(profiles == 12);  // 11 primaries of H.273, and unspecified ones
}

TEST_CASE("profiles: curves convert codes to light as the transfer defines") {
  struct Case {
    int transfer;
    double low, middle;  // light of the codes 0.02 and 0.5
  };
  const Case cases[] = {
      {1, 0.02 / 4.5, 0.25972},
      {4, std::pow(0.02, 2.2), 0.21764},
      {5, std::pow(0.02, 2.8), 0.14359},
      {6, 0.02 / 4.5, 0.25972},
      {7, 0.02 / 4, 0.26504},
      {8, 0.02, 0.5},
      {13, 0.02 / 12.92, 0.21404},
      {14, 0.02 / 4.5, 0.25972},
  };
  for (const Case& one : cases) {
    CAPTURE(one.transfer);
    const Bytes icc = ProfileOf({"test", 12, one.transfer});
    CHECK(LightOf(icc, 0.02) == doctest::Approx(one.low).epsilon(0.002));
    CHECK(LightOf(icc, 0.5) == doctest::Approx(one.middle).epsilon(0.0005));
    CHECK(LightOf(icc, 1) == doctest::Approx(1).epsilon(0.0001));
    CHECK(ElementOf(icc, "gTRC", 8) == ElementOf(icc, "rTRC", 8));
    CHECK(ElementOf(icc, "bTRC", 8) == ElementOf(icc, "rTRC", 8));
  }
  // Curves cannot express PQ, HLG, logarithms, reserved code points and the narrow range.
  for (const int transfer : {0, 3, 9, 10, 16, 17, 18, 19, 255}) {
    CHECK(ProfileOf({"test", 9, transfer}).empty());
  }
  CHECK(ProfileOf({"test", 12, 13, false}).empty());
  for (const int32_t gamma : {-5, 0, 5, 2000000, INT32_MAX}) {
    CHECK(ProfileOf({"test", 1, kGiven, true, {}, gamma}).empty());
  }
}

TEST_CASE("profiles: invalid chromaticities give no profile") {
  const Chromaticities bt709 = {64000, 33000, 30000, 60000, 15000, 6000, 31270, 32900};
  const auto profile = [](const Chromaticities& at) {
    return ProfileOf({"test", kGiven, 13, true, at});
  };
  CHECK(profile(bt709) != Bytes());
  CHECK(profile({}).empty());
  for (size_t k = 0; k < bt709.size(); ++k) {
    for (const int32_t value : {INT32_MIN, INT32_MAX}) {
      Chromaticities at = bt709;
      at[k] = value;
      CHECK(profile(at).empty());
    }
  }
  Chromaticities line = bt709;
  line[4] = line[2];
  line[5] = line[3];
  CHECK(profile(line).empty());
  Chromaticities dark = bt709;
  dark[7] = 0;
  CHECK(profile(dark).empty());
}

// Returns an RGB picture of 2x1 pixels with more chunks.
std::string PngWith(const std::string& chunks) {
  return Png(2, 1, {8, 2, chunks}, std::string("\1\2\3\4\5\6", 6), 6);
}

DepthPhoto Read(const std::string& name, const std::string& file) {
  return ValueOf(DecodeDepthPhoto(name, SpanOf(file), false, Near::kUnknown));
}

std::string Gamma(uint32_t value) { return Chunk("gAMA", Big(value, 4)); }

std::string Chroma(const std::vector<uint32_t>& xy) {
  std::string content;
  for (const uint32_t value : xy) content += Big(value, 4);
  return Chunk("cHRM", content);
}

bool HasProfiles() {  // A build without libpng reads no chunks.
  return !Read("a.png", PngWith(Gamma(100000))).metadata.icc.empty();
}

TEST_CASE("PNG: cICP, sRGB, gAMA and cHRM are kept as equivalent profiles") {
  if (!HasProfiles()) return;
  const std::string srgb = Chunk("sRGB", std::string(1, '\0'));
  const std::string bt709 = Chroma({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000});
  const std::string adobe = Chroma({31270, 32900, 64000, 33000, 21000, 71000, 15000, 6000});
  const Chromaticities adobe_at = {64000, 33000, 21000, 71000, 15000, 6000, 31270, 32900};
  const auto cicp = [](int primaries, int transfer) {
    return Chunk(
        "cICP", std::string{static_cast<char>(primaries), static_cast<char>(transfer), '\0', '\1'});
  };
  struct Case {
    std::string chunks;
    Bytes profile;
  };
  const Case cases[] = {
      {"", {}},
      {srgb, {}},
      {cicp(1, 13), {}},
      {cicp(2, 2), {}},
      {bt709, {}},
      {bt709 + Gamma(45455), {}},
      {srgb + adobe + Gamma(100000), {}},
      {cicp(1, 13) + adobe + Gamma(100000), {}},
      {cicp(12, 13), ProfileOf({"cICP", 12, 13})},
      {cicp(12, 13) + srgb, ProfileOf({"cICP", 12, 13})},
      {cicp(9, 14), ProfileOf({"cICP", 9, 14})},
      {Gamma(45455), ProfileOf({"gAMA", 1, kGiven, true, {}, 219997})},
      {Gamma(100000), ProfileOf({"gAMA", 1, kGiven, true, {}, 100000})},
      {Gamma(55556), ProfileOf({"gAMA", 1, kGiven, true, {}, 179998})},
      {adobe, ProfileOf({"cHRM", kGiven, 13, true, adobe_at})},
      {adobe + Gamma(45455), ProfileOf({"cHRM", kGiven, kGiven, true, adobe_at, 219997})},
  };
  for (const Case& one : cases) {
    const DepthPhoto photo = Read("a.png", PngWith(one.chunks));
    CHECK(photo.metadata.icc == one.profile);
    CHECK(photo.metadata.colours.form.empty());
    CHECK(photo.notes.empty());
    CHECK(photo.is_linear == (one.chunks == Gamma(100000)));
    CHECK((photo.picture.pixels == std::vector<uint8_t>{1, 2, 3, 4, 5, 6}));
  }
}

TEST_CASE("PNG: PQ and HLG are named in a note, and PNG files keep them") {
  if (!HasProfiles()) return;
  for (const int transfer : {16, 18}) {
    const std::string points = {9, static_cast<char>(transfer), 0, 1};
    const DepthPhoto photo = Read("a.png", PngWith(Chunk("cICP", points)));
    REQUIRE(photo.notes.size() == 1);
    CHECK(Contains(photo.notes[0], transfer == 16 ? "transfer of PQ" : "transfer of HLG"));
    CHECK(photo.metadata.icc.empty());
    const Bytes png = ValueOf(EncodePicture("a.png", photo.picture, {95, photo.metadata}));
    CHECK(Contains(std::string(png.begin(), png.end()), "cICP" + points));
    const DepthPhoto again = Read("a.png", std::string(png.begin(), png.end()));
    CHECK(again.metadata.colours.transfer == transfer);
  }
  // An invalid description is reported and omitted.
  const DepthPhoto photo = Read("a.png", PngWith(Gamma(20)));
  REQUIRE(photo.notes.size() == 1);
  CHECK(Contains(photo.notes[0], "invalid"));
  CHECK(photo.metadata.colours.form.empty());
}

TEST_CASE("PNG: a damaged cICP chunk is ignored, and cICP overrides a profile") {
  if (!HasProfiles()) return;
  for (const std::string& content : {std::string(), std::string(3, '\1'), std::string(5, '\1')}) {
    CHECK(Read("a.png", PngWith(Chunk("cICP", content))).metadata.icc.empty());
  }
  PictureOptions how;
  how.metadata.icc = ProfileOf({"test", 1, 8});
  const Bytes png = ValueOf(EncodePicture("a.png", Plain(2, 1, 9), how));
  std::string file(png.begin(), png.end());
  CHECK(Read("a.png", file).metadata.icc == how.metadata.icc);
  file.insert(33, Chunk("cICP", std::string("\x0c\x0d\0\1", 4)));  // after the header
  CHECK(Read("a.png", file).metadata.icc == ProfileOf({"cICP", 12, 13}));
}

#ifdef STARFOCUS_HAS_HEIF
TEST_CASE("HEIF: the code points of the box nclx are kept as an equivalent profile") {
  const Bytes seed = ValueOf(ReadFile(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/heif/plain.avif"));
  const auto read = [&](const std::string& points) {
    std::string file(seed.begin(), seed.end());
    const size_t at = file.find("nclx");
    REQUIRE(at != std::string::npos);
    file.replace(at + 4, points.size(), points);
    return ValueOf(ReadHeif("a.avif", SpanOf(file), Near::kUnknown));
  };
  CHECK(read(std::string("\0\1\0\x0d", 4)).metadata.icc.empty());
  CHECK(read(std::string("\0\2\0\2", 4)).metadata.icc.empty());
  CHECK(read(std::string("\0\x0c\0\x0d", 4)).metadata.icc == ProfileOf({"nclx", 12, 13}));
  const DepthPhoto pq = read(std::string("\0\x09\0\x10", 4));
  CHECK(pq.metadata.icc.empty());
  CHECK(pq.metadata.colours.transfer == 16);
  REQUIRE(pq.notes.size() == 1);
  CHECK(Contains(pq.notes[0], "BT.2020, transfer of PQ (nclx)"));
}
#endif

#ifdef STARFOCUS_HAS_EXIF
TEST_CASE("EXIF: Adobe RGB by the interoperability index R03 or the colour space 2 is kept") {
  const auto entry = [](uint32_t tag, uint32_t type, uint32_t count, const std::string& value) {
    return Big(tag, 2) + Big(type, 2) + Big(count, 4) + value;
  };
  const auto read = [&](const std::string& index, uint32_t space) {
    const std::string first = Big(1, 2) + entry(0x8769, 4, 1, Big(26, 4)) + Big(0, 4);
    const std::string second = Big(2, 2) + entry(0xa001, 3, 1, Big(space, 2) + Big(0, 2)) +
                               entry(0xa005, 4, 1, Big(56, 4)) + Big(0, 4);
    const std::string third = Big(1, 2) + entry(1, 2, 4, index + '\0') + Big(0, 4);
    const std::string segment =
        Segment(0xe1, std::string("Exif\0\0MM\0\x2a\0\0\0\x08", 14) + first + second + third);
    return Insert(Encode(Plain(8, 8, 9), ".jpg"), segment);
  };
  const Bytes adobe = ProfileOf({"EXIF", kAdobe, kAdobe});
  CHECK(Read("a.jpg", read("R03", 65535)).metadata.icc == adobe);
  CHECK(Read("a.jpg", read("R98", 2)).metadata.icc == adobe);
  CHECK(Read("a.jpg", read("R98", 1)).metadata.icc.empty());
  CHECK(Read("a.jpg", read("R98", 65535)).metadata.icc.empty());
  // A profile overrides EXIF.
  const std::string profile = Profile(200);
  const std::string both =
      Insert(read("R03", 65535), Segment(0xe2, std::string("ICC_PROFILE\0\1\1", 14) + profile));
  CHECK(Read("a.jpg", both).metadata.icc.size() == 200);
}
#endif

TEST_CASE("alpha: a note reports transparent pixels, but not an opaque alpha channel") {
  if (!HasProfiles()) return;
  struct Case {
    std::string file;
    bool transparent;
  };
  const std::string palette = Chunk("PLTE", "abcdef");
  const auto text = [](std::initializer_list<int> bytes) {
    std::string result;
    for (const int byte : bytes) result += static_cast<char>(byte);
    return result;
  };
  const Case cases[] = {
      {Png(2, 1, {8, 6}, text({1, 2, 3, 255, 4, 5, 6, 255}), 8), false},
      {Png(2, 1, {8, 6}, text({1, 2, 3, 255, 4, 5, 6, 254}), 8), true},
      {Png(2, 1, {8, 4}, text({1, 255, 4, 255}), 4), false},
      {Png(2, 1, {8, 4}, text({1, 0, 4, 255}), 4), true},
      {Png(2, 1, {16, 4}, text({1, 0, 9, 0, 4, 0, 255, 255}), 8), true},
      {Png(2, 1, {8, 2, Chunk("tRNS", text({0, 4, 0, 5, 0, 6}))}, text({1, 2, 3, 4, 5, 6}), 6),
       true},
      {Png(2, 1, {8, 2, Chunk("tRNS", text({0, 9, 0, 5, 0, 6}))}, text({1, 2, 3, 4, 5, 6}), 6),
       false},
      {Png(2, 1, {8, 0, Chunk("tRNS", text({0, 4}))}, text({1, 4}), 2), true},
      {Png(2, 1, {8, 3, palette + Chunk("tRNS", text({255, 7}))}, text({0, 0}), 2), false},
      {Png(2, 1, {8, 3, palette + Chunk("tRNS", text({255, 7}))}, text({0, 1}), 2), true},
      {Png(2, 1, {8, 3, palette}, text({0, 1}), 2), false},
  };
  for (const Case& one : cases) {
    const DepthPhoto photo = Read("a.png", one.file);
    CAPTURE(one.transparent);
    CHECK(photo.picture.pixels.size() == 6);
    bool noted = false;
    for (const std::string& note : photo.notes) {
      noted = noted ||
              note.find("transparent pixels of the picture become opaque") != std::string::npos;
    }
    CHECK(noted == one.transparent);
  }
  const DepthPhoto rgba = Read("a.png", cases[1].file), grey = Read("a.png", cases[3].file);
  CHECK((rgba.picture.pixels == std::vector<uint8_t>{1, 2, 3, 4, 5, 6}));
  CHECK((grey.picture.pixels == std::vector<uint8_t>{1, 1, 1, 4, 4, 4}));
}

TEST_CASE("formats: the error for OpenEXR names the format and a conversion") {
  const std::string exr = "v/1\x01 and more";
  const Bytes bytes(exr.begin(), exr.end());
  CHECK(Contains(DecodeImage("a.exr", bytes), "found an OpenEXR file (convert it to PNG or JPEG"));
  CHECK(Contains(DecodeImage("a.pdf", {'%', 'P', 'D', 'F'}), "found a PDF file"));
}

}  // namespace
}  // namespace starfocus::colours_test
