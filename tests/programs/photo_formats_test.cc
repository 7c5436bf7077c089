// SPDX-License-Identifier: Apache-2.0
// Table of valid depth photos in JPEG and HEIF files: each row has a file, made as the
// specification of its format defines, and the disparities and the note that opening this file must
// give. A new kind of photo is a new row. The HEIF files are the seeds of tests/fuzz/corpus/heif.
// photo_refusals_test.cc has the files that are rejected, mattes_test.cc the mattes,
// photo_metadata_test.cc the colours, depth_picture_test.cc the separate depth pictures, and
// layouts.txt the folders.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/readers/coded_size.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heic.h"
#include "platform/readers/heif_boxes.h"
#include "platform/readers/xmp.h"
#include "tests/programs/depth_scene.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::photo_formats_test {
namespace {

using namespace depth_scene;

// A photo of 40x24 pixels with a map of levels that increase from black on the left to white on the
// right, and the disparities of black and white.
struct Row {
  std::string file;
  double black, white;
  std::string note = "";  // part of a note, or empty if the photo must open without a note
  Near near = Near::kUnknown;
  double tolerance = 1e-4;  // relative; maps in JPEG files are less accurate than maps in PNG files
};

void CheckRows(const std::string& format, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    CAPTURE(&row - rows.data());
    const Capture capture = OpenPhoto(row.file, {"", NearIs(row.near)});
    CHECK(capture.photo);
    CHECK(capture.care == MapCare::kRepair);
    CHECK(capture.format == format);
    REQUIRE(capture.light_field.disparity.values.size() == size_t(kWidth) * kHeight);
    CHECK(At(capture, 0, 3) == doctest::Approx(row.black).epsilon(row.tolerance));
    CHECK(At(capture, kWidth - 1, 3) == doctest::Approx(row.white).epsilon(row.tolerance));
    for (const std::string& note : capture.notes) INFO(note);
    CHECK(HasNote(capture, row.note) == !row.note.empty());
  }
}

double LevelAt(int x) { return std::floor(x * 255.0 / (kWidth - 1)) / 255; }

const std::string kOneHalfToFour = "GDepth:Near=\"0.5\" GDepth:Far=\"4\" ";
std::string GdepthOf(const std::string& attributes) {
  return Gdepth(Photo(), attributes, Data(RampPng()));
}

// Returns a photo whose extended XMP is in many segments in another order than in the text.
std::string Scattered(const std::string& map) {
  const std::string text = Packet(kGoogle, Data(map));
  std::vector<std::string> segments = ExtensionSegments(text, text.size() / 7);
  std::reverse(segments.begin(), segments.end());
  std::swap(segments[1], segments[4]);
  return Insert(Photo(), XmpSegment(Packet(kGoogle, kGuidName + kInverse)) + Joined(segments));
}

// Returns a photo with extended XMP under an identifier that no packet has.
std::string Unnamed(const std::string& attributes) {
  std::string other = Joined(ExtensionSegments(Packet(kGoogle, Data(RampPng())), 300));
  for (size_t at = 0; (at = other.find(kGuid, at)) != std::string::npos;) other[at] = 'F';
  return Insert(Photo(), XmpSegment(Packet(kGoogle, attributes)) + other);
}

