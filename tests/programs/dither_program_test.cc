// SPDX-License-Identifier: Apache-2.0
// Runs the program on a noisy sky, and checks the means of the 8-bit pictures that it writes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "platform/image_io.h"
#include "tests/programs/session.h"
#include "tests/support/photo_files.h"

namespace starfocus::dither_program_test {
namespace {

using namespace photos;

constexpr int kWide = 96, kHigh = 64, kTop = 16, kRows = 32, kBandRows = 128;

// Writes a far sky whose code grows by 1 in kBandRows rows, next to a near wall.
void MakeSky(const TempFolder& folder) {
  Image sky = Plain(kWide, kHigh, 140), map = Plain(kWide, kHigh, 0);
  uint32_t seed = 1;
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) {
      seed = seed * 1664525 + 1013904223;
      const auto noise = int(seed >> 16) % kBandRows;
      std::fill_n(sky.row(y) + 3 * x, 3, uint8_t(140 + (y + noise) / kBandRows));
    }
    std::fill_n(map.row(y), 3 * kWide / 4, uint8_t{255});
  }
  Write(folder.file("sky.png"), Encode(sky, ".png"));
  Write(folder.file("sky-depth.png"), Encode(map, ".png"));
}

// Returns the error of the mean of kRows rows of a picture, away from the wall.
double ErrorOfMean(const TempFolder& folder, const std::string& name) {
  const Image picture = ValueOf(DecodeImage(name, ValueOf(ReadFile(folder.file(name))))).image;
  double sum = 0;
  constexpr int kFirst = 3 * 60, kLast = 3 * 90;
  for (int y = kTop; y < kTop + kRows; ++y) {
    for (int k = kFirst; k < kLast; ++k) sum += picture.row(y)[k];
  }
  const double exact = 140 + (kTop + (kRows - 1) / 2.0) / kBandRows;
  return std::fabs(sum / (kRows * (kLast - kFirst)) - exact);
}

TEST_CASE("dither: blurred skies of pictures and sweeps have no bands with --dither") {
  TempFolder folder;
  MakeSky(folder);
  const std::string lens = "refocus sky.png --near white --f-stop 1.4 ";
  Succeed(folder, lens + "--focus-at 9,9 --dither -o out.png");
  CHECK(ErrorOfMean(folder, "out.png") < 0.05);
  Succeed(folder, lens + "--focus-at 9,9 -o rounded.png");
  CHECK(ErrorOfMean(folder, "rounded.png") > 0.1);
  Succeed(folder, lens + "--sweep 3:4:2 --dither -o sweep.png");
  CHECK(ErrorOfMean(folder, "sweep_001.png") < 0.05);
}

}  // namespace
}  // namespace starfocus::dither_program_test
