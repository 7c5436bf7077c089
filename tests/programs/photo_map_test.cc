// SPDX-License-Identifier: Apache-2.0
// Turns, resizes and scales the map of a photo, and scales the maps of the frames of a clip, which
// share one scale and one near end. The reference of a clip is one photo that contains all frames
// next to each other.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/readers/orientation.h"
#include "platform/readers/photo_scale.h"
#include "starfocus/starfocus.h"
#include "tests/programs/depth_scene.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"

namespace starfocus::photo_map_test {
namespace {

using namespace depth_scene;

constexpr int kFrames = 3, kSide = 24;

// Returns the level of a pixel, 0 (far) to 1. Each frame alone would have another scale or another
// near end: a hand is nearest in frame 1 only, and frame 2 shows a wall above a distant valley.
double LevelAt(int frame, int x, int y) {
  if (frame == 2) return y < 8 ? 0.3 : 0.1;
  if (frame == 1 && x < 8 && y >= 12) return 0.9;
  if (x >= 10 && x < 16) return 0.5;
  return y >= 16 ? 0.4 : 0.1;
}

enum class Format { kLevels8, kLevels16, kFloats };

// Returns a depth picture of frames `first` to `last`, next to each other.
std::string MapOf(Format format, bool white, int first, int last) {
  const int width = (last - first + 1) * kSide;
  FloatMap map = {width, kSide, {}};
  std::vector<uint16_t> levels;
  std::string pgm = "P5 " + std::to_string(width) + " " + std::to_string(kSide) + " 255\n";
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < width; ++x) {
      const double level = LevelAt(first + x / kSide, x % kSide, y),
                   stored = white ? level : 1 - level;
      map.values.push_back(static_cast<float>(stored));
      levels.push_back(static_cast<uint16_t>(std::lround(65535 * stored)));
      pgm.push_back(static_cast<char>(std::lround(255 * stored)));
    }
  }
  if (format == Format::kLevels8) return pgm;
  if (format == Format::kLevels16) return Png16(width, kSide, levels);
  return PfmOf(map);
}

Capture OpenMap(int width, const std::string& map, const DepthOptions& options) {
  return ValueOf(OpenWith(Plain(width, kSide, 128), map, {"", options}));
}

TEST_CASE("clip: disparities of frames are proportional to those of one photo with all frames") {
  for (const Format format : {Format::kLevels8, Format::kLevels16, Format::kFloats}) {
    for (const bool white : {true, false}) {
      for (const Near near : {Near::kUnknown, white ? Near::kWhite : Near::kBlack}) {
        if (format == Format::kFloats && !white && near == Near::kUnknown) continue;  // PFM: white
        CAPTURE(int(format));
        CAPTURE(white);
        CAPTURE(int(near));
        DepthOptions options;
        options.near = near;
        const Capture all = OpenMap(kFrames * kSide, MapOf(format, white, 0, kFrames - 1), options);
        std::vector<MapSurvey> surveys;
        for (int i = 0; i < kFrames; ++i) {
          surveys.push_back(OpenMap(kSide, MapOf(format, white, i, i), options).survey);
        }
        MapSurvey clip, backwards;
        for (int i = 0; i < kFrames; ++i) {
          clip.Add(surveys[size_t(i)]);
          backwards.Add(surveys[size_t(kFrames - 1 - i)]);
        }
        CHECK(clip.range.low == backwards.range.low);
        CHECK(clip.range.high == backwards.range.high);
        options.clip = &clip;
        // The scale depends on the diagonal of the picture.
        const double factor = std::hypot(kSide, kSide) / std::hypot(kFrames * kSide, kSide);
        for (int i = 0; i < kFrames; ++i) {
          const Capture frame = OpenMap(kSide, MapOf(format, white, i, i), options);
          double worst = 0;
          for (int k = 0; k < kSide * kSide; ++k) {
            const int x = k % kSide, y = k / kSide;
            const double expected = factor * At(all, i * kSide + x, y);
            const double found = At(frame, x, y);
            worst = std::max(worst, std::fabs(found - expected));
          }
          CAPTURE(i);
          CHECK(worst < 1e-4);
        }
      }
    }
  }
}