TEST_CASE("GDepth: ranges, units, packets and segments in every form give the disparities") {
  if (!CanReadXmp()) return;
#ifdef STARFOCUS_HAS_EXIF
  const double wide = PerDiopter(26);
#else
  const double wide = PerDiopter(50);
#endif
  const double metre = PerDiopter(50);
  const std::string inverse = "GDepth:Format=\"RangeInverse\" ", metres = "GDepth:Units=\"m\" ",
                    linear = "GDepth:Format=\"RangeLinear\" ";
  const std::string millimetres = "GDepth:Near=\"500\" GDepth:Far=\"4000\" GDepth:Units=\"mm\"";
  std::vector<uint16_t> levels;
  for (int k = 0; k < kWidth * kHeight; ++k) {
    levels.push_back(static_cast<uint16_t>(k % kWidth * 65535 / (kWidth - 1)));
  }
  const std::string jpeg = Encode(Plain(kWidth / 2, kHeight / 2, 0), ".jpg");
  const std::string depth = XmpSegment(Packet(kGoogle, kInverse + Data(RampPng())));
  const std::string rights =
      XmpSegment(Packet("xmlns:dc=\"http://purl.org/dc/elements/1.1/\" dc:format=\"x\"", ""));
  const std::string broken = XmpSegment("<a");
  const std::string unnamed = "no XMP packet refers to";
  std::vector<Row> rows = {
      {Gdepth(Insert(Photo(), ExifSegment(1, 26)), kInverse + metres, Data(RampPng())), wide / 0.5,
       wide / 4},
      {GdepthOf(linear + kOneHalfToFour + metres), metre / 0.5, metre / 4},
      {GdepthOf(inverse + millimetres), metre / 0.5, metre / 4},
      {GdepthOf(kInverse), kPortrait, kPortrait / 8},
      {Scattered(RampPng()), kPortrait, kPortrait / 8},
      {Scattered(Png16(kWidth, kHeight, levels)), kPortrait, kPortrait / 8},
      {Gdepth(Photo(), kInverse + Data(jpeg), ""), kPortrait, kPortrait},
      {Insert(Photo(), rights + depth), kPortrait, kPortrait / 8},
      {Insert(Photo(), depth + rights), kPortrait, kPortrait / 8},
      {Insert(Photo(), broken + depth), kPortrait, kPortrait / 8, "XMP is ignored"},
      {Insert(Photo(), depth + broken), kPortrait, kPortrait / 8, "XMP is ignored"},
      {Unnamed(kGuidName + kInverse), kPortrait, kPortrait / 8, unnamed},
      {Unnamed(kInverse), kPortrait, kPortrait / 8, unnamed}};
  // The range of levels that are linear in the inverse distance may end at infinity.
  for (const std::string far : {"INF", "inf", "Infinity", "+inf"}) {
    rows.push_back({GdepthOf(inverse + metres + "GDepth:Near=\"0.5\" GDepth:Far=\"" + far + "\""),
                    metre / 0.5, 0, "infinite"});
  }
  // Levels of a photo without a valid range define only an order, in which black is near.
  std::vector<std::string> orders = {linear + "GDepth:Near=\"0.5\" GDepth:Far=\"INF\"",
                                     kOneHalfToFour, "GDepth:Format=\"other\" " + kOneHalfToFour};
  for (const std::string& form : {inverse + metres, linear}) {
    for (const char* range :
         {"", "GDepth:Near=\"0\" GDepth:Far=\"4\"", "GDepth:Near=\"4\" GDepth:Far=\"4\"",
          "GDepth:Near=\"nan\" GDepth:Far=\"4\"", "GDepth:Near=\"0.5\"",
          "GDepth:Near=\"0\" GDepth:Far=\"inf\""}) {
      orders.push_back(form + range);
    }
  }
  for (const std::string& order : orders) {
    const std::string note = "the range of the depth map is ignored";
    rows.push_back({GdepthOf(order), kPortrait, 0, note});
    rows.push_back({GdepthOf(order), 0, kPortrait, note, Near::kWhite});
  }
  CheckRows("GDepth photo (JPEG)", rows);
  // Between the ends, levels are linear in the inverse distance or in the distance, and levels of
  // 16 bits keep their accuracy.
  const auto at = [](const std::string& file, int x) {
    return double(OpenPhoto(file).light_field.disparity.at(x, 0));
  };
  const double level = LevelAt(kWidth / 2);
  CHECK(at(rows[0].file, kWidth / 2) ==
        doctest::Approx(wide * ((1 - level) / 0.5 + level / 4)).epsilon(1e-4));
  CHECK(at(rows[1].file, kWidth / 2) == doctest::Approx(metre / (0.5 + 3.5 * level)).epsilon(1e-4));
  CHECK(at(rows[5].file, 1) ==
        doctest::Approx(kPortrait * (1 - levels[1] / 65535.0 * 7 / 8)).epsilon(1e-5));
}

