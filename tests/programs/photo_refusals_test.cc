// SPDX-License-Identifier: Apache-2.0
// Tables of files that the readers of photos reject, each with a part of the error. A new error is
// a new row of the table for its kind of file: photos, depth pictures, mattes, XMP or HEIF.
// photo_formats_test.cc has the valid photos. The last cases check what an untrusted photo may do:
// the memory that decoding it takes is estimated before, and a helper process that a file has taken
// over can send only valid photos.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/helper/helper.h"
#include "platform/image_io.h"
#include "platform/readers/capture.h"
#include "platform/readers/confined_photo.h"
#include "platform/readers/decoding_memory.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heic.h"
#include "platform/readers/heif_limits.h"
#include "platform/readers/xmp.h"
#include "platform/text.h"
#include "platform/writers/deep_picture.h"
#include "tests/programs/depth_scene.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::photo_refusals_test {
namespace {

using namespace depth_scene;

struct Row {
  std::string file, error;
};

// Checks that each file is rejected in one line. `open` returns the error line of a file.
template <class Open>
void CheckRefused(const std::vector<Row>& rows, const Open& open) {
  for (const Row& row : rows) {
    CAPTURE(row.error);
    const std::string error = open(row.file);
    CHECK(Contains(error, row.error));
    CHECK(!Contains(error, "\n"));
  }
}

TEST_CASE("photos: files of other types, truncated files and files beyond a limit are rejected") {
  const std::string photo = Photo(), png = RampPng();
  std::string segments;
  for (int k = 0; k < 4097; ++k) segments += Segment(0xef, "");
  // The header declares 16000 x 16000 pixels with 16 bits in a file of one pixel.
  const std::string pixel = Png16(1, 1, {7});
  const std::string header = "IHDR" + Big(16000, 4) + Big(16000, 4) + pixel.substr(24, 5);
  std::vector<Row> rows = {
      {"", "found an empty file"},
      {"A letter.\n", "found a text file"},
      {"GIF89a\1", "found a GIF file"},
      {std::string("II*\0\1", 5), "TIFF"},
      {"v/1\x01 and more", "OpenEXR"},
      {"%PDF", "found a PDF file"},
      {"version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS"},
      {std::string(100, '\0'), "found a file of zeros"},
      {png.substr(0, png.size() - 5), "the PNG file is truncated"},
      {pixel.substr(0, 12) + header + Big(Crc(header), 4) + pixel.substr(33), "truncated"},
      {photo.substr(0, photo.size() / 2), "the JPEG file is truncated"},
      {photo, ": expected a depth map"},
      {photo, "--depth"},
      {Insert(photo, segments), "at most 4096 segments"}};
  const std::string whole = Gdepth(photo, kInverse, Data(png));
  for (const size_t size : {size_t{3}, size_t{30}, whole.size() / 2, whole.size() - 2}) {
    rows.push_back({whole.substr(0, size), "the JPEG file is truncated"});
  }
  CheckRefused(rows, [](const std::string& file) {
    Capture capture;
    return Open(file, &capture).line();
  });
  TempFolder folder;
  CHECK(OpenCapture(folder.file("none.jpg"), {}) ==
        "cannot read " + folder.file("none.jpg") + ": no such file or directory");
}

TEST_CASE("depth photos: malformed attributes, maps, items and indices are rejected") {
  if (!CanReadXmp()) return;
  const std::string photo = Photo();
  const auto gdepth = [&](const std::string& attributes, const std::string& extended) {
    return Gdepth(photo, attributes, extended);
  };
  const std::string tall = Encode(Plain(kHeight, kWidth, 9), ".png");
  const std::string text = Packet(kGoogle, Data(RampPng()));
  std::vector<std::string> segments = ExtensionSegments(text, text.size() / 7);
  segments.pop_back();
  const std::string named = Packet(kGoogle, kGuidName + kInverse);
  std::string items;
  for (int k = 0; k < 65; ++k) items += ContainerItem("image/png", 1, "other");
  items += "<Camera:DepthMap DepthMap:DepthURI=\"other\"/>";
  const std::string dynamic = DynamicDepth(
      photo, RampPng(), "DepthMap:Format=\"RangeInverse\" DepthMap:Near=\"1\" DepthMap:Far=\"4\"");
  const std::string map = AppleMap(Encode(Ramp(kWidth, kHeight), ".jpg"), AppleType("disparity"));
  const std::string apple = MultiPicture(photo, map), lost = "a missing or truncated picture";
  const std::string gain = AppleType("urn:com:apple:photo:2020:aux:hdrgainmap");
  const std::vector<Row> rows = {
      {gdepth(kInverse, ""), "GDepth:Data"},
      {gdepth(kInverse, "GDepth:Data=\"&#38;&#38;&#38;&#38;\""), "base64"},
      {gdepth(kInverse, Data("no picture")), "picture"},
      {gdepth(kInverse, Data(tall)), "the proportions of the picture"},
      {Insert(photo, XmpSegment(named) + Joined(segments)), "extended XMP"},
      {dynamic.substr(0, dynamic.size() - 1), "no complete picture there"},
      {Insert(photo, XmpSegment(Packet(kDynamic, "", items))), "at most 64 items"},
      {MultiPicture(photo, AppleMap(photo, gain)), "a picture without one"},
      {apple.substr(0, apple.size() - 2), lost},
      {apple.substr(0, apple.size() - map.size() / 2), lost},
      {apple.substr(0, apple.size() - map.size()), lost}};
  CheckRefused(rows, [](const std::string& file) {
    Capture capture;
    const std::string error = Open(file, &capture).line();
    CHECK(Contains(error, ": expected "));
    return error;
  });
}

TEST_CASE("depth pictures: values, types and sizes that do not fit are rejected") {
  Image colours(kColumns, kRows);
  for (size_t k = 0; k < colours.pixels.size(); k += 3) {
    colours.pixels[k] = static_cast<uint8_t>(k / 21);
    colours.pixels[k + 2] = static_cast<uint8_t>(255 - k / 21);
  }
  const auto open_with = [](const DepthOptions& options) {
    return [options](const std::string& file) { return OpenMap(file, options).error().line(); };
  };
  std::vector<Row> rows = {
      {PfmOf({kColumns, kRows, std::vector<float>(1728, kNan)}), "a map with known depths"}};
  for (const char* extension : {".png", ".jpg", ".ppm"}) {
    rows.push_back({Encode(colours, extension), "a colour picture"});
  }
  for (const auto& [width, height] : {std::pair<int, int>{48, 32}, {48, 40}, {36, 36}, {36, 48}}) {
    rows.push_back(
        {Encode(Ramp(width, height), ".png"), "a depth map with the proportions of the picture"});
  }
  CheckRefused(rows, open_with({}));
  CheckRefused({{PfmOf(MapOf({2, 3, 501})), "disparities from -500 to 500"}},
               open_with(UnitIs(DepthUnit::kDisparity)));
  CheckRefused(
      {{NpyOf(MapOf({3, 2, 1})), "found floats"},
       {Encode(Plain(kColumns, kRows, 9), ".png"),
        "expected integers of 16 bits for --depth-unit depth16, found integers of 8 bits"}},
      open_with(UnitIs(DepthUnit::kDepth16)));
}

TEST_CASE("mattes: unsuitable mattes are rejected with their cause") {
  FloatMap nan = MapOf({0, 0, 1});
  nan.values[5] = kNan;
  CheckRefused(
      {{Encode(Plain(kColumns, kRows, 0), ".png"), "an empty matte, alpha up to 0"},
       {Encode(Plain(kColumns, kRows, 100), ".png"), "an empty matte, alpha up to 0.392157"},
       {Encode(Plain(kColumns, kRows, 255), ".png"), "a full matte"},
       {Encode(Noise(kColumns, kRows), ".png"), "found an opaque colour picture"},
       {Encode(Ramp(40, 36), ".png"),
        "a matte with the proportions of the picture, or a square matte of a network, found "
        "40x36 for 48x36"},
       {AlphaPng(MapOf({0, 0, 1.0 / 255}), 4), "an empty matte, alpha up to 0.00392157"},
       {NpyOf(MapOf({0, 0, 1.03})),
        "expected alpha from 0 to 1 or from 0 to 255, found values from 0 to 1.03"},
       {IntegerNpyOf(MapOf({0, 0, 2})), "found values from 0 to 2"},
       {IntegerNpyOf(MapOf({0, 0, 65535})), "found values from 0 to 65535"},
       {NpyOf(MapOf({-12, -12, 9})), "found values from -12 to 9"},
       {NpyOf(MapOf({0, 0, 3000})), "found values from 0 to 3000"},
       {NpyOf(nan), "found NaN or infinity"},
       {"no picture", "(convert the matte to PNG)"},
       {"v/1\x01 and more", "OpenEXR"}},
      [](const std::string& matte) {
        return OpenWith(Plain(kColumns, kRows, 90), "", {}, matte).error().line();
      });
}

TEST_CASE("XMP: document types and packets beyond a limit are rejected") {
  if (!CanReadXmp()) return;
  const auto parse = [](const std::string& text) {
    return ParseXmp("x", text.data(), text.size());
  };
  std::string deep, elements = "<a>", attributes = "<a";
  for (int k = 0; k < 40; ++k) deep += "<a>";
  for (int k = 0; k < 20001; ++k) {
    elements += "<a/>";
    attributes += " a" + std::to_string(k) + "=\"\"";
  }
  CheckRefused({{deep, "at most 32 levels deep"},
                {elements + "</a>", "at most 20000 elements"},
                {attributes + "/>", "at most 20000 elements and attributes"},
                {"<!DOCTYPE a [<!ENTITY b \"cccc\">]><a>&b;</a>", "document type"},
                {"<a", "well-formed"},
                {std::string((size_t{1} << 26) + 1, ' '), "at most 67108864 bytes"}},
               [&](const std::string& text) { return parse(text).error().line(); });
  const XmpNode root = ValueOf(parse("<a xmlns:n=\"space\" n:p=\" 1 \"><n:q> 2 </n:q></a>"));
  CHECK(XmpNumber(FindProperty(root, "space|p")) == 1.0);
  CHECK(XmpNumber(FindProperty(root, "space|q")) == 2.0);
  CHECK(!XmpNumber(FindProperty(root, "space|r")));
}

TEST_CASE("HEIF: a picture that refers to itself or declares a wrong size is rejected at once") {
  const auto check = [](const std::string& file) {
    return CheckHeif("a.heic", SpanOf(file)).line();
  };
  const std::string depth = Seed("heif/depth.heic");
  const auto sized = [&](const char* bytes) {  // the size in ispe is 8 bytes
    return Changed(depth, "ispe", 4, std::string(bytes, 8));
  };
  CheckRefused(
      {{Seed("heif/grid_of_itself.heic"), "found a 'grid' picture"},
       {Seed("heif/malformed_references.heic"), "boxes"},
       {Seed("heif/input_of_unknown_type.heic"), "found a 'hvc2' picture"},
       // The grid in idat has two columns with one tile, and a width that differs from the width in
       // ispe.
       {Changed(depth, "idat", 3, "\1"), "grid"},
       {Changed(depth, "idat", 4, std::string("\x40\0", 2)), "grid"},
       {sized("\0\0\x40\0\0\0\x40\0"), "32768 pixels for each byte"},
       {sized("\0\0\x10\0\0\0\x10\0"), "not much larger"},
       // The product of width and height exceeds 64 bits. Sanitizers would detect an overflow.
       {sized("\xff\xff\xff\xff\xff\0\0\0"), "16384 pixels wide and high"},
       {Changed(depth, "dimg", 4, std::string("\0\x09", 2)), "a missing picture"}},
      check);
  CHECK(check(depth) == "");
  CHECK(check(Seed("heif/plain.avif")) == "");
  for (size_t cut = 40; cut < depth.size(); cut += 7)
    static_cast<void>(check(depth.substr(0, cut)));
}

TEST_CASE("decoding_memory: every photo takes at most the estimated memory, and not much less") {
  int photos = 0;
  for (const char* folder : {"photo", "heif"}) {
    for (const auto& entry : std::filesystem::directory_iterator(
             STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/" + std::string(folder))) {
      const std::string path = entry.path().string();
      CAPTURE(path);
      const Bytes bytes = ValueOf(ReadFile(path));
      const Span file = {bytes.data(), bytes.size()};
      const Result<DepthPhoto> photo = DecodeDepthPhoto(path, file, true, Near::kWhite);
      if (!photo) continue;
      ++photos;
      const uint64_t held = photo->picture.pixels.size() + photo->right.pixels.size() +
                            photo->map.values.size() * sizeof(float) +
                            (photo->deep ? 2 * photo->deep->samples.size() : 0) +
                            photo->gain_map.levels.size() * sizeof(uint16_t);
      CHECK(DecodingBytes(file) >= 2 * held);
      // HEIF pictures are padded to blocks of 64 x 64 pixels.
      CHECK(DecodingBytes(file) <= 131072 + 64 * photo->picture.pixels.size());
    }
  }
  CHECK(photos >= 10);
}

TEST_CASE("decoding_memory: the size comes from the header in each format") {
  for (const std::string name : {"a.png", "a.jpg", "a.ppm", "a.webp"}) {
    CAPTURE(name);
    const Result<Bytes> bytes = EncodePicture(name, Image(37, 21), {});
    if (name == "a.webp" && !bytes) continue;  // a build without libwebp
    const uint64_t estimate = DecodingBytes({bytes->data(), bytes->size()});
    CHECK(estimate >= 37 * 21 * 16);
    CHECK(estimate <= 3 * 37 * 22 * 16);
  }
  for (const std::string name : {"a.png", "a.tif", "a.exr"}) {
    CAPTURE(name);
    std::vector<std::string> notes;
    const Result<Bytes> bytes = EncodeDeepPicture(name, DeepImage(37, 21, 4), {}, &notes);
    if (!bytes) continue;  // a build without the library
    CHECK(DecodingBytes({bytes->data(), bytes->size()}) == 37 * 21 * 32);
  }
  for (const std::string text : {"", "II*", "\xff\xd8\xff", "RIFF    WEBP", "\x89PNG\r\n"}) {
    CHECK(DecodingBytes(SpanOf(text)) == UINT64_MAX);
  }
}

TEST_CASE("confined_photo: texts arrive without control characters, and paths do not arrive") {
  ConfineDecoders();
  if (!DecodersAreConfined()) return;
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  const std::string evil = "a\x1b]0;owned\a\n\r\xc2\x9b" + all;
  DepthPhoto sent;
  sent.format = sent.map_problem = sent.depth_path = evil;
  sent.facts = {{evil, evil}};
  sent.notes = {evil, std::string(100000, 'x')};
  const Result<DepthPhoto> photo =
      Confined<DepthPhoto>("photo.jpg", [&] { return Result<DepthPhoto>(sent); });
  REQUIRE(photo);
  for (const std::string& text : {photo->format, photo->map_problem, photo->facts[0].first,
                                  photo->facts[0].second, photo->notes[0]}) {
    CHECK(text == Printable(evil));
    CHECK(text != evil);
  }
  CHECK(photo->notes[1].size() == 65536);
  CHECK(photo->depth_path.empty());
}

TEST_CASE("confined_photo: numbers of a photo that no decoder can find are rejected") {
  ConfineDecoders();
  if (!DecodersAreConfined()) return;
  using Field = double DepthPhoto::*;
  for (const Field field : {&DepthPhoto::focus_x, &DepthPhoto::focus_y, &DepthPhoto::subject_x,
                            &DepthPhoto::subject_y, &DepthPhoto::focal_35mm}) {
    for (const double value : {-1.0, 1e308, double{NAN}, double{INFINITY}, -1e-300}) {
      DepthPhoto photo;
      photo.*field = value;
      CHECK(Confined<DepthPhoto>("p", [&] { return Result<DepthPhoto>(photo); }).error() != "");
    }
  }
}

}  // namespace
}  // namespace starfocus::photo_refusals_test
