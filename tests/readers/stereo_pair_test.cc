// SPDX-License-Identifier: Apache-2.0
// Opens stereo pairs in a HEIF file and in two files, and aligns pairs whose points differ in
// height.
#include "platform/readers/stereo_pair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "platform/readers/capture.h"
#include "platform/readers/heif_boxes.h"
#include "platform/readers/pair_alignment.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::stereo_pair_test {
namespace {

using namespace photos;

constexpr int kSide = 160;
const std::string kSpatial = STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/heif/stereo.heic";

// Returns a pseudorandom level, 0 to 255, for a point of a grid.
double LevelOf(int x, int y, int seed) {
  uint32_t hash = uint32_t(x) * 374761393u + uint32_t(y) * 668265263u + uint32_t(seed) * 974634749u;
  hash = (hash ^ (hash >> 13)) * 1274126177u;
  return (hash ^ (hash >> 16)) & 255;
}

// Returns a picture of a random texture. Pixel (x, y) shows point (x + dx, y + dy), after a
// rotation of the picture around its centre. `seed` selects the texture.
Image Texture(double dx, double dy, double rotation, int seed = 0) {
  constexpr double kGrid = 4;  // distance between the random levels in pixels
  Image image(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double u = x - kSide / 2, v = y - kSide / 2;
      const double a = (x + dx - rotation * v + kSide) / kGrid;
      const double b = (y + dy + rotation * u + kSide) / kGrid;
      const int i = int(a), j = int(b);
      const auto between = [&](int row) {
        return LevelOf(i, row, seed) +
               (a - i) * (LevelOf(i + 1, row, seed) - LevelOf(i, row, seed));
      };
      const double level = between(j) + (b - j) * (between(j + 1) - between(j));
      std::fill_n(image.row(y) + 3 * x, 3, static_cast<uint8_t>(level));
    }
  }
  return image;
}

// Returns the mean difference between the middle parts of two pictures.
double MeanApart(const Image& a, const Image& b) {
  constexpr int kEdge = 20;
  double sum = 0;
  for (int y = kEdge; y < kSide - kEdge; ++y) {
    for (int k = 3 * kEdge; k < 3 * (kSide - kEdge); ++k)
      sum += std::abs(a.row(y)[k] - b.row(y)[k]);
  }
  return sum / (3 * (kSide - 2 * kEdge) * (kSide - 2 * kEdge));
}

DepthPhoto PairOf(const Image& left, const Image& right) {
  DepthPhoto photo;
  photo.picture = left;
  photo.right = right;
  return photo;
}

TEST_CASE("stereo pair: points of the right picture are moved to the heights of the left picture") {
  const Image left = Texture(0, 0, 0);
  for (const double rotation : {0.0, 0.02}) {
    for (const double rise : {3.0, -2.5}) {
      CAPTURE(rotation);
      CAPTURE(rise);
      DepthPhoto photo = PairOf(left, Texture(4, rise, rotation));
      CHECK(AlignPair("x", &photo) == "");
      REQUIRE(photo.notes.size() == 1);
      CHECK(Contains(photo.notes[0], "moved up or down by up to"));
      CHECK(MeanApart(photo.right, Texture(4, 0, 0)) < 6);
    }
  }
}

TEST_CASE("stereo pair: an aligned pair and a pair without corners keep their bytes") {
  const Image left = Texture(0, 0, 0), right = Texture(4, 0, 0);
  DepthPhoto photo = PairOf(left, right);
  CHECK(AlignPair("x", &photo) == "");
  CHECK(photo.notes.empty());
  CHECK(photo.right.pixels == right.pixels);
  photo = PairOf(Plain(9, 7, 90), Ramp(9, 7));
  CHECK(AlignPair("x", &photo) == "");
  CHECK(photo.right.pixels == Ramp(9, 7).pixels);
}

TEST_CASE("stereo pair: pictures of different scenes and large rotations are rejected") {
  const Image left = Texture(0, 0, 0);
  for (const Image& right : {Texture(0, 0, 0, 1), Texture(2, 0, 0.12), Noise(kSide, kSide)}) {
    DepthPhoto photo = PairOf(left, right);
    CHECK(Contains(AlignPair("x", &photo), "x: expected two pictures of one scene"));
  }
}

TEST_CASE("stereo pair: a repeated pattern is not rejected, and a note states the uncertainty") {
  // Returns a chessboard whose columns are moved by `dx`.
  const auto board = [](int dx) {
    Image image(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const bool white = ((x + dx) / 8 + y / 8) % 2 == 0;
        std::fill_n(image.row(y) + 3 * x, 3, static_cast<uint8_t>(white ? 200 : 50));
      }
    }
    return image;
  };
  DepthPhoto photo = PairOf(board(0), board(3));
  CHECK(AlignPair("x", &photo) == "");
  CHECK(photo.right.pixels == board(3).pixels);
  REQUIRE(photo.notes.size() == 1);
  CHECK(Contains(photo.notes[0], "resemble several points of the right one"));
}

TEST_CASE("stereo pair: the time does not depend on the height") {
  const Image tall = Noise(300, 3000);
  CHECK(MeasureAlignment(tall, tall).corners < 2000);
}

TEST_CASE("stereo pair: two files are the views at (0, 0) and (1, 0)") {
  TempFolder folder;
  const std::string left = folder.file("a.png"), right = folder.file("b.png");
  Require(WriteImage(left, Texture(0, 0, 0)));
  Require(WriteImage(right, Texture(4, 0, 0)));
  CaptureOptions options;
  options.right = right;
  const Capture capture = ValueOf(OpenCapture(left, options));
  CHECK(capture.format == "stereo pair (two files)");
  CHECK(capture.light_field.views[0].pixels == Texture(0, 0, 0).pixels);
  CHECK(capture.light_field.views[1].pixels == Texture(4, 0, 0).pixels);
  CHECK(capture.light_field.positions[1].u == 1);
  CHECK(CaptureFiles(capture) == std::vector<std::string>{left, right});
  Require(WriteImage(right, Plain(kSide, kSide + 1, 90)));
  CHECK(Contains(OpenCapture(left, options), "b.png: expected a picture of 160x160, as"));
  options.right = folder.file("absent.png");
  CHECK(Contains(OpenCapture(left, options), "absent.png"));
}

TEST_CASE("stereo pair: a spatial photo has the pictures of its stereo group") {
  const Bytes bytes = ValueOf(ReadFile(kSpatial));
  CHECK(HeifStereoPair({bytes.data(), bytes.size()}) == std::vector<uint32_t>{2, 4});
  for (size_t size = 0; size < bytes.size(); size += 7) {
    const std::vector<uint32_t> ids = HeifStereoPair({bytes.data(), size});
    CHECK((ids.empty() || ids.size() == 2));
  }
  // A group of two equal pictures is not a pair.
  Bytes equal = bytes;
  const std::string type = "ster";
  const auto group = std::search(equal.begin(), equal.end(), type.begin(), type.end());
  REQUIRE(equal.end() - group >= 24);
  std::copy_n(group + 16, 4, group + 20);
  CHECK(HeifStereoPair({equal.data(), equal.size()}).empty());
#ifdef STARFOCUS_HAS_HEIF
  const Capture capture = ValueOf(OpenCapture(kSpatial, {}));
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
}  // namespace starfocus::stereo_pair_test