TEST_CASE("Dynamic Depth: the map is the item that the container names, even by wrong lengths") {
  if (!CanReadXmp()) return;
  const double metre = PerDiopter(50);
  const auto file = [](const std::string& attributes, size_t wrong = 0) {
    return DynamicDepth(Photo(), RampPng(), attributes, wrong);
  };
  const std::string range =
      "DepthMap:Format=\"RangeInverse\" DepthMap:Near=\"0.5\" DepthMap:Far=\"4\" ";
  const std::string packet = Packet(
      "xmlns:Container=\"http://ns.google.com/photos/1.0/container/\" "
      "xmlns:Item=\"http://ns.google.com/photos/1.0/container/item/\"",
      "",
      "<Container:Directory><rdf:Seq><rdf:li rdf:parseType=\"Resource\"><Container:Item "
      "Item:Mime=\"image/jpeg\" Item:Semantic=\"Primary\"/></rdf:li><rdf:li "
      "rdf:parseType=\"Resource\"><Container:Item Item:Mime=\"image/png\" Item:Semantic=\"Depth\" "
      "Item:Length=\"" +
          std::to_string(RampPng().size()) + "\"/></rdf:li></rdf:Seq></Container:Directory>");
  CheckRows("Dynamic Depth photo (JPEG)",
            {{file(range + "DepthMap:Units=\"Meters\""), metre / 0.5, metre / 4},
             {file(range + "DepthMap:Units=\"None\""), kPortrait, kPortrait / 8},
             // With diopters as units, cameras store near and far as distances that are known only
             // up to a factor.
             {file(range + "DepthMap:Units=\"Diopters\""), kPortrait, kPortrait / 8, "diopters"},
             {file("DepthMap:Format=\"RangeLinear\" DepthMap:Units=\"Meters\" DepthMap:Near=\"0\" "
                   "DepthMap:Far=\"4\""),
              kPortrait, 0, "the range of the depth map is ignored"},
             // If the lengths are wrong, the map is found by the first bytes of a PNG or JPEG file.
             {file(range, 7) + "behind", kPortrait, kPortrait / 8,
              "the wrong lengths of the container are ignored"},
             {Insert(Photo(), XmpSegment(packet)) + RampPng(), 0, kPortrait, "", Near::kWhite}});
}

TEST_CASE("Apple's JPEG: the auxiliary disparities are found by any index, and without one") {
  if (!CanReadXmp()) return;
  const std::string type = AppleType("disparity"), range = kAppleRange;
  const std::string absolute = "<depthData:Accuracy>absolute</depthData:Accuracy>";
  const std::string wrong = "the wrong multi-picture index is ignored",
                    missing = "the file has no multi-picture index";
  const auto map = [](const std::string& elements) {
    return AppleMap(Encode(Ramp(kWidth, kHeight), ".jpg"), elements);
  };
  const auto row = [&](const std::string& file, const std::string& note = "") {
    return Row{file, kPortrait / 4, kPortrait, note, Near::kUnknown, 0.02};
  };
  std::vector<Row> rows = {row(Photo() + map(type + range), missing),
                           row(Photo() + "between\xff\xd8\xff" + map(type + range), missing),
                           row(MultiPicture(Photo(), map(type))),
                           row(MultiPicture(Photo(), map(type + range + absolute)))};
  rows[2].black = 0;
  rows[3].black = PerDiopter(50) / 2;
  rows[3].white = PerDiopter(50) * 2;
  for (const bool little : {false, true}) {
    const auto file = [&](uint32_t entries, uint32_t moved) {
      return MultiPicture(Photo(), map(type + range), {little, entries, moved});
    };
    rows.push_back(row(file(32, 0)));
    rows.push_back(row(file(0xffffffff, 0)));
    rows.push_back(row(file(2, 0), wrong));
    rows.push_back(row(file(32, 1000), wrong));
    rows.push_back(row(file(32, 0x80000000), wrong));
    // An editor inserts a segment before the index. The offsets in the index are relative to the
    // index and therefore remain valid.
    rows.push_back(row(Insert(file(32, 0), ExifSegment(1, 50))));
  }
  CheckRows("Apple depth photo (JPEG)", rows);
}

