// SPDX-License-Identifier: Apache-2.0
// Reads valid but unusual photos of editors and some cameras. The readers must use the valid parts
// of a photo and add a note. Also tests which metadata the readers keep.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/readers/sample_bits.h"
#include "platform/readers/xmp.h"
#include "platform/writers/jpeg.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::odd_photo_test {
namespace {

using namespace photos;

// Checks that a GDepth photo with the given attributes opens with a note. The levels of a GDepth
// photo without a valid range define only an order, in which black is near by default.
void CheckOrder(const std::string& attributes) {
  CAPTURE(attributes);
  Capture capture;
  const std::string file = Gdepth(Photo(), attributes, Data(RampPng()));
  capture = OpenRamp(file, kPortrait, 0);
  CHECK(HasNote(capture, "the range of the depth map is ignored"));
  CaptureOptions white;
  white.map.near = Near::kWhite;
  capture = OpenRamp(file, 0, kPortrait, white);
}

TEST_CASE("GDepth: an invalid range is ignored, and levels define only an order") {
  if (!CanReadXmp()) return;
  const std::string inverse = "GDepth:Format=\"RangeInverse\" GDepth:Units=\"m\" ";
  const std::string linear = "GDepth:Format=\"RangeLinear\" GDepth:Mime=\"image/png\" ";
  for (const std::string& format : {inverse, linear}) {
    CheckOrder(format);
    CheckOrder(format + "GDepth:Near=\"0\" GDepth:Far=\"4\"");
    CheckOrder(format + "GDepth:Near=\"4\" GDepth:Far=\"4\"");
    CheckOrder(format + "GDepth:Near=\"nan\" GDepth:Far=\"4\"");
    CheckOrder(format + "GDepth:Near=\"0.5\"");
    CheckOrder(format + "GDepth:Near=\"0\" GDepth:Far=\"inf\"");
  }
  CheckOrder(linear + "GDepth:Near=\"0.5\" GDepth:Far=\"INF\"");
  CheckOrder("GDepth:Near=\"0.5\" GDepth:Far=\"4\"");
  CheckOrder("GDepth:Format=\"other\" GDepth:Near=\"0.5\" GDepth:Far=\"4\"");
  // The range of levels that are linear in the inverse distance may end at infinity.
  for (const char* far : {"INF", "inf", "Infinity", "+inf"}) {
    Capture capture =
        OpenRamp(Gdepth(Photo(), inverse + "GDepth:Near=\"0.5\" GDepth:Far=\"" + far + "\"",
                        Data(RampPng())),
                 PerDiopter(50) / 0.5, 0);
    CHECK(HasNote(capture, "infinite"));
  }
}

// Opens a photo with a depth picture next to the photo. The right end of the depth picture is near.
Error OpenBeside(const std::string& photo, Capture* capture) {
  TempFolder folder;
  Write(folder.file("photo.jpg"), photo);
  Write(folder.file("photo-depth.png"), RampPng());
  CaptureOptions options;
  options.map.near = Near::kWhite;
  Result<Capture> opened = OpenCapture(folder.file("photo.jpg"), options);
  if (opened) *capture = std::move(*opened);
  return opened.error();
}

TEST_CASE(
    "XMP that is lost or malformed is ignored, and the depth picture next to the photo is used") {
  if (!CanReadXmp()) return;
  const std::string lost =
      Packet(kGoogle, std::string("xmpNote:HasExtendedXMP=\"") + kGuid + "\" " + kInverse);
  const std::string text = Packet(kGoogle, Data(RampPng()));
  std::vector<std::string> gap = ExtensionSegments(text, text.size() / 5);
  gap.erase(gap.begin() + 2);
  struct Case {
    std::string segments, note;
  };
  const Case cases[] = {
      {XmpSegment(lost), "the extended XMP is ignored"},
      {XmpSegment(lost) + Joined(gap), "the extended XMP is ignored"},
      {XmpSegment(lost.substr(0, lost.size() / 2)), "XMP is ignored"},
      {XmpSegment("<a><b></a>"), "XMP is ignored"},
      {XmpSegment(Packet(kGoogle, kInverse + "GDepth:Data=\"????\"")), "base64"},
      {XmpSegment(Packet(kGoogle, kInverse + Data("no picture"))), "the depth map in the file"},
  };
  for (const Case& one : cases) {
    Capture capture;
    const std::string file = Insert(Photo(), one.segments);
    REQUIRE(OpenBeside(file, &capture) == "");
    CHECK(capture.format == "photo and depth picture");
    CheckRamp(capture, 0, kPortrait);
    CHECK(HasNote(capture, one.note));
    // If the depth picture is absent, the error must name the cause that the note names.
    const std::string error = Open(file, &capture).line();
    CHECK(Contains(error, ": expected a depth map"));
    if (one.note.find("the depth map") != 0) CHECK(Contains(error, one.note));
  }
}

TEST_CASE("extended XMP that no packet names is used if there is no other map") {
  if (!CanReadXmp()) return;
  const std::string names = std::string("xmpNote:HasExtendedXMP=\"") + kGuid + "\" ";
  std::string other = Joined(ExtensionSegments(Packet(kGoogle, Data(RampPng())), 300));
  for (size_t at = 0; (at = other.find(kGuid, at)) != std::string::npos;) other[at] = 'F';
  for (const std::string& packet : {Packet(kGoogle, names + kInverse), Packet(kGoogle, kInverse)}) {
    const std::string file = Insert(Photo(), XmpSegment(packet) + other);
    Capture capture = OpenRamp(file, kPortrait, kPortrait / 8);
    CHECK(HasNote(capture, "no XMP packet refers to"));
    CaptureOptions metres;
    metres.map.unit = DepthUnit::kDistance;
    TempFolder folder;
    Write(folder.file("a.jpg"), file);
    CHECK(Contains(OpenCapture(folder.file("a.jpg"), metres),
                   "for --depth-unit, found a depth map in the photo"));
    REQUIRE(OpenBeside(file, &capture) == "");
    CheckRamp(capture, 0, kPortrait);
    CHECK(!capture.notes.empty());
  }
}

TEST_CASE("XMP: the packet with the depth map is read, even if another packet is malformed") {
  if (!CanReadXmp()) return;
  const std::string rights = "xmlns:dc=\"http://purl.org/dc/elements/1.1/\" dc:format=\"x\"";
  const std::string depth = XmpSegment(Packet(kGoogle, kInverse + Data(RampPng())));
  for (const std::string& first : {Packet(rights, ""), std::string("<a")}) {
    for (const std::string& segments : {XmpSegment(first) + depth, depth + XmpSegment(first)}) {
      Capture capture = OpenRamp(Insert(Photo(), segments), kPortrait, kPortrait / 8);
      CHECK(HasNote(capture, "XMP is ignored") == (first == "<a"));
    }
  }
}

TEST_CASE("Apple's JPEG: the map is found if its index is wrong, moved or lost") {
  if (!CanReadXmp()) return;
  const std::string map = AppleMap(Encode(Ramp(kWidth, kHeight), ".jpg"),
                                   "<apdi:AuxiliaryImageType>disparity</apdi:AuxiliaryImageType>"
                                   "<apdi:FloatMinValue>1</apdi:FloatMinValue>"
                                   "<apdi:FloatMaxValue>2</apdi:FloatMaxValue>");
  Capture capture;
  const auto check = [&](const std::string& file, const std::string& note) {
    REQUIRE(Open(file, &capture) == "");
    const FloatMap& disparity = capture.light_field.disparity;
    CHECK(double(disparity.at(kWidth - 1, 5)) == doctest::Approx(kPortrait).epsilon(0.02));
    CHECK(double(disparity.at(0, 5)) == doctest::Approx(PerDiopter(50) / 3).epsilon(0.02));
    CHECK(capture.notes.empty() == note.empty());
    if (!note.empty()) CHECK(HasNote(capture, note));
  };
  const std::string wrong = "the wrong multi-picture index is ignored";
  for (const bool little : {false, true}) {
    check(MultiPicture(Photo(), map, {little}), "");
    check(MultiPicture(Photo(), map, {little, 2}), wrong);
    check(MultiPicture(Photo(), map, {little, 0xffffffff}), "");
    check(MultiPicture(Photo(), map, {little, 32, 1000}), wrong);
    check(MultiPicture(Photo(), map, {little, 32, 0x80000000}), wrong);
    // An editor inserts a segment before the index. The offsets in the index are relative to the
    // index and therefore remain valid.
    check(Insert(MultiPicture(Photo(), map, {little}), ExifSegment(1, 50)), "");
  }
  check(Photo() + map, "the file has no multi-picture index");
  check(Photo() + "something between\xff\xd8\xff" + map, "the file has no multi-picture index");
  const std::string whole = MultiPicture(Photo(), map);
  for (const size_t cut : {size_t{2}, map.size() / 2, map.size()}) {
    CHECK(Contains(Open(whole.substr(0, whole.size() - cut), &capture),
                   "a missing or truncated picture"));
  }
}

TEST_CASE("a stereo pair in one file has two views and no map") {
  Image right = Ramp(kWidth, kHeight);
  const std::string second = Encode(right, ".jpg");
  TempFolder folder;
  Capture capture;
  const auto open = [&](const std::string& name, const std::string& file) {
    Write(folder.file(name), file);
    Result<Capture> opened = OpenCapture(folder.file(name), {});
    if (!opened || LoadCapture({}, &*opened)) return false;
    capture = std::move(*opened);
    return capture.light_field.views.size() == 2;
  };
  for (const bool little : {false, true}) {
    for (const uint32_t type : {0u, 0x020002u, 0x20020002u}) {
      for (const uint32_t bytes : {32u, 2u}) {
        REQUIRE(open("a.mpo", MultiPicture(Photo(), second, {little, bytes, 0, type})));
        CHECK(capture.notes.empty() == (bytes == 32));
        CHECK(capture.map_path.empty());
        CHECK(!capture.photo);
        CHECK(capture.light_field.positions[0].u == 0);
        CHECK(capture.light_field.positions[1].u == 1);
        CHECK(capture.light_field.positions[1].v == 0);
        const Image& view = capture.light_field.views[1];
        CHECK(std::abs(view.row(5)[3 * (kWidth - 1)] - 255) < 8);
        CHECK(view.row(5)[0] < 8);
        REQUIRE(LoadCapture({{0, 0}}, &capture) == "");
        CHECK(capture.light_field.views.size() == 1);
      }
    }
  }
  CHECK(open("a.mpo", Photo() + second));
  // This index has an entry whose offset is wrong and whose type does not exist.
  CHECK(open("a.mpo", MultiPicture(Photo(), second, {false, 32, 5, 0x123456})));
  CHECK(open("a.jpg", MultiPicture(Photo(), second)));
  // The following files are not pairs: a file without any sign of a pair, pictures of different
  // sizes, a large preview, and a gain map.
  CHECK(!open("a.jpg", Photo() + second));
  CHECK(!open("a.mpo", MultiPicture(Photo(), Encode(Ramp(kWidth / 2, kHeight / 2), ".jpg"))));
  CHECK(!open("a.mpo", MultiPicture(Photo(), second, {false, 32, 0, 0x010002})));
  const std::string gain = "xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"";
  CHECK(!open("a.jpg", MultiPicture(Photo(), Insert(second, XmpSegment(Packet(gain, ""))))));
}

TEST_CASE("profiles: parts are joined by number, and incomplete or non-RGB profiles are omitted") {
  TempFolder folder;
  Write(folder.file("photo-depth.png"), RampPng());
  Capture capture;
  const auto open = [&](const std::string& segments) {
    Write(folder.file("photo.jpg"), Insert(Photo(), segments));
    capture = ValueOf(OpenCapture(folder.file("photo.jpg"), {}));
    const Bytes& icc = capture.metadata.icc;
    return std::string(icc.begin(), icc.end());
  };
  const std::string icc = Profile(1000);
  const auto left_out = [&](const std::string& segments) {
    return open(segments).empty() && HasNote(capture, "the colour profile is ignored");
  };
  std::vector<std::string> parts = ProfileSegments(icc, 4);
  CHECK(open(Joined(parts)) == icc);
  CHECK(!HasNote(capture, "profile"));
  std::reverse(parts.begin(), parts.end());
  CHECK(open(Joined(parts)) == icc);
  std::swap(parts[0], parts[2]);
  CHECK(open(Joined(parts)) == icc);
  CHECK(open("") == "");
  CHECK(!HasNote(capture, "profile"));
  CHECK(left_out(Joined({parts[0], parts[1], parts[2]})));
  CHECK(left_out(Joined({parts[0], parts[1], parts[2], parts[2]})));
  CHECK(left_out(Joined(ProfileSegments(icc.substr(0, 900), 2))));
  CHECK(left_out(Joined(ProfileSegments(Profile(300, "GRAY"), 1))));
  CHECK(left_out(Joined(ProfileSegments(Profile(300, "CMYK"), 2))));
}

TEST_CASE("captions: XMP and IPTC of a photo are kept, except properties of its depth map") {
  if (!CanReadXmp()) return;
  const std::string names =
      std::string(kGoogle) +
      " xmlns:dc=\"http://purl.org/dc/elements/1.1/\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" "
      "xmlns:tiff=\"http://ns.adobe.com/tiff/1.0/\"";
  const std::string title =
      "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">Cats &amp; dogs</rdf:li></rdf:Alt>"
      "</dc:title><GFocus:Extra>1</GFocus:Extra>";
  const std::string records("\x1c\x02\x78\0\3abc", 8);
  const std::string packet =
      Packet(names, kInverse + "xmp:Rating=\"4\" tiff:Orientation=\"6\" " + Data(RampPng()), title);
  Capture capture;
  REQUIRE(Open(Insert(Photo(), IptcSegment(records) + XmpSegment(packet) +
                                   XmpSegment(Packet(names, "xmp:Rating=\"1\""))),
               &capture) == "");
  CHECK(capture.metadata.xmp ==
        "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\" "
        "xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"><xmp:Rating>4</xmp:Rating><dc:title><rdf:Alt>"
        "<rdf:li xml:lang=\"x-default\">Cats &amp; dogs</rdf:li></rdf:Alt></dc:title>"
        "</rdf:Description>");
  CHECK(std::string(capture.metadata.iptc.begin(), capture.metadata.iptc.end()) == records);
  // The written captions must be readable, and the written file must not declare a depth map.
  Bytes jpeg = ValueOf(EncodeJpeg("x", Plain(kWidth, kHeight, 9), 90, capture.metadata, {}));
  Capture again;
  CHECK(Contains(Open({jpeg.begin(), jpeg.end()}, &again), "a picture without one"));
  REQUIRE(OpenBeside({jpeg.begin(), jpeg.end()}, &again) == "");
  CHECK(again.metadata.xmp == capture.metadata.xmp);
  CHECK(again.metadata.iptc == capture.metadata.iptc);
  // A photo without captions has no metadata, and truncated IPTC is ignored.
  REQUIRE(OpenBeside(Insert(Photo(), XmpSegment(Packet(kGoogle, kInverse)) +
                                         Segment(0xed, std::string("Photoshop 3.0\0", 14) +
                                                           "8BIM\4\4" + std::string(3, '\0'))),
                     &again) == "");
  CHECK(again.metadata.xmp.empty());
  CHECK(again.metadata.iptc.empty());
}

#ifdef STARFOCUS_HAS_EXIF
TEST_CASE("portraits: blur of the camera is named, unless the file has the sharp picture") {
  if (!CanReadXmp()) return;
  for (const int rendered : {0, 1, 2, 6, 7, 8}) {
    CAPTURE(rendered);
    const std::string jpeg = Insert(Photo(), ExifSegment(1, 0, rendered));
    const bool blurred = rendered >= 7;
    Capture capture;
    REQUIRE(Open(Gdepth(jpeg, kInverse, Data(RampPng())), &capture) == "");
    CHECK(HasNote(capture, "already blurred the background of this portrait") == blurred);
    CHECK((FactOf(capture, "portrait") != "") == blurred);
    const std::string sharp = " GImage:Data=\"" + Base64(Photo()) + "\"";
    REQUIRE(Open(Gdepth(jpeg, kInverse, Data(RampPng()) + sharp), &capture) == "");
    CHECK(!HasNote(capture, "already blurred"));
  }
}
#endif

TEST_CASE("photos: pixels of more than 8 bits are named, in photos and in folders of views") {
  const std::vector<uint16_t> grey(size_t(kWidth) * kHeight, 40000);
  const std::string note = "the pixels have 16 bits for each colour, of which the program";
  TempFolder folder;
  for (const bool deep : {false, true}) {
    CAPTURE(deep);
    const std::string png =
        deep ? Png16(kWidth, kHeight, grey) : Encode(Ramp(kWidth, kHeight), ".png");
    Write(folder.file("a.png"), png);
    Write(folder.file("a-depth.png"), RampPng());
    CHECK(HasNote(ValueOf(OpenCapture(folder.file("a.png"), {})), note) == deep);
    std::filesystem::create_directory(folder.file("lf"));
    Write(folder.file("lf/view_+0.0_+0.0.png"), png);
    CHECK(HasNote(ValueOf(OpenCapture(folder.file("lf"), {})), note) == deep);
  }
  const auto bits_of = [](const std::string& file) {
    return SampleBitsOf(Bytes(file.begin(), file.end()));
  };
  CHECK(bits_of("P6 1 1 255\n") == 8);
  CHECK(bits_of("P6 1 1 256\n") == 9);
  CHECK(bits_of("P5\n# 1\n1 1 1023\n") == 10);
  CHECK(bits_of("P6 1 1 65535\n") == 16);
  CHECK(bits_of("P") == 8);
  CHECK(bits_of("P6 1 1 x") == 8);
}

TEST_CASE("photos: an error names the type of the file") {
  Capture capture;
  const std::string photo = Photo(), png = RampPng();
  const auto error = [&](const std::string& bytes) { return Open(bytes, &capture); };
  CHECK(Contains(error(""), "found an empty file"));
  CHECK(Contains(error("A letter.\n"), "found a text file"));
  CHECK(Contains(error("GIF89a\1"), "found a GIF file"));
  CHECK(Contains(error(std::string("II*\0\1", 5)), "found a TIFF or raw file"));
  CHECK(Contains(error("version https://git-lfs.github.com/spec/v1\n"), "a pointer of Git LFS"));
  CHECK(Contains(error(std::string(100, '\0')), "found a file of zeros"));
  CHECK(Contains(error(png.substr(0, png.size() - 5)), "the PNG file is truncated"));
  CHECK(Contains(error(photo.substr(0, photo.size() / 2)), "the JPEG file is truncated"));
  TempFolder folder;
  CHECK(OpenCapture(folder.file("none.jpg"), {}) ==
        "cannot read " + folder.file("none.jpg") + ": no such file or directory");
}

}  // namespace
}  // namespace starfocus::odd_photo_test
