// SPDX-License-Identifier: Apache-2.0
// Opens the frames of a clip, whose depth maps share one scale and one near end. The reference is
// one photo that contains all frames next to each other.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "platform/pfm.h"
#include "platform/readers/capture.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"

namespace starfocus::clip_test {
namespace {

using namespace photos;

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
  TempFolder folder;
  Require(WritePfm(folder.file("map.pfm"), map));
  const Bytes bytes = ValueOf(ReadFile(folder.file("map.pfm")));
  return {bytes.begin(), bytes.end()};
}

Capture OpenMap(int width, const std::string& map, const DepthOptions& options) {
  TempFolder folder;
  Write(folder.file("photo.ppm"), Encode(Plain(width, kSide, 128), ".ppm"));
  Write(folder.file("map"), map);
  CaptureOptions capture;
  capture.depth = folder.file("map");
  capture.map = options;
  return ValueOf(OpenCapture(folder.file("photo.ppm"), capture));
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
          for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
              const double expected =
                  factor * double(all.light_field.disparity.at(i * kSide + x, y));
              const double found = double(frame.light_field.disparity.at(x, y));
              worst = std::max(worst, std::fabs(found - expected));
            }
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

}  // namespace
}  // namespace starfocus::clip_test