TEST_CASE("GDepth: the focus, the facts and the sharp picture of the file are used, upright") {
  if (!CanReadXmp()) return;
  const std::string range =
      "GDepth:Format=\"RangeInverse\" GDepth:Near=\"500\" "
      "GDepth:Far=\"4000\" GFocus:FocalDistance=\"2000\" ";
  Capture capture = OpenPhoto(GdepthOf(range + "GDepth:Units=\"mm\""));
  CHECK(!capture.has_focus);
  CHECK(capture.focus == doctest::Approx(PerDiopter(50) / 2));
  CHECK(FactOf(capture, "map") == "40x24, RangeInverse from 500 to 4000 mm");
  capture = OpenPhoto(GdepthOf(range));
  CHECK(capture.focus == doctest::Approx(kPortrait / 4));
  CHECK(FactOf(capture, "scale").find("unknown") == 0);
#ifdef STARFOCUS_HAS_EXIF
  // Orientation 6: row 0 of the file is the right side of the upright picture, and column 0 of the
  // file is the top.
  Image sharp = Plain(kWidth, kHeight, 0);
  std::fill_n(sharp.row(0), 12, uint8_t{255});  // the first pixels of the first row in the file
  const std::string focus = "GFocus:FocalPointX=\"0.25\" GFocus:FocalPointY=\"0.125\" ",
                    image = "GImage:Data=\"" + Base64(Encode(sharp, ".png")) + "\"";
  capture = OpenPhoto(
      Gdepth(Insert(Photo(), ExifSegment(6, 0)), kInverse + focus + image, Data(RampPng())));
  const Image& upright = capture.light_field.views[0];
  REQUIRE(upright.width == kHeight);
  REQUIRE(upright.height == kWidth);
  for (const int y : {0, 3}) CHECK(upright.row(y)[3 * (kHeight - 1)] == 255);
  CHECK(upright.row(4)[3 * (kHeight - 1)] == 0);
  CHECK(upright.row(0)[0] == 0);
  CHECK(At(capture, 5, 0) > At(capture, 5, kWidth - 1));
  CHECK(capture.has_focus);
  CHECK(capture.focus_x == int(0.875 * kHeight));
  CHECK(capture.focus_y == kWidth / 4);
  CHECK(FactOf(capture, "orientation").find("6 of EXIF") == 0);
#endif
}

TEST_CASE("XMP that is lost or malformed is ignored for the depth picture next to the photo") {
  if (!CanReadXmp()) return;
  const std::string lost = Packet(kGoogle, kGuidName + kInverse);
  const std::string text = Packet(kGoogle, Data(RampPng()));
  std::vector<std::string> gap = ExtensionSegments(text, text.size() / 5);
  gap.erase(gap.begin() + 2);
  const auto with = [](const std::string& packet, const std::vector<std::string>& more = {}) {
    return Insert(Photo(), XmpSegment(packet) + Joined(more));
  };
  const std::pair<std::string, std::string> rows[] = {
      {with(lost), "the extended XMP is ignored"},
      {with(lost, gap), "the extended XMP is ignored"},
      {with(lost.substr(0, lost.size() / 2)), "XMP is ignored"},
      {with("<a><b></a>"), "XMP is ignored"},
      {with(Packet(kGoogle, kInverse + "GDepth:Data=\"????\"")),
       "GDepth:Data: expected a picture in base64"},
      {with(Packet(kGoogle, kInverse + Data("no picture"))), "GDepth:Data: expected a PNG"},
      {Unnamed(kInverse), ""}};  // the file has a map
  for (const auto& row : rows) {
    const std::string &file = row.first, &note = row.second;
    CAPTURE(note);
    TempFolder folder;
    Write(folder.file("photo.jpg"), file);
    Write(folder.file("photo-depth.png"), RampPng());
    const Capture capture =
        ValueOf(OpenCapture(folder.file("photo.jpg"), {"", NearIs(Near::kWhite)}));
    CHECK(capture.format == "photo and depth picture");
    CheckRamp(capture, 0, kPortrait);
    CHECK(HasNote(capture, note));
    if (note.empty()) continue;
    // If the depth picture is absent, the error must name the cause that the note names.
    std::filesystem::remove(folder.file("photo-depth.png"));
    const Error error = OpenCapture(folder.file("photo.jpg"), {}).error();
    CHECK(Contains(error, ": expected a depth map"));
    CHECK(Contains(error, note));
  }
}

// Returns an empty text if `file` contains a picture of the level `level` and the ramp of the depth
// map, and otherwise the difference.
std::string Difference(const std::string& file, int level = kOriginalLevel) {
  const Result<DepthPhoto> photo =
      DecodeDepthPhoto("photo.jpg", SpanOf(file), true, Near::kUnknown);
  if (!photo) return photo.error().line();
  if (photo->map.values.empty()) return photo->map_problem;
  const int found = photo->picture.row(5)[30];
  if (std::abs(found - level) > 2) return "a picture of level " + std::to_string(found);
  const double near = double(photo->map.at(0, 3)), far = double(photo->map.at(kWidth - 1, 3));
  if (std::fabs(near - 1 / 0.5) > 0.05 || std::fabs(far - 1 / 4.0) > 0.05) {
    return "inverse distances from " + std::to_string(near) + " to " + std::to_string(far);
  }
  if (photo->is_blurred == (level == kOriginalLevel)) return "the wrong picture as the blurred one";
  const auto is_gain_map = [](const auto& fact) { return fact.first == "gain map"; };
  return std::any_of(photo->facts.begin(), photo->facts.end(), is_gain_map) ? "" : "no gain map";
}

