// SPDX-License-Identifier: Apache-2.0
// Tables of what describes the pixels of a photo: profiles, the chunks of PNG, the box nclx of
// HEIF, EXIF, captions, alpha channels and the number of bits. The output must keep colours as an
// equivalent profile or in the form of PNG, or a note must report the loss.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/colour_description.h"
#include "platform/icc_profile.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heic.h"
#include "platform/readers/sample_bits.h"
#include "platform/readers/xmp.h"
#include "platform/writers/jpeg.h"
#include "tests/programs/depth_scene.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::photo_metadata_test {
namespace {

using namespace depth_scene;

constexpr int kGiven = ColourDescription::kGiven, kAdobe = ColourDescription::kAdobeRgb;

std::string TextOf(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// Returns the numbers of a tagged element of a profile, which start `skip` bytes after its type.
std::vector<double> ElementOf(const Bytes& icc, const std::string& tag, size_t skip = 4) {
  const std::string text = TextOf(icc);
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
  // Published matrices of sRGB, Display P3 and Adobe RGB (1998) for D50.
  const struct {
    int primaries;
    double matrix[3][3];  // XYZ of red, green and blue
  } rows[] = {
      {1, {{0.4361, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7142}}},
      {12, {{0.5151, 0.2412, -0.0011}, {0.2920, 0.6922, 0.0419}, {0.1571, 0.0666, 0.7841}}},
      {kAdobe, {{0.6097, 0.3111, 0.0195}, {0.2053, 0.6257, 0.0609}, {0.1492, 0.0632, 0.7448}}},
  };
  const char* colours[] = {"rXYZ", "gXYZ", "bXYZ"};
  for (const auto& row : rows) {
    CAPTURE(row.primaries);
    const Bytes icc = ProfileOf({"test", row.primaries, 8});
    for (size_t k = 0; k < 9; ++k) {
      CHECK(ElementOf(icc, colours[k / 3])[k % 3] ==
            doctest::Approx(row.matrix[k / 3][k % 3]).epsilon(0.0003));
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

TEST_CASE("profiles: primaries and curves are found again, also without an adaptation matrix") {
  for (const int primaries : {1, 4, 5, 8, 9, 11, 12, 22}) {
    for (const int transfer : {8, 13}) {
      CAPTURE(primaries);
      Bytes icc = ProfileOf({"test", primaries, transfer});
      const std::optional<ColourDescription> found = DescriptionOf(icc);
      REQUIRE(found);
      CHECK(found->primaries == primaries);
      CHECK(found->transfer == transfer);
    }
  }
  const Bytes adobe = ProfileOf({"test", kAdobe, kAdobe});
  REQUIRE(DescriptionOf(adobe));
  CHECK(PrimariesNameOf(*DescriptionOf(adobe)) == "Adobe RGB");
  CHECK(TransferNameOf(*DescriptionOf(adobe)) == "gamma 2.20");
  // Profiles of version 2 state the white of the display instead of a matrix.
  const auto find = [](Bytes* icc, const char* name) {
    return std::search(icc->begin(), icc->end(), name, name + 4);
  };
  Bytes old = ProfileOf({"test", 12, 13});
  *find(&old, "chad") = 'x';
  const double d65[] = {0.95047, 1, 1.08883};
  const auto white = find(&old, "wtpt");
  const size_t at = size_t(white[6]) << 8 | white[7];
  for (size_t k = 0; k < 3; ++k) {
    const auto number = static_cast<uint32_t>(std::lround(65536 * d65[k]));
    for (size_t b = 0; b < 4; ++b) {
      old[at + 8 + 4 * k + b] = static_cast<uint8_t>(number >> (24 - 8 * b));
    }
  }
  REQUIRE(DescriptionOf(old));
  CHECK(DescriptionOf(old)->primaries == 12);
  // Curves of tables, and damaged profiles.
  Bytes table = ProfileOf({"test", 12, 8});
  const auto curve = find(&table, "para");
  constexpr uint8_t kGamma[] = {'c', 'u', 'r', 'v', 0, 0, 0, 0, 0, 0, 0, 0};
  std::copy(std::begin(kGamma), std::end(kGamma), curve);
  REQUIRE(DescriptionOf(table));
  CHECK(DescriptionOf(table)->transfer == 8);
  curve[11] = 200;  // more entries than the element has bytes
  CHECK(!DescriptionOf(table));
  for (const char* name : {"rXYZ", "gTRC", "wtpt"}) {
    CAPTURE(name);
    Bytes damaged = old;
    *find(&damaged, name) = 'x';
    CHECK(!DescriptionOf(damaged));
  }
}

TEST_CASE("profiles: curves convert codes to light as the transfer defines") {
  const struct {
    int transfer;
    double low, middle;  // light of the codes 0.02 and 0.5
  } rows[] = {
      {1, 0.02 / 4.5, 0.25972},
      {4, std::pow(0.02, 2.2), 0.21764},
      {5, std::pow(0.02, 2.8), 0.14359},
      {6, 0.02 / 4.5, 0.25972},
      {7, 0.02 / 4, 0.26504},
      {8, 0.02, 0.5},
      {13, 0.02 / 12.92, 0.21404},
      {14, 0.02 / 4.5, 0.25972},
  };
  for (const auto& one : rows) {
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
  CHECK(profile({64000, 33000, 30000, 60000, 30000, 60000, 31270, 32900}).empty());  // a line
  CHECK(profile({64000, 33000, 30000, 60000, 15000, 6000, 31270, 0}).empty());
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

std::string Cicp(int primaries, int transfer, bool full_range = true) {
  return Chunk("cICP", Big(uint32_t(primaries), 1) + Big(uint32_t(transfer), 1) +
                           std::string(1, '\0') + Big(full_range ? 1 : 0, 1));
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
  const struct {
    std::string chunks;
    Bytes profile;
    std::string unknown = {};  // transfer that the program does not decode
  } rows[] = {
      {"", {}},
      {srgb, {}},
      {Cicp(1, 13), {}},
      {Cicp(2, 2), {}},
      {bt709, {}},
      {bt709 + Gamma(45455), {}},
      {srgb + adobe + Gamma(100000), {}},
      {Cicp(1, 13) + adobe + Gamma(100000), {}},
      {Cicp(12, 13), ProfileOf({"cICP", 12, 13})},
      {Cicp(12, 13) + srgb, ProfileOf({"cICP", 12, 13})},
      {Cicp(9, 14), ProfileOf({"cICP", 9, 14}), "BT.2020 (cICP)"},
      {Gamma(45455), ProfileOf({"gAMA", 1, kGiven, true, {}, 219997})},
      {Gamma(100000), ProfileOf({"gAMA", 1, kGiven, true, {}, 100000})},
      {Gamma(55556), ProfileOf({"gAMA", 1, kGiven, true, {}, 179998}), "gamma 1.80 (gAMA)"},
      {adobe, ProfileOf({"cHRM", kGiven, 13, true, adobe_at})},
      {adobe + Gamma(45455), ProfileOf({"cHRM", kGiven, kGiven, true, adobe_at, 219997})},
      // Damaged cICP chunks are ignored.
      {Chunk("cICP", ""), {}},
      {Chunk("cICP", std::string(3, '\1')), {}},
      {Chunk("cICP", std::string(5, '\1')), {}},
  };
  for (const auto& row : rows) {
    CAPTURE(row.chunks);
    const DepthPhoto photo = Read("a.png", PngWith(row.chunks));
    CHECK(photo.metadata.icc == row.profile);
    CHECK(photo.metadata.colours.form.empty());
    std::vector<std::string> notes;
    if (!row.unknown.empty()) {
      notes = {"the transfer " + row.unknown + " counts as that of sRGB"};
    }
    CHECK(photo.notes == notes);
    CHECK(photo.is_linear == (row.chunks == Gamma(100000)));
    CHECK((photo.picture.pixels == std::vector<uint8_t>{1, 2, 3, 4, 5, 6}));
  }
  // cICP overrides a profile.
  PictureOptions how;
  how.metadata.icc = ProfileOf({"test", 1, 8});
  std::string file = TextOf(ValueOf(EncodePicture("a.png", Plain(2, 1, 9), how)));
  CHECK(Read("a.png", file).metadata.icc == how.metadata.icc);
  file.insert(33, Cicp(12, 13));  // after the header
  CHECK(Read("a.png", file).metadata.icc == ProfileOf({"cICP", 12, 13}));
}

TEST_CASE("ICC: codes of a linear profile are linear light in all formats") {
  for (const std::string name : {"a.png", "a.jpg", "a.webp"}) {
    CAPTURE(name);
    for (const int transfer : {8, 13}) {
      PictureOptions how;
      how.metadata.icc = ProfileOf({"test", 1, transfer});
      const Result<Bytes> file = EncodePicture(name, Plain(2, 1, 9), how);
      if (!file) continue;  // a build without libwebp
      const DepthPhoto photo = Read(name, TextOf(*file));
      if (photo.metadata.icc.empty()) continue;  // a build without libpng
      CHECK(photo.is_linear == (transfer == 8));
    }
  }
}

TEST_CASE("ICC: code points of PQ in a profile are decoded, or a note says that they are not") {
  if (!HasProfiles()) return;
  PictureOptions how;
  Bytes& icc = how.metadata.icc;
  icc = ProfileOf({"test", 1, 13});
  // Replace the copyright by an element of code points.
  const auto find = [&](const std::string& name) {
    return std::search(icc.begin(), icc.end(), name.begin(), name.end());
  };
  constexpr char kName[] = "cicp";
  const auto entry = std::copy_n(kName, 4, find("cprt"));
  constexpr uint8_t kElement[] = {'c', 'i', 'c', 'p', 0, 0, 0, 0, 9, 16, 0, 1};
  std::copy(std::begin(kElement), std::end(kElement), icc.begin() + (entry[2] << 8 | entry[3]));
  const Image picture = Plain(2, 1, 9);
  const DepthPhoto png = Read("a.png", TextOf(ValueOf(EncodePicture("a.png", picture, how))));
  REQUIRE(png.deep);
  CHECK(png.deep->transfer == STARFOCUS_TRANSFER_PQ);
  CHECK(png.deep_colours.primaries == 9);
  CHECK(png.metadata.icc == ProfileOf({"", 9, 13}));
  CHECK(png.notes.empty());
  const DepthPhoto jpeg = Read("a.jpg", TextOf(ValueOf(EncodePicture("a.jpg", picture, how))));
  CHECK(jpeg.metadata.icc == icc);
  CHECK(jpeg.notes ==
        std::vector<std::string>{"the transfer PQ (ICC profile) counts as that of sRGB"});
}

TEST_CASE("PNG: PQ and HLG are decoded, and invalid or unusual descriptions are named in a note") {
  if (!HasProfiles()) return;
  for (const int transfer : {16, 18}) {
    const DepthPhoto photo = Read("a.png", PngWith(Cicp(9, transfer)));
    REQUIRE(photo.deep);
    CHECK(photo.deep->transfer ==
          (transfer == 16 ? STARFOCUS_TRANSFER_PQ : STARFOCUS_TRANSFER_HLG));
    CHECK(photo.deep_colours.transfer == transfer);
    CHECK(photo.notes.empty());
    CHECK(photo.facts ==
          Facts{{"colour profile", transfer == 16 ? "BT.2020, transfer of PQ (cICP)"
                                                  : "BT.2020, transfer of HLG (cICP)"}});
    // The picture of 8 bits is a rendition in sRGB.
    CHECK(photo.metadata.icc == ProfileOf({"cICP", 9, 13}));
    CHECK(photo.metadata.colours.form.empty());
  }
  const DepthPhoto narrow = Read("a.png", PngWith(Cicp(9, 16, false)));
  REQUIRE(narrow.notes.size() == 1);
  CHECK(Contains(narrow.notes[0], "transfer of PQ, narrow range"));
  const DepthPhoto photo = Read("a.png", PngWith(Gamma(20)));
  REQUIRE(photo.notes.size() == 1);
  CHECK(Contains(photo.notes[0], "invalid"));
  CHECK(photo.metadata.colours.form.empty());
}

#ifdef STARFOCUS_HAS_HEIF
TEST_CASE("HEIF: the code points of the box nclx are kept as an equivalent profile") {
  const auto read = [](int primaries, int transfer) {
    return Read("a.avif", Changed(Seed("heif/plain.avif"), "nclx", 0,
                                  Big(uint32_t(primaries), 2) + Big(uint32_t(transfer), 2)));
  };
  CHECK(read(1, 13).metadata.icc.empty());
  CHECK(read(2, 2).metadata.icc.empty());
  CHECK(read(12, 13).metadata.icc == ProfileOf({"nclx", 12, 13}));
  const DepthPhoto pq = read(9, 16);
  REQUIRE(pq.deep);
  CHECK(pq.deep->transfer == STARFOCUS_TRANSFER_PQ);
  CHECK(pq.deep_colours.transfer == 16);
  CHECK(pq.metadata.icc == ProfileOf({"nclx", 9, 13}));
}
#endif

#ifdef STARFOCUS_HAS_EXIF
TEST_CASE("EXIF: Adobe RGB by the interoperability index R03 or the colour space 2 is kept") {
  const auto entry = [](uint32_t tag, uint32_t type, uint32_t count, const std::string& value) {
    return Big(tag, 2) + Big(type, 2) + Big(count, 4) + value;
  };
  const auto file = [&](const std::string& index, uint32_t space) {
    const std::string first = Big(1, 2) + entry(0x8769, 4, 1, Big(26, 4)) + Big(0, 4);
    const std::string second = Big(2, 2) + entry(0xa001, 3, 1, Big(space, 2) + Big(0, 2)) +
                               entry(0xa005, 4, 1, Big(56, 4)) + Big(0, 4);
    const std::string third = Big(1, 2) + entry(1, 2, 4, index + '\0') + Big(0, 4);
    return Insert(Photo(), Segment(0xe1, std::string("Exif\0\0MM\0\x2a\0\0\0\x08", 14) + first +
                                             second + third));
  };
  const Bytes adobe = ProfileOf({"EXIF", kAdobe, kAdobe});
  CHECK(Read("a.jpg", file("R03", 65535)).metadata.icc == adobe);
  CHECK(Read("a.jpg", file("R98", 2)).metadata.icc == adobe);
  CHECK(Read("a.jpg", file("R98", 1)).metadata.icc.empty());
  CHECK(Read("a.jpg", file("R98", 65535)).metadata.icc.empty());
  // A profile overrides EXIF.
  const std::string both = Insert(file("R03", 65535), ProfileSegments(Profile(200), 1)[0]);
  CHECK(TextOf(Read("a.jpg", both).metadata.icc) == Profile(200));
}
#endif

TEST_CASE("profiles: parts are joined by number, and incomplete or non-RGB profiles are omitted") {
  const std::string icc = Profile(1000), part = "the colour profile is ignored";
  const std::vector<std::string> parts = ProfileSegments(icc, 4);
  const struct {
    std::vector<std::string> segments;
    std::string profile, note;
  } rows[] = {
      {{}, "", ""},
      {parts, icc, ""},
      {{parts[3], parts[2], parts[1], parts[0]}, icc, ""},
      {{parts[1], parts[2], parts[3], parts[0]}, icc, ""},
      {{parts[0], parts[1], parts[2]}, "", part},
      {{parts[0], parts[1], parts[2], parts[2]}, "", part},
      {ProfileSegments(icc.substr(0, 999), 1), "", part},
      {ProfileSegments(icc.substr(0, 900), 2), "", part},
      {ProfileSegments(Profile(300, "GRAY"), 1), "", part},
      {ProfileSegments(Profile(300, "CMYK"), 2), "", part},
  };
  for (const auto& row : rows) {
    CAPTURE(&row - rows);
    const DepthPhoto photo = Read("photo.jpg", Insert(Photo(), Joined(row.segments)));
    CHECK(TextOf(photo.metadata.icc) == row.profile);
    CHECK(photo.notes.size() == (row.note.empty() ? 0 : 1));
    for (const std::string& note : photo.notes) CHECK(Contains(note, row.note));
  }
}

TEST_CASE("alpha: a note reports transparent pixels, but not an opaque alpha channel") {
  if (!HasProfiles()) return;
  const auto clear = [](const Bytes& bytes) { return Chunk("tRNS", TextOf(bytes)); };
  const std::string palette = Chunk("PLTE", "abcdef");
  const struct {
    std::string file;
    bool transparent;
  } rows[] = {
      {Png(2, 1, {8, 6}, TextOf({1, 2, 3, 255, 4, 5, 6, 255}), 8), false},
      {Png(2, 1, {8, 6}, TextOf({1, 2, 3, 255, 4, 5, 6, 254}), 8), true},
      {Png(2, 1, {8, 4}, TextOf({1, 255, 4, 255}), 4), false},
      {Png(2, 1, {8, 4}, TextOf({1, 0, 4, 255}), 4), true},
      {Png(2, 1, {16, 4}, TextOf({1, 0, 9, 0, 4, 0, 255, 255}), 8), true},
      {Png(2, 1, {8, 2, clear({0, 4, 0, 5, 0, 6})}, TextOf({1, 2, 3, 4, 5, 6}), 6), true},
      {Png(2, 1, {8, 2, clear({0, 9, 0, 5, 0, 6})}, TextOf({1, 2, 3, 4, 5, 6}), 6), false},
      {Png(2, 1, {8, 0, clear({0, 4})}, TextOf({1, 4}), 2), true},
      {Png(2, 1, {8, 3, palette + clear({255, 7})}, TextOf({0, 0}), 2), false},
      {Png(2, 1, {8, 3, palette + clear({255, 7})}, TextOf({0, 1}), 2), true},
      {Png(2, 1, {8, 3, palette}, TextOf({0, 1}), 2), false},
  };
  for (const auto& row : rows) {
    CAPTURE(&row - rows);
    const DepthPhoto photo = Read("a.png", row.file);
    CHECK(photo.picture.pixels.size() == 6);
    CHECK(Contains(Joined(photo.lost), "transparent pixels of the picture become opaque") ==
          row.transparent);
  }
  CHECK(Read("a.png", rows[1].file).picture.pixels == Bytes{1, 2, 3, 4, 5, 6});
  CHECK(Read("a.png", rows[3].file).picture.pixels == Bytes{1, 1, 1, 4, 4, 4});
}

// Returns the file with orientation 6 instead of 1 in the EXIF.
std::string Turned(std::string file) {
  const size_t at = file.rfind(std::string("\1\x12\0\3\0\0\0\1\0\1", 10));
  REQUIRE(at != std::string::npos);
  file[at + 9] = 6;
  const size_t chunk = file.find("eXIf");
  if (chunk == std::string::npos) return file;
  // The size includes the 4 bytes of the chunk's name.
  const size_t size =
      static_cast<uint8_t>(file[chunk - 2]) * 256u + static_cast<uint8_t>(file[chunk - 1]) + 4;
  return file.replace(chunk + size, 4, Big(Crc(file.substr(chunk, size)), 4));
}

TEST_CASE("EXIF of PNG and WebP rotates the picture like EXIF of JPEG") {
  // The first 10 bytes are the marker, the length and "Exif".
  const std::string segment = ExifSegment(1, 26);
  PictureOptions how;
  how.metadata.exif.assign(segment.begin() + 10, segment.end());
  for (const std::string name : {"photo.png", "photo.webp"}) {
    CAPTURE(name);
    const auto written = EncodePicture(name, Ramp(kWidth, kHeight), how);
    // A build without libwebp writes no WebP, and a build without libpng stores no EXIF.
    if (!written || !Contains(TextOf(*written), "starfocus")) continue;
    const DepthPhoto photo = Read(name, Turned(TextOf(*written)));
    CHECK(!photo.metadata.exif.empty());
#ifdef STARFOCUS_HAS_EXIF
    CHECK(photo.orientation == 6);
    CHECK(photo.focal_35mm == doctest::Approx(26));
#endif
  }
}

TEST_CASE("captions: XMP and IPTC of a photo are kept, except properties of its depth map") {
  if (!CanReadXmp()) return;
  const std::string names =
      std::string(kGoogle) +
      " xmlns:dc=\"http://purl.org/dc/elements/1.1/\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" "
      "xmlns:tiff=\"http://ns.adobe.com/tiff/1.0/\"";
  const std::string title =
      "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">Cats &amp; dogs</rdf:li></rdf:Alt>"
      "</dc:title>";
  const std::string records("\x1c\x02\x78\0\3abc", 8);
  const std::string packet =
      Packet(names, kInverse + "xmp:Rating=\"4\" tiff:Orientation=\"6\" " + Data(RampPng()),
             title + "<GFocus:Extra>1</GFocus:Extra>");
  const auto read = [](const std::string& segments) {
    return Read("photo.jpg", Insert(Photo(), segments)).metadata;
  };
  const Metadata kept = read(IptcSegment(records) + XmpSegment(packet) +
                             XmpSegment(Packet(names, "xmp:Rating=\"1\"")));
  CHECK(kept.xmp ==
        "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\" "
        "xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"><xmp:Rating>4</xmp:Rating>" +
            title + "</rdf:Description>");
  CHECK(TextOf(kept.iptc) == records);
  // The written captions must be readable, and the written file must not declare a depth map.
  const Bytes jpeg = ValueOf(EncodeJpeg("x", Plain(kWidth, kHeight, 9), 90, kept, {}));
  Capture capture;
  CHECK(Contains(Open(TextOf(jpeg), &capture), "a picture without one"));
  const DepthPhoto again = Read("photo.jpg", TextOf(jpeg));
  CHECK(again.metadata.xmp == kept.xmp);
  CHECK(again.metadata.iptc == kept.iptc);
  // A photo without captions has no metadata, and truncated IPTC is ignored.
  const std::string cut = std::string("Photoshop 3.0\0", 14) + "8BIM\4\4" + std::string(3, '\0');
  const Metadata none = read(XmpSegment(Packet(kGoogle, kInverse)) + Segment(0xed, cut));
  CHECK(none.xmp.empty());
  CHECK(none.iptc.empty());
}

TEST_CASE("photos: PPM states the number of bits, and other files have 8") {
  const std::pair<std::string, int> kBits[] = {{"P6 1 1 255\n", 8},
                                               {"P6 1 1 256\n", 9},
                                               {"P5\n# 1\n1 1 1023\n", 10},
                                               {"P6 1 1 65535\n", 16},
                                               {"P", 8},
                                               {"P6 1 1 x", 8}};
  for (const auto& [file, bits] : kBits) {
    CHECK(SampleBitsOf(Bytes(file.begin(), file.end())) == bits);
  }
}

}  // namespace
}  // namespace starfocus::photo_metadata_test
