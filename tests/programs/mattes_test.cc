// SPDX-License-Identifier: Apache-2.0
// Opens photos with mattes: separate files, as segmentation programs write them, and the mattes
// that photos store, which are Apple's mattes in HEIC and JPEG files, and masks of Dynamic Depth.
// The seed heif/mattes.heic shows a person, with a depth map and the mattes of the person, the
// hair, the skin and the sky, all of 128x64 pixels.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heif_boxes.h"
#include "platform/readers/matte.h"
#include "platform/readers/orientation.h"
#include "platform/readers/photo_scale.h"
#include "platform/readers/xmp.h"
#include "tests/programs/depth_scene.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::mattes_test {
namespace {

using namespace depth_scene;

// Alpha of a subject that is opaque in the box of the scene. Its left border is half covered.
FloatMap MatteMap() {
  FloatMap matte = MapOf({0, 0, 1});
  for (int y = 8; y < 26; ++y) matte.values[Index(16, y)] = 0.4F;
  return matte;
}

FloatMap Times(FloatMap map, float factor) {
  for (float& value : map.values) value *= factor;
  return map;
}

// Returns a dark picture with a bright box where the matte has the subject.
Image PictureOfBox() {
  Image picture = Plain(kColumns, kRows, 60);
  for (int y = 8; y < 26; ++y) std::fill_n(picture.row(y) + 3 * 16, 3 * 12, uint8_t{200});
  return picture;
}

// Opens a photo with the orientation, a matte, and a depth picture unless its content is empty.
Capture OpenMatted(int orientation, const std::string& matte, const CaptureOptions& options = {},
                   const std::string& depth = "") {
  return ValueOf(OpenWith(PictureOfBox(), depth, options, matte, orientation));
}

TEST_CASE("mattes: a photo without depth becomes two surfaces with the matte as coverage") {
  const Capture capture = OpenMatted(1, AlphaPng(MatteMap(), 1));
  const LightField& field = capture.light_field;
  REQUIRE(field.coverage.size() == size_t(kColumns) * kRows);
  for (size_t k = 0; k < field.coverage.size(); ++k) {
    const float alpha = MatteMap().values[k];
    CHECK(int(field.coverage[k]) == std::lround(255 * double(alpha)));
    // The engine rounds disparities to 1/64 pixel.
    CHECK(double(field.disparity.values[k]) ==
          doctest::Approx(alpha > 0.5F ? kNearest : 0).epsilon(0.5 / 64 / kNearest));
  }
  CHECK(capture.care == MapCare::kNone);
  CHECK(capture.format == "photo and matte");
}

TEST_CASE("mattes: every format of one matte gives the same light field") {
  // Values of 102/255 are exact in all formats.
  const FloatMap matte = MatteMap();
  std::string grey_and_opaque;
  for (const uint8_t alpha : Matte(matte).alpha) grey_and_opaque += Big(alpha, 1) + '\xff';
  const LightField field = OpenMatted(1, AlphaPng(matte, 1)).light_field;
  for (const std::string& file :
       {AlphaPng(matte, 4), PfmOf(matte), PfmOf(Times(matte, 255)), NpyOf(matte),
        NpyOf(Times(matte, 255)), NpyOf(Times(matte, 1.005F)), IntegerNpyOf(Times(matte, 255)),
        Png(kColumns, kRows, {8, 4}, grey_and_opaque, 2 * size_t(kColumns))}) {
    const LightField other = OpenMatted(1, file).light_field;
    CHECK(other.disparity.values == field.disparity.values);
    CHECK(std::equal(field.coverage.begin(), field.coverage.end(), other.coverage.begin(),
                     [](int a, int b) { return std::abs(a - b) <= 1; }));
  }
  // Masks of labels contain 0 and 1 only.
  for (const std::string& file :
       {AlphaPng(MapOf({0, 0, 1.0 / 255}), 1), IntegerNpyOf(MapOf({0, 0, 1}))}) {
    CHECK(OpenMatted(1, file).light_field.coverage[Index(20, 15)] == 255);
  }
}

#ifdef STARFOCUS_HAS_EXIF
TEST_CASE(
    "mattes: depth picture and matte are each rotated with the photo unless upright already") {
  // The map and the matte show the same box, which is not symmetric in any orientation.
  for (int orientation = 1; orientation <= 8; ++orientation) {
    FloatMap upright = MatteMap();
    TurnMap(orientation, &upright);
    for (const bool is_upright : {false, true}) {
      CAPTURE(orientation);
      CAPTURE(is_upright);
      const std::string matte = is_upright ? AlphaPng(upright, 1) : AlphaPng(MatteMap(), 4);
      CaptureOptions computed, told;
      // The picture that a command receives is upright, and so is its map.
      computed.map.near = Near::kWhite;
      computed.map.estimate = [&](const Image&) -> Result<Samples> { return Samples{upright}; };
      if (is_upright) told.map.orientation = DepthOrientation::kUpright;
      const Capture captures[] = {OpenMatted(orientation, matte),
                                  OpenMatted(orientation, matte, told),
                                  OpenMatted(orientation, matte, computed),
                                  OpenMatted(orientation, matte, {}, PfmOf(MatteMap())),
                                  OpenMatted(orientation, matte, {}, PfmOf(upright))};
      for (const Capture& capture : captures) {
        CHECK(capture.matte.alpha == Matte(upright).alpha);
        CHECK(capture.light_field.disparity.width == upright.width);
        for (size_t k = 0; k < upright.values.size(); ++k) {
          REQUIRE((capture.light_field.disparity.values[k] > 0.5 * kNearest) ==
                  (upright.values[k] > 0.5F));
        }
      }
      const bool judged = orientation > 1 && orientation < 5;
      CHECK(captures[0].light_field.coverage == Matte(upright).alpha);
      CHECK(HasNote(captures[0], "the matte is taken to be upright already") ==
            (judged && is_upright));
      CHECK((captures[1].notes.empty() || !is_upright));
    }
  }
}
#endif

TEST_CASE("mattes: a square matte is stretched over the picture, with a note") {
  for (const int orientation : {1, 6}) {
    const FloatMap square = Resize(MatteMap(), 2 * kColumns, 2 * kColumns);
    const Capture capture = OpenMatted(orientation, AlphaPng(square, 1));
    FloatMap upright = MatteMap();
    TurnMap(orientation, &upright);
    CHECK(HasNote(capture, "is stretched over the picture"));
    const std::vector<uint8_t>&given = capture.light_field.coverage,
          expected = Matte(upright).alpha;
    REQUIRE(given.size() == expected.size());
    int differing = 0;  // pixels beside outlines, which resampling softens
    for (size_t k = 0; k < given.size(); ++k) differing += std::abs(given[k] - expected[k]) > 60;
    CHECK(differing < 20);
  }
}

TEST_CASE("mattes: the floor reaches the subject at its feet") {
  CaptureOptions options;
  options.map.floor = true;
  const FloatMap map = OpenMatted(1, AlphaPng(MatteMap(), 1), options).light_field.disparity;
  // The subject is in rows 8 to 25 of 36, so that the horizon is at row 17 and the feet at row 26.
  CHECK(map.at(0, 16) == 0);
  CHECK(map.at(0, 17) > 0);
  CHECK(map.at(0, 21) == doctest::Approx(kNearest * 4.5 / 9).epsilon(0.05));
  for (const int y : {26, 35})
    CHECK(double(map.at(0, y)) == doctest::Approx(kNearest).epsilon(0.05));
}

TEST_CASE("mattes: with a map, the matte is the coverage of the outline that both share") {
  LightField field;
  field.views = {Plain(kColumns, kRows, 90)};
  // The map has a second surface at the right, which the matte does not contain.
  field.disparity = WithColumns(MapOf({0, 0, 20}), 40, kColumns, 20);
  ThreadRunner runner(2);
  REQUIRE(CoverByMatte("photo", Matte(MatteMap()), &runner, &field) == "");
  CHECK(field.coverage[Index(20, 15)] == 255);
  CHECK(std::abs(field.coverage[Index(16, 15)] - 102) <= 10);
  CHECK(field.coverage[Index(34, 15)] == 0);
  CHECK(field.coverage[Index(45, 15)] == 255);
}

// Returns the mean difference between the levels of a matte and the expected levels, 0 to 255.
template <class Level>
double Apart(const Matte& matte, const Level& expected) {
  double sum = 0;
  for (int y = 0; y < matte.height; ++y) {
    for (int x = 0; x < matte.width; ++x) {
      sum += std::fabs(matte.alpha[size_t(y) * size_t(matte.width) + size_t(x)] - expected(x, y));
    }
  }
  return sum / std::max(1.0, double(matte.width) * matte.height);
}

#ifdef STARFOCUS_HAS_HEIF
const std::string kWhole = "urn:com:apple:photo:2018:aux:portraiteffectsmatte";

// Level of a soft edge, `inside` pixels from the outline.
double Soft(double inside) { return 255 * std::clamp(inside / 3 + 0.5, 0.0, 1.0); }

// Levels of the mattes in the seed, as its author has drawn them.
double Head(int x, int y) { return Soft(14 - std::hypot(x + 0.5 - 48, y + 0.5 - 24)); }
double Person(int x, int y) {
  return std::max(Head(x, y), Soft(std::min(26 - std::fabs(x + 0.5 - 48), y + 0.5 - 36)));
}

// Returns the seed without its depth map.
std::string WithoutDepth() { return Changed(Seed("heif/mattes.heic"), "auxid:", 0, "9"); }

// Returns the file in which the type of an auxiliary picture is not the type of a matte.
std::string Without(std::string file, const std::string& type) {
  return file.replace(file.find(type) + type.size() - 1, 1, "x");
}

// Returns the file in which the data of the item `id` are damaged.
std::string Damaged(std::string file, uint32_t id) {
  const Bytes head = ReadHeifItems(SpanOf(file)).value().at(id).head;
  const size_t at = file.find(std::string(head.begin(), head.begin() + 40));
  REQUIRE(at != std::string::npos);
  return file.replace(at, 40, std::string(40, '\0'));
}

TEST_CASE("HEIC: beside a depth map, the portrait effects matte gives the matte of the subject") {
  const std::string file = Seed("heif/mattes.heic");
  const Capture capture = OpenPhoto(file);
  CHECK(capture.format == "HEIF depth photo");
  CHECK(FactOf(capture, "mattes") == "portrait effects; ignored: hair, skin, sky");
  CHECK(capture.notes.empty());
  CHECK(capture.matte.alpha.size() == 128 * 64);
  CHECK(Apart(capture.matte, Person) < 2);
  CHECK(At(capture, 48, 24) > 2 * At(capture, 100, 24));
  // Mattes turn with the picture.
  const Capture turned = OpenPhoto(Changed(file, "irot", 0, "\1"));
  CHECK(turned.matte.alpha.size() == 128 * 64);
  CHECK(turned.light_field.views[0].width == 64);
  CHECK(Apart(turned.matte, [](int x, int y) { return Person(127 - y, x); }) < 2);
}

TEST_CASE("HEIC: without a depth map, the matte divides the photo into two surfaces") {
  const Capture capture = OpenPhoto(WithoutDepth());
  CHECK(capture.format == "HEIF photo with a matte");
  const FloatMap& map = capture.light_field.disparity;
  CHECK(map.at(100, 24) == 0);
  const double nearest = PerDiopter(50) / 1.5 * std::hypot(128, 64) / std::hypot(kWidth, kHeight);
  CHECK(double(map.at(48, 24)) == doctest::Approx(nearest).epsilon(0.01));
  REQUIRE(capture.light_field.coverage.size() == 128 * 64);
  CHECK(capture.light_field.coverage[24 * 128 + 48] > 250);
  CHECK(capture.light_field.coverage[24 * 128 + 100] < 5);
  TempFolder folder;
  for (const std::string& file : {WithoutDepth(), Without(WithoutDepth(), kWhole)}) {
    Write(folder.file("photo.heic"), file);
    CHECK(StoresDepth(folder.file("photo.heic")));
  }
}

TEST_CASE("HEIC: without a portrait effects matte, hair and skin are the subject, with a note") {
  for (const std::string& file :
       {Without(Seed("heif/mattes.heic"), kWhole), Damaged(Seed("heif/mattes.heic"), 3)}) {
    const Capture capture = OpenPhoto(file);
    CHECK(HasNote(capture, "the matte of the subject contains only hair, skin"));
    // Where hair and skin meet, both are half transparent.
    CHECK(Apart(capture.matte, Head) < 3);
  }
}

TEST_CASE("HEIC: damaged mattes are ignored with a note if the photo has depth") {
  const std::string depth = Damaged(Damaged(Damaged(Seed("heif/mattes.heic"), 3), 4), 5);
  Capture capture = OpenPhoto(depth);
  for (const std::string name : {"portrait effects", "hair", "skin"}) {
    CHECK(HasNote(capture, "the " + name + " matte in the file is ignored: "));
  }
  CHECK(FactOf(capture, "mattes") == "ignored: hair, portrait effects, skin, sky");
  CHECK(capture.matte.alpha.empty());
  const Error error = Open(Changed(depth, "auxid:", 0, "9"), &capture);
  CHECK(Contains(error, "that can be read (the portrait effects matte in the file is ignored"));
  // A damaged depth map is ignored if the photo has a matte.
  capture = OpenPhoto(Damaged(Seed("heif/mattes.heic"), 2));
  CHECK(HasNote(capture, "the depth map in the file is ignored: "));
  CHECK(capture.format == "HEIF photo with a matte");
}
#endif

const std::string kWholeXml = AppleType("depth") +
                              "<apdi:AuxiliaryImageSubType>portraiteffectsmatte"
                              "</apdi:AuxiliaryImageSubType>";

// Returns a grey picture whose left half has the level `left`, and whose right half has the level
// `right`.
Image Halves(int width, int height, int left, int right) {
  Image image = Plain(width, height, right);
  for (int y = 0; y < height; ++y) {
    std::fill_n(image.row(y), image.stride() / 2, static_cast<uint8_t>(left));
  }
  return image;
}

// Returns a photo with a matte.
std::string AppleJpeg(const Image& matte, const std::string& elements) {
  return MultiPicture(Photo(), AppleMap(Encode(matte, ".jpg"), elements));
}

TEST_CASE("Apple's JPEG: a matte is never a depth map, and gives the matte of the subject") {
  if (!CanReadXmp()) return;
  const std::string disparity =
      AppleMap(Encode(Ramp(kWidth, kHeight), ".jpg"), AppleType("disparity") + kAppleRange);
  const Image matte = Halves(kWidth, kHeight, 255, 0);
  const auto is_left = [](int x, int) { return 2 * x < kWidth ? 255 : 0; };
  for (const std::string& type :
       {kWholeXml, AppleType("urn:com:apple:photo:2018:aux:portraiteffectsmatte"),
        AppleType("urn:com:apple:photo:2019:aux:semantichairmatte")}) {
    Capture capture = OpenPhoto(AppleJpeg(matte, type) + disparity);
    CHECK(capture.format == "Apple depth photo (JPEG)");
    CHECK(At(capture, 0, 5) == doctest::Approx(kPortrait / 4).epsilon(0.05));
    CHECK(Apart(capture.matte, is_left) < 2);
    capture = OpenPhoto(AppleJpeg(matte, type));
    CHECK(capture.format == "Apple photo with a matte (JPEG)");
    CHECK(At(capture, kWidth - 2, 5) == 0);
    CHECK(At(capture, 2, 5) == doctest::Approx(kPortrait).epsilon(0.01));
    CHECK(Apart(capture.matte, is_left) < 2);
  }
}

TEST_CASE("Apple's JPEG: a useless matte is an error without depth, and else a note") {
  if (!CanReadXmp()) return;
  const auto check = [](const Image& matte, const std::string& problem) {
    TempFolder folder;
    Write(folder.file("photo.jpg"), AppleJpeg(matte, kWholeXml));
    const Error error = OpenCapture(folder.file("photo.jpg"), {}).error();
    CHECK(Contains(error, "photo.jpg: expected a depth map"));
    CHECK(Contains(error, "the portrait effects matte in the file is ignored: expected a matte"));
    CHECK(Contains(error, problem));
    const bool fits = matte.width == kWidth;  // only opening decodes the picture
    CHECK(StoresDepth(folder.file("photo.jpg")) == !fits);
    Require(WriteImage(folder.file("photo-depth.png"), Ramp(kWidth, kHeight)));
    const Capture capture = ValueOf(OpenCapture(folder.file("photo.jpg"), {}));
    CHECK(HasNote(capture, problem));
    CHECK(capture.matte.alpha.empty());
  };
  check(Plain(kWidth, kHeight, 0), "an empty matte");
  check(Plain(kWidth, kHeight, 255), "a full matte");
  check(Halves(kHeight, kWidth, 255, 0), "24x40 for 40x24");
}

// Returns a portrait of Google's camera with the mask of the subject `mask`, whose range `format`
// describes. If `with_depth` is true, the portrait has a depth map, too.
std::string Masked(const Image& mask, const std::string& format, bool with_depth) {
  std::vector<Part> parts = PortraitParts(kWidth, kHeight);
  if (!with_depth) parts.erase(parts.begin() + 2);
  parts.push_back({"Segmentation", "android/mask", Encode(mask, ".jpg")});
  std::string file = Portrait(Photo(), parts, Directories::kLater, Lengths::kRight);
  const std::string map = "ItemSemantic=\"Depth\" DepthMap:Format=\"RangeInverse\"",
                    uri = "\"android/depthmap\"/>";
  if (!with_depth) {
    std::string described = "ItemSemantic=\"Segmentation\" " + format;
    described.resize(map.size(), ' ');  // the length of the segment must remain
    file.replace(file.find(map), map.size(), described);
    file.replace(file.find(uri), uri.size(), "\"android/mask\"/>    ");
  }
  return file;
}

Capture OpenMasked(const Image& mask, const std::string& format, Near near = Near::kUnknown,
                   bool with_depth = false) {
  const Capture capture = OpenPhoto(Masked(mask, format, with_depth), {"", NearIs(near)});
  CHECK(FactOf(capture, "picture") != "");
  CHECK(capture.format == "Dynamic Depth photo (JPEG)");
  return capture;
}

TEST_CASE("Dynamic Depth: a mask of the subject becomes the matte, with its soft levels") {
  if (!CanReadXmp()) return;
  const Image ramp = Ramp(kWidth, kHeight);
  const auto white = [](int x, int) { return x * 255 / (kWidth - 1); };
  const auto black = [&](int x, int y) { return 255 - white(x, y); };
  const std::string linear = "DepthMap:Format=\"x\"";
  for (const Near near : {Near::kUnknown, Near::kBlack}) {
    const Capture capture = OpenMasked(ramp, linear, near);
    CHECK(HasNote(capture, "a mask of the subject instead of a depth map, in which black is"));
    CHECK(FactOf(capture, "mattes") == "mask of the subject");
    CHECK(Apart(capture.matte, black) < 2);
    CHECK(At(capture, 0, 3) == doctest::Approx(kPortrait).epsilon(0.01));
    CHECK(At(capture, kWidth - 1, 3) == 0);
  }
  CHECK(Apart(OpenMasked(ramp, linear, Near::kWhite).matte, white) < 2);
  CHECK(Apart(OpenMasked(ramp, "", Near::kWhite).matte, white) < 2);
}

TEST_CASE("Dynamic Depth: in a mask without a range, the subject is in the middle at the bottom") {
  if (!CanReadXmp()) return;
  for (const int subject : {0, 255}) {
    // A person in the left half, and a cloud.
    Image mask = Plain(kWidth, kHeight, 255 - subject);
    for (int y = 4; y < kHeight; ++y) {
      const int from = y < 16 ? 10 : 5, to = y < 16 ? 20 : 25;
      std::fill(mask.row(y) + 3 * from, mask.row(y) + 3 * to, static_cast<uint8_t>(subject));
    }
    std::fill_n(mask.row(0) + 3 * 30, 18, static_cast<uint8_t>(subject));
    const Capture capture = OpenMasked(mask, "");
    CHECK(HasNote(capture, "because it is nearer to the middle of the lower edge"));
    CHECK(capture.matte.alpha[20 * size_t(kWidth) + 15] > 250);
    CHECK(capture.matte.alpha[20 * size_t(kWidth) + 35] < 5);
  }
  // In a file of orientation 6, the left edge is the upper edge of the picture.
  Image mask = Plain(kWidth, kHeight, 0);
  for (int y = 6; y < 18; ++y) std::fill(mask.row(y) + 30, mask.row(y) + 3 * kWidth, uint8_t{255});
  const Capture capture = OpenPhoto(Insert(Masked(mask, "", false), ExifSegment(6, 0)));
  CHECK(HasNote(capture, "in which white is the subject"));
  REQUIRE(capture.matte.width == kHeight);
  CHECK(capture.matte.alpha[35 * size_t(kHeight) + 12] > 250);
  CHECK(capture.matte.alpha[5 * size_t(kHeight) + 12] < 5);
}

TEST_CASE("Dynamic Depth: a mask is ignored if the photo has depth of any origin") {
  if (!CanReadXmp()) return;
  TempFolder folder;
  const std::string photo = folder.file("photo.jpg"), other = folder.file("other.png");
  const Image ramp = Ramp(kWidth, kHeight);
  Write(photo, Masked(ramp, "", false));
  Require(WriteImage(other, ramp));
  CaptureOptions estimated = {"", NearIs(Near::kWhite)};
  estimated.map.estimate = [&](const Image&) -> Result<Samples> {
    return DecodeSamples("", Alpha::kIgnored, ValueOf(ReadFile(other)));
  };
  std::vector<Capture> captures = {OpenMasked(ramp, "", Near::kUnknown, true),
                                   ValueOf(OpenCapture(photo, estimated)),
                                   ValueOf(OpenCapture(photo, {other, NearIs(Near::kWhite)}))};
  Require(WriteImage(folder.file("photo-depth.png"), ramp));
  captures.push_back(ValueOf(OpenCapture(photo, {"", NearIs(Near::kWhite)})));
  for (const Capture& capture : captures) {
    CHECK(capture.matte.alpha.empty());
    CHECK(!HasNote(capture, "mask of the subject"));
    CHECK(capture.light_field.coverage.empty());
    // All of them show the original of the portrait.
    CHECK(capture.light_field.views[0].pixels == captures[1].light_field.views[0].pixels);
    CHECK(std::abs(capture.light_field.views[0].pixels[0] - kOriginalLevel) <= 2);
    CHECK(FactOf(capture, "mattes") == "ignored: mask of the subject");
    const FloatMap& map = capture.light_field.disparity;
    // The map in the file is a JPEG file of distances, in which black is near.
    if (&capture != captures.data()) CHECK(map.values == captures[1].light_field.disparity.values);
    if (&capture == captures.data()) {
      CHECK(double(map.at(0, 3)) == doctest::Approx(kPortrait).epsilon(0.02));
    }
  }
}

TEST_CASE("Dynamic Depth: a separate matte replaces the mask in the file without a word about it") {
  if (!CanReadXmp()) return;
  TempFolder folder;
  const Image ramp = Ramp(kWidth, kHeight);
  Write(folder.file("matte.png"), Encode(ramp, ".png"));
  CaptureOptions options;
  options.matte = folder.file("matte.png");
  const Capture capture = OpenPhoto(Masked(ramp, "DepthMap:Format=\"x\"", false), options);
  CHECK(FactOf(capture, "mattes") == "");
  CHECK(FactOf(capture, "matte picture") == options.matte);
  CHECK(!HasNote(capture, "mask of the subject"));
  CHECK(Apart(capture.matte, [](int x, int) { return x * 255 / (kWidth - 1); }) < 2);
}

TEST_CASE("stored mattes: empty and full masks, and --near for other mattes are rejected") {
  if (!CanReadXmp()) return;
  const struct {
    std::string file, error;
    Near near;
  } rows[] = {{Masked(Plain(kWidth, kHeight, 255), "DepthMap:Format=\"x\"", false),
               "found an empty matte", Near::kUnknown},
              {Masked(Plain(kWidth, kHeight, 0), "DepthMap:Format=\"x\"", false),
               "found a full matte", Near::kUnknown},
              {AppleJpeg(Halves(kWidth, kHeight, 255, 0), kWholeXml),
               "for --near, found a matte without depth", Near::kWhite}};
  for (const auto& row : rows) {
    Capture capture;
    const Error error = Open(row.file, &capture, {"", NearIs(row.near)});
    CHECK(Contains(error, "photo.jpg: expected a"));
    CHECK(Contains(error, row.error));
  }
}

}  // namespace
}  // namespace starfocus::mattes_test