TEST_CASE("clip: 0 and 65535 are depths in all frames or in none") {
  // Levels of the second frame come close to 0, which therefore is a depth in both frames.
  std::vector<uint16_t> first(size_t(kSide) * kSide, 30000), second = first;
  for (size_t k = 0; k < first.size(); ++k) {
    if (k % 4 == 1) first[k] = 0;
    second[k] = static_cast<uint16_t>(k * 60 + 1);
  }
  const Capture alone = OpenMap(kSide, Png16(kSide, kSide, first), {});
  CHECK(HasNote(alone, "as unknown depth"));
  MapSurvey clip = alone.survey;
  clip.Add(OpenMap(kSide, Png16(kSide, kSide, second), {}).survey);
  DepthOptions options;
  options.clip = &clip;
  const Capture frame = OpenMap(kSide, Png16(kSide, kSide, first), options);
  CHECK(HasNote(frame, "as a known depth"));
  CHECK(!HasNote(frame, "filled"));
}

TEST_CASE("ApplyOrientation: each corner moves to the place that EXIF defines") {
  // EXIF 2.32, tag 274: the sides of the picture at which row 0 and column 0 of the file are.
  constexpr const char* kRows[] = {"top",  "top",   "bottom", "bottom",
                                   "left", "right", "right",  "left"};
  constexpr const char* kColumns[] = {"left", "right", "right",  "left",
                                      "top",  "top",   "bottom", "bottom"};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    DepthPhoto photo;
    photo.orientation = orientation;
    photo.picture = Plain(3, 2, 0);
    photo.map = {3, 2, {1, 2, 3, 4, 5, 6}};
    photo.picture.row(0)[0] = 200;  // pixel in row 0 and column 0 of the file
    photo.focus_x = photo.focus_y = 0.1;
    ApplyOrientation(&photo);
    const std::string row = kRows[orientation - 1], column = kColumns[orientation - 1];
    const Image& picture = photo.picture;
    CHECK(picture.width == (orientation < 5 ? 3 : 2));
    const bool right = row == "right" || column == "right",
               below = row == "bottom" || column == "bottom";
    const int x = right ? picture.width - 1 : 0, y = below ? picture.height - 1 : 0;
    CHECK(picture.row(y)[3 * x] == 200);
    CHECK(photo.map.at(x, y) == 1);
    CHECK(photo.focus_x == doctest::Approx(right ? 0.9 : 0.1));
    CHECK(photo.focus_y == doctest::Approx(below ? 0.9 : 0.1));
  }
}

TEST_CASE("Resize: maps are interpolated to the size of the picture, without unknown values") {
  const FloatMap large = Resize({2, 2, {0, 4, NAN, 8}}, 4, 2);
  const std::vector<float> expected = {0, 1, 3, 4, NAN, 8};
  for (size_t k = 0; k < expected.size(); ++k) {
    CHECK((large.values[k] == expected[k] || (k == 4 && std::isnan(large.values[k]))));
  }
}

TEST_CASE("MakePhotoField: interpolated disparities of a photo stay within the limit") {
  DepthPhoto photo;
  photo.picture = Plain(97, 61, 128);
  // All inverse distances are 1e6 per metre, so all points are at a distance of one micrometre.
  photo.map = {5, 3, std::vector<float>(15, 1e6F)};
  photo.meaning = MapMeaning::kInverseMetres;
  Result<LightField> made = MakePhotoField("photo", &photo);
  REQUIRE(made.error() == "");
  LightField& field = *made;
  FitMap(&field);
  REQUIRE(field.disparity.values.size() == 97 * 61);
  const auto [low, high] =
      std::minmax_element(field.disparity.values.begin(), field.disparity.values.end());
  CHECK(*low == float(STARFOCUS_MAX_DISPARITY));
  CHECK(*high == float(STARFOCUS_MAX_DISPARITY));
}

}  // namespace
}  // namespace starfocus::photo_map_test
