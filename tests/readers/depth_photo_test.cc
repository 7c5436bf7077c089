// SPDX-License-Identifier: Apache-2.0
// Reads depth photos of every kind in JPEG files that follow the specifications of the formats. The
// disparities must match the formulas in the specifications.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "platform/levels.h"
#include "platform/readers/capture.h"
#include "platform/readers/coded_size.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heic.h"
#include "platform/readers/heif_boxes.h"
#include "platform/readers/heif_limits.h"
#include "platform/readers/xmp.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"
#include "tests/support/seed_file.h"

namespace starfocus::depth_photo_test {
namespace {

using namespace photos;

TEST_CASE(
    "GDepth: inverse and linear ranges in metres become disparities by the focal length in EXIF") {
  if (!CanReadXmp()) return;
  Capture capture;
  REQUIRE(Open(Gdepth(Insert(Photo(), ExifSegment(1, 26)), kInverse + "GDepth:Units=\"m\"",
                      Data(RampPng())),
               &capture) == "");
#ifdef STARFOCUS_HAS_EXIF
  const double per_diopter = PerDiopter(26);
#else
  const double per_diopter = PerDiopter(50);
#endif
  CheckRamp(capture, per_diopter / 0.5, per_diopter / 4);
  CHECK(capture.photo);
  CHECK(capture.care == MapCare::kRepair);
  CHECK(capture.format == "GDepth photo (JPEG)");
  CHECK(FactOf(capture, "map") == "40x24, RangeInverse from 0.5 to 4 m");
  const double middle = double(capture.light_field.disparity.at(kWidth / 2, 0));
  const double level = std::floor(kWidth / 2 * 255.0 / (kWidth - 1)) / 255;
  CHECK(middle == doctest::Approx(per_diopter * ((1 - level) / 0.5 + level / 4)).epsilon(1e-4));
  capture = OpenRamp(Gdepth(Photo(),
                            "GDepth:Format=\"RangeLinear\" GDepth:Near=\"0.5\" GDepth:Far=\"4\" "
                            "GDepth:Units=\"m\"",
                            Data(RampPng())),
                     PerDiopter(50) / 0.5, PerDiopter(50) / 4);
  CHECK(double(capture.light_field.disparity.at(kWidth / 2, 0)) ==
        doctest::Approx(PerDiopter(50) / (0.5 + 3.5 * level)).epsilon(1e-4));
}

TEST_CASE("GDepth: ranges in millimetres and the distance in focus are read") {
  if (!CanReadXmp()) return;
  Capture capture;
  const std::string range =
      "GDepth:Format=\"RangeInverse\" GDepth:Near=\"500\" GDepth:Far=\"4000\" ";
  const std::string focus = "GFocus:FocalDistance=\"2000\" ";
  capture = OpenRamp(Gdepth(Photo(), range + focus + "GDepth:Units=\"mm\"", Data(RampPng())),
                     PerDiopter(50) / 0.5, PerDiopter(50) / 4);
  CHECK(!capture.has_focus);
  CHECK(capture.focus == doctest::Approx(PerDiopter(50) / 2));
  REQUIRE(Open(Gdepth(Photo(), range + focus, Data(RampPng())), &capture) == "");
  CHECK(capture.focus == doctest::Approx(kPortrait / 4));
}

TEST_CASE("GDepth: without units, the nearest point is assumed to be 1.5 m from a 50 mm lens") {
  if (!CanReadXmp()) return;
  Capture capture = OpenRamp(Gdepth(Photo(), kInverse, Data(RampPng())), kPortrait, kPortrait / 8);
  CHECK(FactOf(capture, "scale").find("unknown") == 0);
}

TEST_CASE(
    "GDepth: extended XMP in many segments in any order may hold maps of 8 and 16 bits and JPEG") {
  if (!CanReadXmp()) return;
  std::vector<uint16_t> levels;
  for (int k = 0; k < kWidth * kHeight; ++k) {
    levels.push_back(static_cast<uint16_t>(k % kWidth * 65535 / (kWidth - 1)));
  }
  const std::string maps[] = {RampPng(), Png16(kWidth, kHeight, levels)};
  for (const std::string& map : maps) {
    const std::string text = Packet(kGoogle, Data(map));
    std::vector<std::string> segments = ExtensionSegments(text, text.size() / 7);
    REQUIRE(segments.size() >= 7);
    std::reverse(segments.begin(), segments.end());
    std::swap(segments[1], segments[4]);
    const std::string main =
        Packet(kGoogle, std::string("xmpNote:HasExtendedXMP=\"") + kGuid + "\" " + kInverse);
    Capture capture =
        OpenRamp(Insert(Photo(), XmpSegment(main) + Joined(segments)), kPortrait, kPortrait / 8);
    if (map == maps[1]) {
      const double level = levels[1] / 65535.0;
      CHECK(double(capture.light_field.disparity.at(1, 0)) ==
            doctest::Approx(kPortrait * (1 - level * 7 / 8)).epsilon(1e-5));
    }
    segments.pop_back();
    CHECK(Contains(Open(Insert(Photo(), XmpSegment(main) + Joined(segments)), &capture),
                   "extended XMP"));
  }
  Capture capture;
  const std::string jpeg = Encode(Plain(kWidth / 2, kHeight / 2, 0), ".jpg");
  capture = OpenRamp(Gdepth(Photo(), kInverse + Data(jpeg), ""), kPortrait, kPortrait);
}

TEST_CASE(
    "GDepth: the embedded sharp picture and the focus are used and follow the EXIF orientation") {
  if (!CanReadXmp()) return;
  Image sharp = Plain(kWidth, kHeight, 0);
  std::fill_n(sharp.row(0), 12, uint8_t{255});  // the first pixels of the first row in the file
  const std::string photo = Insert(Photo(), ExifSegment(6, 0));
  Capture capture;
  REQUIRE(Open(Gdepth(photo,
                      kInverse +
                          "GFocus:FocalPointX=\"0.25\" GFocus:FocalPointY=\"0.125\" "
                          "GImage:Data=\"" +
                          Base64(Encode(sharp, ".png")) + "\"",
                      Data(RampPng())),
               &capture) == "");
#ifdef STARFOCUS_HAS_EXIF
  // Orientation 6: row 0 of the file is the right side of the upright picture, and column 0 of the
  // file is the top.
  const Image& upright = capture.light_field.views[0];
  REQUIRE(upright.width == kHeight);
  REQUIRE(upright.height == kWidth);
  CHECK(upright.row(0)[3 * (kHeight - 1)] == 255);
  CHECK(upright.row(3)[3 * (kHeight - 1)] == 255);
  CHECK(upright.row(4)[3 * (kHeight - 1)] == 0);
  CHECK(upright.row(0)[0] == 0);
  const FloatMap& map = capture.light_field.disparity;
  CHECK(map.at(5, 0) > map.at(5, kWidth - 1));
  CHECK(capture.has_focus);
  CHECK(capture.focus_x == int(0.875 * kHeight));
  CHECK(capture.focus_y == kWidth / 4);
  CHECK(FactOf(capture, "orientation").find("6 of EXIF") == 0);
#endif
}

TEST_CASE("GDepth: each malformed attribute or map is reported in one line") {
  if (!CanReadXmp()) return;
  Capture capture;
  const auto error = [&](const std::string& attributes, const std::string& extended) {
    const std::string line = Open(Gdepth(Photo(), attributes, extended), &capture).line();
    CHECK(Contains(line, ": expected "));
    CHECK(!Contains(line, "\n"));
    return line;
  };
  const std::string data = Data(RampPng());
  CHECK(Contains(error(kInverse, ""), "GDepth:Data"));
  CHECK(Contains(error(kInverse, "GDepth:Data=\"&#38;&#38;&#38;&#38;\""), "base64"));
  CHECK(Contains(error(kInverse, Data("no picture")), "picture"));
  const std::string tall = Encode(Plain(kHeight, kWidth, 9), ".png");
  CHECK(Contains(error(kInverse, Data(tall)), "the proportions of the picture"));
  const std::string whole = Gdepth(Photo(), kInverse, data);
  for (const size_t part : {size_t{3}, size_t{30}, whole.size() / 2, whole.size() - 2}) {
    CHECK(Contains(Open(whole.substr(0, part), &capture), "the JPEG file is truncated"));
  }
}

TEST_CASE("Dynamic Depth: the map is the item that the container names") {
  if (!CanReadXmp()) return;
  Capture capture;
  const std::string range =
      "DepthMap:Format=\"RangeInverse\" DepthMap:Near=\"0.5\" DepthMap:Far=\"4\" ";
  REQUIRE(Open(DynamicDepth(Photo(), RampPng(), range + "DepthMap:Units=\"Meters\""), &capture) ==
          "");
  CHECK(capture.format == "Dynamic Depth photo (JPEG)");
  CheckRamp(capture, PerDiopter(50) / 0.5, PerDiopter(50) / 4);
  capture = OpenRamp(DynamicDepth(Photo(), RampPng(), range + "DepthMap:Units=\"None\""), kPortrait,
                     kPortrait / 8);
  // With diopters as units, cameras store near and far as distances that are known only up to a
  // factor.
  capture = OpenRamp(DynamicDepth(Photo(), RampPng(), range + "DepthMap:Units=\"Diopters\""),
                     kPortrait, kPortrait / 8);
  CHECK(HasNote(capture, "diopters"));
  capture = OpenRamp(DynamicDepth(Photo(), RampPng(),
                                  "DepthMap:Format=\"RangeLinear\" DepthMap:Units=\"Meters\" "
                                  "DepthMap:Near=\"0\" DepthMap:Far=\"4\""),
                     kPortrait, 0);
  CHECK(HasNote(capture, "the range of the depth map is ignored"));
  // If the lengths are wrong, the map is found by the first bytes of a PNG or JPEG file.
  capture =
      OpenRamp(DynamicDepth(Photo(), RampPng(), range, 7) + "behind", kPortrait, kPortrait / 8);
  CHECK(HasNote(capture, "the wrong lengths of the container are ignored"));
  const std::string whole = DynamicDepth(Photo(), RampPng(), range);
  CHECK(Open(whole.substr(0, whole.size() - 1), &capture) != "");
  const std::string packet = Packet(
      "xmlns:Container=\"http://ns.google.com/photos/1.0/container/\" "
      "xmlns:Item=\"http://ns.google.com/photos/1.0/container/item/\"",
      "",
      "<Container:Directory><rdf:Seq><rdf:li rdf:parseType=\"Resource\"><Container:Item "
      "Item:Mime=\"image/jpeg\" Item:Semantic=\"Primary\"/></rdf:li><rdf:li "
      "rdf:parseType=\"Resource\"><Container:Item Item:Mime=\"image/png\" Item:Semantic=\"Depth\" "
      "Item:Length=\"" +
          std::to_string(RampPng().size()) + "\"/></rdf:li></rdf:Seq></Container:Directory>");
  CaptureOptions white;
  white.map.near = Near::kWhite;
  capture = OpenRamp(Insert(Photo(), XmpSegment(packet)) + RampPng(), 0, kPortrait, white);
}

TEST_CASE("Apple's JPEG: disparities are read from an auxiliary picture") {
  if (!CanReadXmp()) return;
  const std::string type = "<apdi:AuxiliaryImageType>disparity</apdi:AuxiliaryImageType>";
  const std::string range =
      "<apdi:FloatMinValue>0.5</apdi:FloatMinValue><apdi:FloatMaxValue>2</apdi:FloatMaxValue>";
  const auto file = [&](const std::string& elements) {
    return MultiPicture(Photo(), AppleMap(Encode(Ramp(kWidth, kHeight), ".jpg"), elements));
  };
  Capture capture;
  REQUIRE(Open(file(type + range), &capture) == "");
  CHECK(capture.format == "Apple depth photo (JPEG)");
  const FloatMap& map = capture.light_field.disparity;
  CHECK(double(map.at(kWidth - 1, 5)) == doctest::Approx(kPortrait).epsilon(0.01));
  CHECK(double(map.at(0, 5)) == doctest::Approx(kPortrait / 4).epsilon(0.05));
  REQUIRE(Open(file(type + range + "<depthData:Accuracy>absolute</depthData:Accuracy>"),
               &capture) == "");
  CHECK(double(map.at(kWidth - 1, 5)) == doctest::Approx(PerDiopter(50) * 2).epsilon(0.01));
  REQUIRE(Open(file(type), &capture) == "");
  CHECK(double(map.at(0, 5)) == doctest::Approx(0).epsilon(0.01));
  const std::string gain =
      "<apdi:AuxiliaryImageType>urn:com:apple:photo:2020:aux:hdrgainmap</apdi:AuxiliaryImageType>";
  CHECK(Contains(Open(file(gain), &capture), "a picture without one"));
}

TEST_CASE("depth pictures: file and near end are given by options, or found by name and guessed") {
  TempFolder folder;
  Image depth = Plain(kWidth, kHeight, 200);  // the lower half is darker, so black is near
  for (int y = kHeight / 2; y < kHeight; ++y) {
    std::fill_n(depth.row(y), depth.stride(), uint8_t{50});
  }
  Write(folder.file("a-image.jpg"), Photo());
  Require(WriteImage(folder.file("a-depth.png"), depth));
  Capture capture = ValueOf(OpenCapture(folder.file("a-image.jpg"), {}));
  const FloatMap& map = capture.light_field.disparity;
  CHECK(map.at(0, kHeight - 1) > map.at(0, 0));
  CHECK(capture.map_path == folder.file("a-depth.png"));
  REQUIRE(capture.notes.size() == 1);
  CHECK(Contains(capture.notes[0], "black"));
  CaptureOptions options;
  options.map.near = Near::kWhite;
  capture = ValueOf(OpenCapture(folder.file("a-image.jpg"), options));
  CHECK(map.at(0, kHeight - 1) < map.at(0, 0));
  CHECK(capture.notes.empty());
  Write(folder.file("b.jpg"), Photo());
  CHECK(Contains(OpenCapture(folder.file("b.jpg"), {}), "--depth"));
  options.depth = folder.file("a-depth.png");
  capture = ValueOf(OpenCapture(folder.file("b.jpg"), options));
  // The depth picture is rotated with the photo, unless the depth picture already has the
  // proportions of the rotated photo.
  Write(folder.file("c.jpg"), Insert(Photo(), ExifSegment(8, 0)));
#ifdef STARFOCUS_HAS_EXIF
  capture = ValueOf(OpenCapture(folder.file("c.jpg"), options));
  CHECK(map.width == kHeight);
  CHECK(map.at(0, 0) > map.at(kHeight - 1, 0));
  Image upright = Plain(kHeight, kWidth, 50);
  std::fill_n(upright.row(0), upright.stride(), uint8_t{200});
  Require(WriteImage(folder.file("upright.png"), upright));
  options.depth = folder.file("upright.png");
  capture = ValueOf(OpenCapture(folder.file("c.jpg"), options));
  CHECK(map.at(0, 0) > map.at(0, kWidth - 1));
  CHECK(map.at(kHeight - 1, 0) > map.at(0, kWidth - 1));
#endif
  FloatMap pfm = {2, 1, {3, 5}};
  Require(WritePfm(folder.file("b.pfm"), pfm));
  options.depth = folder.file("b.pfm");
  capture = ValueOf(OpenCapture(folder.file("b.jpg"), options));
  CHECK(map.at(kWidth - 1, 0) > map.at(0, 0));
}

TEST_CASE("photos: errors name the limits of segments, items, pictures and pixels") {
  Capture capture;
  std::string many;
  for (int k = 0; k < 4097; ++k) many += Segment(0xef, "");
  CHECK(Contains(Open(Insert(Photo(), many), &capture), "at most 4096 segments"));
  // The header declares 16000 x 16000 pixels with 16 bits in a file of one pixel.
  std::string png = Png16(1, 1, {7});
  const std::string header = "IHDR" + Big(16000, 4) + Big(16000, 4) + png.substr(24, 5);
  png = png.substr(0, 12) + header + Big(Crc(header), 4) + png.substr(33);
  Bytes bytes(png.begin(), png.end());
  CHECK(Contains(DecodeLevels("x", bytes), "truncated"));
  if (!CanReadXmp()) return;
  std::string items;
  for (int k = 0; k < 65; ++k) items += ContainerItem("image/png", 1, "other");
  const std::string packet =
      Packet(kDynamic, "", items + "<Camera:DepthMap DepthMap:DepthURI=\"other\"/>");
  CHECK(Contains(Open(Insert(Photo(), XmpSegment(packet)), &capture), "at most 64 items"));
}

TEST_CASE("XMP: errors name the limits, and document types are rejected") {
  if (!CanReadXmp()) return;
  const auto parse = [](const std::string& text) {
    return ParseXmp("x", text.data(), text.size());
  };
  std::string deep, many = "<a>";
  for (int k = 0; k < 40; ++k) deep += "<a>";
  CHECK(Contains(parse(deep), "at most 32 levels deep"));
  for (int k = 0; k < 20001; ++k) many += "<a/>";
  CHECK(Contains(parse(many + "</a>"), "at most 20000 elements"));
  many = "<a";
  for (int k = 0; k < 20001; ++k) many += " a" + std::to_string(k) + "=\"\"";
  CHECK(Contains(parse(many + "/>"), "at most 20000 elements and attributes"));
  CHECK(Contains(parse("<!DOCTYPE a [<!ENTITY b \"cccc\">]><a>&b;</a>"), "document type"));
  CHECK(Contains(parse("<a"), "well-formed"));
  CHECK(Contains(parse(std::string((size_t{1} << 26) + 1, ' ')), "at most 67108864 bytes"));
  const XmpNode root = ValueOf(parse("<a xmlns:n=\"space\" n:p=\" 1 \"><n:q> 2 </n:q></a>"));
  CHECK(XmpNumber(FindProperty(root, "space|p")) == 1.0);
  CHECK(XmpNumber(FindProperty(root, "space|q")) == 2.0);
  CHECK(!XmpNumber(FindProperty(root, "space|r")));
}

Span SpanOf(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
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

TEST_CASE("photos: EXIF of PNG and WebP rotates the picture like EXIF of JPEG") {
  // The first 10 bytes are the marker, the length and "Exif".
  const std::string segment = ExifSegment(1, 26);
  PictureOptions how;
  how.metadata.exif.assign(segment.begin() + 10, segment.end());
  for (const std::string name : {"photo.png", "photo.webp"}) {
    CAPTURE(name);
    TempFolder folder;
    if (CheckImageOutput(folder.file(name))) continue;
    Require(WriteImage(folder.file(name), Ramp(kWidth, kHeight), how));
    const Bytes bytes = ValueOf(ReadFile(folder.file(name)));
    const std::string written(bytes.begin(), bytes.end());
    // A build without libpng stores no EXIF.
    if (written.find("starfocus") == std::string::npos) continue;
    const DepthPhoto photo =
        ValueOf(DecodeDepthPhoto(name, SpanOf(Turned(written)), true, Near::kUnknown));
    CHECK(!photo.metadata.exif.empty());
#ifdef STARFOCUS_HAS_EXIF
    CHECK(photo.orientation == 6);
    CHECK(photo.focal_35mm == doctest::Approx(26));
#endif
  }
}

TEST_CASE("photos: profiles of grey pictures and incomplete profiles are omitted with a note") {
  const std::string profile = Profile(200);
  const auto read = [](const std::string& icc) {
    const std::string file =
        Insert(Photo(), Segment(0xe2, std::string("ICC_PROFILE\0\1\1", 14) + icc));
    return ValueOf(DecodeDepthPhoto("photo.jpg", SpanOf(file), true, Near::kUnknown));
  };
  CHECK(read(profile).metadata.icc.size() == 200);
  CHECK(read(profile.substr(0, 199)).metadata.icc.empty());
  const DepthPhoto photo = read(Profile(200, "GRAY"));
  CHECK(photo.metadata.icc.empty());
  REQUIRE(photo.notes.size() == 1);
  CHECK(Contains(photo.notes[0], "profile"));
}

TEST_CASE("coverage: the alpha channel of a 16-bit picture is used, or else the grey levels") {
  const std::string file = Seed("files/rgba16.png"), grey = Seed("files/gray.png");
  Bytes bytes(file.begin(), file.end());
  Samples samples = ValueOf(DecodeSamples("rgba16.png", Alpha::kTaken, bytes));
  CHECK(samples.largest == 65535);
  CHECK(samples.map.values[0] == 0x0607);
  CHECK(samples.map.values[1] == 0x0e0f);
  bytes.assign(grey.begin(), grey.end());
  samples = ValueOf(DecodeSamples("gray.png", Alpha::kTaken, bytes));
  CHECK(samples.map.values ==
        ValueOf(DecodeSamples("gray.png", Alpha::kIgnored, bytes)).map.values);
}

TEST_CASE("HEIF: the brands of still pictures and sequences are found anywhere in the list") {
  std::string file = Seed("heif/plain.avif");
  for (const std::string brand : {"avif", "avis", "miaf", "mif1"}) {
    CHECK(IsHeif(SpanOf(file.replace(8, 4, brand))));
  }
  CHECK(IsHeif(SpanOf(file.replace(8, 4, "abcd"))));  // other brands in the list remain
  CHECK(
      !IsHeif(SpanOf(std::string("\0\0\0\x10"
                                 "ftypisom\0\0\0\0",
                                 16))));
  CHECK(!IsHeif(SpanOf(file.substr(0, 7))));
}

TEST_CASE("HEIF: sizes are read from the headers of the codecs") {
  const std::string heic = Seed("heif/depth.heic"), avif = Seed("heif/plain.avif");
  const HeifItems items = ReadHeifItems(SpanOf(heic)).value();
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

#ifdef STARFOCUS_HAS_HEIF
TEST_CASE("HEIF: a picture of more than 8 bits is read, and a note states the lost bits") {
  const DepthPhoto photo =
      ValueOf(ReadHeif("a.heic", SpanOf(Seed("heif/ten_bits.heic")), Near::kUnknown));
  REQUIRE(photo.notes.size() == 1);
  CHECK(Contains(photo.notes[0], "the pixels have 10 bits for each colour"));
  // The levels of the file increase from 100 to 856 of 1023.
  CHECK(photo.picture.width == 64);
  CHECK(std::abs(photo.picture.row(9)[0] - 25) < 10);
  CHECK(std::abs(photo.picture.row(9)[3 * 63] - 213) < 10);
  const std::string eight_bits = Seed("heif/plain.avif");
  CHECK(ValueOf(ReadHeif("a.avif", SpanOf(eight_bits), Near::kUnknown)).notes.empty());
}
#endif

TEST_CASE("HEIF: a picture that refers to itself or declares a wrong size is rejected at once") {
  const auto error = [](const std::string& file) { return CheckHeif("a.heic", SpanOf(file)); };
  CHECK(error(Seed("heif/depth.heic")) == "");
  CHECK(error(Seed("heif/plain.avif")) == "");
  CHECK(Contains(error(Seed("heif/grid_of_itself.heic")), "found a 'grid' picture"));
  CHECK(Contains(error(Seed("heif/malformed_references.heic")), "boxes"));
  CHECK(Contains(error(Seed("heif/input_of_unknown_type.heic")), "found a 'hvc2' picture"));
  const std::string depth = Seed("heif/depth.heic"), size("\0\0\0\0", 4);
  // The grid in idat has two columns with one tile, and a width that differs from the width in
  // ispe.
  CHECK(Contains(error(Changed(depth, "idat", 3, "\1")), "grid"));
  CHECK(Contains(error(Changed(depth, "idat", 4, std::string("\x40\0", 2))), "grid"));
  CHECK(Contains(error(Changed(depth, "ispe", 4, std::string("\0\0\x40\0\0\0\x40\0", 8))),
                 "32768 pixels for each byte"));
  CHECK(Contains(error(Changed(depth, "ispe", 4, std::string("\0\0\x10\0\0\0\x10\0", 8))),
                 "not much larger"));
  // The product of width and height exceeds 64 bits. Sanitizers would detect an overflow.
  CHECK(Contains(error(Changed(depth, "ispe", 4, std::string("\xff\xff\xff\xff\xff\0\0\0", 8))),
                 "16384 pixels wide and high"));
  CHECK(Contains(error(Changed(depth, "dimg", 4, std::string("\0\x09", 2))), "a missing picture"));
  for (size_t cut = 40; cut < depth.size(); cut += 7)
    static_cast<void>(error(depth.substr(0, cut)));
}

}  // namespace
}  // namespace starfocus::depth_photo_test