std::vector<Part> Parts() { return PortraitParts(kWidth, kHeight); }

TEST_CASE("portraits: all orders of the parts give the original and the depth map") {
  if (!CanReadXmp()) return;
  const std::string blurred = Photo();
  const std::vector<Part> parts = Parts();
  std::vector<size_t> order = {0, 1, 2, 3, 4};
  do {
    std::vector<Part> placed;
    for (const size_t k : order) placed.push_back(parts[k]);
    CAPTURE(order);
    for (const Lengths lengths : {Lengths::kRight, Lengths::kMissing, Lengths::kWrong}) {
      for (const Directories directories :
           {Directories::kBoth, Directories::kLater, Directories::kRepeated}) {
        // The first index stands for several sizes of padding.
        CHECK(Difference(Portrait(blurred, placed, directories, lengths, order[0])) == "");
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("portraits: gain maps and originals in every form are known, and never depth") {
  if (!CanReadXmp()) return;
  const auto check = [](const std::vector<Part>& parts, Lengths lengths) {
    CHECK(Difference(Portrait(Photo(), parts, Directories::kBoth, lengths)) == "");
  };
  // A gain map without XMP of its own is known by the directory. The standard places it right
  // behind the first picture.
  std::vector<Part> parts = Parts();
  const std::string plain = Encode(Ramp(kWidth / 2, kHeight / 2), ".jpg");
  parts[0].bytes = plain;
  check(parts, Lengths::kRight);
  check(parts, Lengths::kMissing);
  std::swap(parts[0], parts[2]);
  check(parts, Lengths::kRight);
  // ISO 21496-1 describes a gain map by a segment, which the photo has as well without content.
  parts = Parts();
  const std::string iso = std::string("urn:iso:std:iso:ts:21496:-1") + std::string(5, '\0');
  parts[0].bytes = Insert(plain, Segment(0xe2, iso + std::string(60, '\1')));
  parts[0].semantic = "Other";
  parts[1].bytes = Insert(parts[1].bytes, Segment(0xe2, iso));
  check(parts, Lengths::kMissing);
  // An original that is itself a file with a gain map is one item.
  parts = Parts();
  parts[1].bytes = Insert(parts[1].bytes,
                          XmpSegment(Packet("xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"",
                                            "hdrgm:Version=\"1.0\"", "<Directory/>"))) +
                   parts[0].bytes;
  check(parts, Lengths::kRight);
  // The packet describes a depth map that is not in the file.
  for (const Lengths lengths : {Lengths::kRight, Lengths::kMissing, Lengths::kWrong}) {
    Capture capture;
    CHECK(Contains(Open(Portrait(Photo(), {Parts()[0]}, Directories::kBoth, lengths), &capture),
                   "no complete picture there"));
  }
}

TEST_CASE("portraits: blur of the camera is noted, unless the file has the sharp picture") {
  if (!CanReadXmp()) return;
  std::vector<Part> parts = Parts();
  parts[1].bytes = Encode(Plain(kHeight, kWidth, kOriginalLevel), ".jpg");
  for (const bool other : {true, false}) {  // a picture of other proportions, or none
    if (!other) parts.erase(parts.begin() + 1);
    const std::string file = Portrait(Photo(), parts, Directories::kBoth, Lengths::kRight);
    CHECK(Difference(file, 128) == "");
    const Capture capture = OpenPhoto(file);
    CHECK(HasNote(capture, "already blurred"));
    CHECK(HasNote(capture, "the sharp picture in the file is ignored") == other);
  }
#ifdef STARFOCUS_HAS_EXIF
  for (const int rendered : {0, 1, 2, 6, 7, 8}) {
    CAPTURE(rendered);
    const std::string jpeg = Insert(Photo(), ExifSegment(1, 0, rendered));
    Capture capture = OpenPhoto(Gdepth(jpeg, kInverse, Data(RampPng())));
    CHECK(HasNote(capture, "already blurred the background of this portrait") == (rendered >= 7));
    CHECK((FactOf(capture, "portrait") != "") == (rendered >= 7));
    const std::string sharp = " GImage:Data=\"" + Base64(Photo()) + "\"";
    capture = OpenPhoto(Gdepth(jpeg, kInverse, Data(RampPng()) + sharp));
    CHECK(!HasNote(capture, "already blurred"));
  }
#endif
}

TEST_CASE("HEIF: the brands of still pictures and sequences are found anywhere in the list") {
  std::string file = Seed("heif/plain.avif");
  for (const std::string brand : {"avif", "avis", "miaf", "mif1"}) {
    CHECK(IsHeif(SpanOf(file.replace(8, 4, brand))));
  }
  CHECK(IsHeif(SpanOf(file.replace(8, 4, "abcd"))));  // other brands in the list remain
  CHECK(!IsHeif(SpanOf(Big(16, 4) + "ftypisom" + Big(0, 4))));
  CHECK(!IsHeif(SpanOf(file.substr(0, 7))));
}

TEST_CASE("HEIF: sizes are read from the headers of the codecs") {
  // The items refer to the bytes of the files.
  const std::string photo = Seed("heif/depth.heic"), avif = Seed("heif/plain.avif");
  const HeifItems items = ReadHeifItems(SpanOf(photo)).value();
  REQUIRE(items.size() == 4);
  CHECK(items.at(2).type == "grid");
  CHECK(items.at(2).inputs == std::vector<uint32_t>{1});
  CHECK(items.at(1).width == 64);
  const CodedSize hevc = HevcSize(items.at(1).configuration, items.at(1).head);
  CHECK(hevc.width == 64);
  CHECK(hevc.height == 64);
  const HeifItem item = ReadHeifItems(SpanOf(avif)).value().at(1);
  const CodedSize av1 = Av1Size(item.configuration, item.head);
  CHECK(av1.width == 24);
  CHECK(av1.height == 16);
}

TEST_CASE("HEIF: the auxiliary depth picture is read, and more than 8 bits are noted") {
  const auto read = [](const std::string& file) {
    return ReadHeif("x", SpanOf(file), Near::kUnknown);
  };
  const std::string depth = Seed("heif/depth.heic");
#ifdef STARFOCUS_HAS_HEIF
  const DepthPhoto photo = ValueOf(read(depth));
  CHECK(photo.picture.width == 16);
  REQUIRE(photo.map.values.size() == 16 * 16);
  // The depth differs between the left and the right side.
  CHECK(std::fabs(photo.map.at(0, 8) - photo.map.at(15, 8)) > 0.8F);
  for (const size_t size : {size_t{30}, depth.size() / 2, depth.size() - 1}) {
    CHECK(Contains(read(depth.substr(0, size)), "the HEIF file is truncated"));
  }
  const DepthPhoto deep = ValueOf(read(Seed("heif/ten_bits.heic")));
  CHECK(deep.notes.empty());
  REQUIRE(deep.lost.size() == 1);
  CHECK(Contains(deep.lost[0], "the pixels have 10 bits for each colour"));
  // The levels of the file increase from 100 to 856 of 1023.
  CHECK(deep.picture.width == 64);
  CHECK(std::abs(deep.picture.row(9)[0] - 25) < 10);
  CHECK(std::abs(deep.picture.row(9)[3 * 63] - 213) < 10);
  CHECK(ValueOf(read(Seed("heif/plain.avif"))).notes.empty());
#else
  CHECK(Contains(read(depth), "built without libheif"));
#endif
}

TEST_CASE("HEIF: a spatial photo has the pictures of its stereo group") {
  const std::string file = Seed("heif/stereo.heic");
  CHECK(HeifStereoPair(SpanOf(file)) == std::vector<uint32_t>{2, 4});
  for (size_t size = 0; size < file.size(); size += 7) {
    const std::vector<uint32_t> ids = HeifStereoPair(SpanOf(file.substr(0, size)));
    CHECK((ids.empty() || ids.size() == 2));
  }
  // A group of two equal pictures is not a pair.
  const std::string first = file.substr(file.find("ster") + 16, 4);
  CHECK(HeifStereoPair(SpanOf(Changed(file, "ster", 16, first))).empty());
#ifdef STARFOCUS_HAS_HEIF
  const Capture capture =
      ValueOf(OpenCapture(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/heif/stereo.heic", {}));
  CHECK(capture.format == "stereo pair (HEIF)");
  REQUIRE(capture.light_field.views.size() == 2);
  CHECK(capture.light_field.positions[1].u == 1);
  // The left picture is grey, and the right picture becomes brighter to the right.
  const uint8_t* left = capture.light_field.views[0].row(9);
  const uint8_t* right = capture.light_field.views[1].row(9);
  CHECK(std::abs(left[0] - left[3 * 39]) < 4);
  CHECK(right[3 * 39] - right[0] > 240);
#endif
}

}  // namespace
}  // namespace starfocus::photo_formats_test
