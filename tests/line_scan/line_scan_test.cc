// SPDX-License-Identifier: Apache-2.0
// Tests the line scan on hand-made lines, and its properties on random lines.
#include "lib/line_scan/line_scan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/conformance/reference_line.h"
#include "tests/line_scan/line_scan_recorder.h"
#include "tests/support/test_scene.h"

namespace line_scan_test {
namespace {

using namespace starfocus;
using namespace test;

TEST_CASE("line scan: a surface in focus does not move") {
  CheckSurface(Scan(MakeLine({{9, 0}})), 0, 9, 0);
}

TEST_CASE("line scan: a flat surface moves, and its end continues beyond the line") {
  const Picture nearer = Scan(MakeLine({{9, 2}}));
  CheckSurface(nearer, 0, 7, 2);
  CheckHole(nearer, 7, 9, 8);
  const Picture farther = Scan(MakeLine({{9, -2}}));
  CheckSurface(farther, 2, 9, -2);
  CheckHole(farther, 0, 2, 0);
}

TEST_CASE("line scan: a line may have only one pixel") {
  CheckSurface(Scan(MakeLine({{1, 0}})), 0, 1, 0);
  CheckHole(Scan(MakeLine({{1, 3}})), 0, 1, 0);
  CheckHole(Scan(MakeLine({{1, -3}})), 0, 1, 0);
}

TEST_CASE("line scan: a near object hides pixels on its left and uncovers pixels on its right") {
  const Picture picture = Scan(MakeLine({{10, 0}, {5, 4}, {9, 0}}));
  CheckSurface(picture, 0, 6, 0);
  CheckSurface(picture, 6, 11, 4);
  // The side view shows the surface behind pixel 15 there, the first visible pixel to the right.
  CheckHole(picture, 11, 15, 15);
  CheckSurface(picture, 15, 24, 0);
}

TEST_CASE("line scan: a hole borders on visible pixels, not on those that the near object hides") {
  // The middle surface is completely behind the near one.
  const Picture picture = Scan(MakeLine({{10, 5}, {2, -6}, {9, 9}, {9, 0}}));
  CheckSurface(picture, 0, 3, 5);
  CheckSurface(picture, 3, 12, 9);
  CheckHole(picture, 12, 21, 21);
  CheckSurface(picture, 21, 30, 0);
}

TEST_CASE("line scan: small steps stretch a surface or cover a part of it") {
  const Picture stretched = Scan(MakeLine({{10, 2}, {10, 1}}));
  CheckSurface(stretched, 0, 9, 2);  // pixel 8 repeats the pixel next to the step
  CheckSurface(stretched, 9, 19, 1);
  const Picture covered = Scan(MakeLine({{10, 1}, {10, 2}}));
  CheckSurface(covered, 0, 8, 1);
  CheckSurface(covered, 8, 18, 2);
}

TEST_CASE("line scan: a gap of more than the limit is a hole, a smaller one a stretched surface") {
  const double step = kSurfaceStep / 64.0;
  CheckSurface(Scan(MakeLine({{10, 2}, {10, 2 - step}})), 0, 8, 2);
  CHECK(Scan(MakeLine({{10, 2}, {10, 2 - step}}))[8].kind == Kind::kSurface);
  CheckHole(Scan(MakeLine({{10, 2}, {10, 2 - step - 1.0 / 64}})), 8, 9, 10);
}

TEST_CASE("line scan: only the requested part is reported") {
  const Depths line = MakeLine({{10, 0}, {5, 4}, {9, 0}});
  const Picture whole = Scan(line);
  for (int begin = 0; begin < 24; ++begin) {
    for (int end = begin + 1; end <= 24; ++end) {
      const Picture part = Scan(line, begin, end);
      for (int p = 0; p < 24; ++p) {
        const bool wanted = p >= begin && p < end;
        CHECK(part[size_t(p)] == (wanted ? whole[size_t(p)] : Shown()));
      }
    }
  }
}

// The surface to the right of a gap may lie beyond the requested part, with other surfaces to its
// right.
TEST_CASE("line scan: a hole may end the requested part") {
  const Picture picture = Scan(MakeLine({{10, 0}, {5, 4}, {7, 0}, {6, 6}}), 0, 13);
  CheckSurface(picture, 6, 11, 4);
  CheckHole(picture, 11, 13, 15);
}

// A gap of one pixel between two surfaces hides a third one. The stretched pixel is a copy of the
// third surface, but is not blended with its neighbours across the edges.
TEST_CASE("line scan: a stretched pixel is not blended across an edge") {
  const Picture picture = Scan(MakeLine({{10, 3.375}, {2, 0}, {12, 4}}));
  CheckSurface(picture, 0, 8, 3);
  CheckSurface(picture, 8, 20, 4);
  CHECK(picture[5].weight == 96);
  CHECK(picture[5].other == 9);
  CHECK(picture[6].weight == 0);
  CHECK(picture[7].weight == 96);
  CHECK(picture[7].other == 11);
}

TEST_CASE("line scan: weights follow the width of the subaperture") {
  for (int width = 0; width <= 256; ++width) {
    for (int offset = -128; offset <= 128; ++offset) {
      const double t = std::abs(offset) / 256.0, L = width / 256.0;
      const double exact = width == 0 ? 0 : std::clamp((t - 0.5) / L + 0.5, 0.0, 1.0);
      constexpr double kOne = 1 << starfocus::simd::kBlendBits;
      const double weight = starfocus::SubapertureWeight(offset, width) / kOne;
      if (std::fabs(weight - exact) > 1 / kOne) {
        CAPTURE(width);
        CAPTURE(offset);
        CHECK(weight == doctest::Approx(exact));
      }
    }
  }
}

TEST_CASE("line scan: the neighbour lies on the side that the surface comes from") {
  const ViewGrid grid = MakeGrid(4, 0, 1);
  for (const int view : {1, 2, 3, 4}) {
    for (const double disparity : {0.9, 1.3, 2.1, -0.7, -1.9}) {
      const Depths line = MakeLine({{12, disparity}});
      const Shown shown = Record(line, grid, view, Direction::kRightToLeft, 0, 12).pixels[6];
      const double shift = disparity * view / 4;
      const double t = shift - std::floor(shift + 0.5),
                   width = std::min(1.0, std::fabs(disparity) / 4);
      CAPTURE(view);
      CAPTURE(disparity);
      CHECK(shown.source == 6 + int(std::floor(shift + 0.5)));
      CHECK(shown.weight / 256.0 ==
            doctest::Approx(std::clamp((std::fabs(t) - 0.5) / width + 0.5, 0.0, 1.0)).epsilon(0.1));
      if (shown.weight != 0) CHECK(shown.other == shown.source + (t > 0 ? 1 : -1));
    }
  }
}

Depths RandomLine(test::Random* random) {
  Depths line(size_t(random->Int(1, 60)));
  const int amplitude = 64 * random->Int(0, 9);
  const int changes = random->Int(1, 12), slope = random->Int(-40, 40);
  int level = random->Int(-amplitude, amplitude);
  for (int16_t& d : line) {
    level = random->Int(1, changes) == 1 ? random->Int(-amplitude, amplitude)
                                         : std::clamp(level + slope, -amplitude, amplitude);
    d = int16_t(level);
  }
  return line;
}

struct RandomView {
  explicit RandomView(test::Random* random)
      : line(RandomLine(random)),
        aperture(random->Real(0.2, 1)),
        grid(MakeGrid(random->Int(1, 9), random->Real(-4, 4), aperture)),
        view(random->Int(1, grid.n())),
        begin(random->Int(0, int(line.size()) - 1)),
        end(random->Int(begin + 1, int(line.size()))) {}

  Depths line;
  double aperture;
  ViewGrid grid;
  int view, begin, end;
};

bool IsSound(const Shown& shown, const RandomView& r) {
  const int length = int(r.line.size());
  REQUIRE(shown.source >= 0);
  REQUIRE(shown.source < length);
  if (shown.other < 0) return shown.kind != Kind::kMix && shown.weight == 0;
  REQUIRE(shown.other < length);
  // Depth by which the other surface is nearer.
  const int step = r.line[size_t(shown.other)] - r.line[size_t(shown.source)];
  switch (shown.kind) {
    case Kind::kSurface:
      return std::abs(step) <= kSurfaceStep && shown.weight > 0 && shown.weight <= 128;
    // between runs; their pixels differ from their middles by up to half the spread
    case Kind::kMix:
      return std::abs(step) > kSurfaceStep - r.grid.spread && shown.weight > 0 &&
             shown.weight <= 128;
    case Kind::kHole:
      return step > kSurfaceStep && shown.weight > 0 && shown.weight < 256;
  }
  return false;
}

TEST_CASE("line scan: every requested pixel is reported once and in scan order") {
  test::Random random(8);
  for (int round = 0; round < 4000; ++round) {
    const RandomView r(&random);
    for (const Direction direction : {Direction::kRightToLeft, Direction::kLeftToRight}) {
      Recorder recorder = Record(r.line, r.grid, r.view, direction, r.begin, r.end);
      const int length = int(r.line.size());
      int bad = 0;
      for (int p = 0; p < length; ++p) {
        const Shown& shown = recorder.pixels[size_t(p)];
        bad += shown.times != (p >= r.begin && p < r.end ? 1 : 0);
        if (shown.times != 0) bad += !IsSound(shown, r);
      }
      CHECK(bad == 0);
      if (direction == Direction::kRightToLeft) {
        std::reverse(recorder.begins.begin(), recorder.begins.end());
      }
      CHECK(std::is_sorted(recorder.begins.begin(), recorder.begins.end()));
    }
  }
}

TEST_CASE("line scan: a part is equal to the same part of the whole line") {
  test::Random random(9);
  for (int round = 0; round < 4000; ++round) {
    const RandomView r(&random);
    for (const Direction direction : {Direction::kRightToLeft, Direction::kLeftToRight}) {
      const Picture part = Record(r.line, r.grid, r.view, direction, r.begin, r.end).pixels;
      const Picture whole = Record(r.line, r.grid, r.view, direction, 0, int(r.line.size())).pixels;
      CHECK(std::equal(part.begin() + r.begin, part.begin() + r.end, whole.begin() + r.begin));
    }
  }
}

TEST_CASE("line scan: the mirrored line gives the mirrored view") {
  test::Random random(10);
  for (int round = 0; round < 4000; ++round) {
    const RandomView r(&random);
    const int length = int(r.line.size());
    const Picture right =
        Record(r.line, r.grid, r.view, Direction::kRightToLeft, r.begin, r.end).pixels;
    const Picture left = Record(Mirrored(r.line), r.grid, r.view, Direction::kLeftToRight,
                                length - r.end, length - r.begin)
                             .pixels;
    CHECK(Mirrored(left) == right);
  }
}

// Returns the reference's lens for a grid.
reference::Lens LensOf(const ViewGrid& grid, double aperture) {
  reference::Lens lens;
  lens.n = grid.n();
  lens.radius = aperture;
  lens.focus = grid.focus;
  lens.step = grid.step;
  return lens;
}

TEST_CASE("line scan: every pixel is equal to that of the reference") {
  test::Random random(11);
  int mixed = 0, rims = 0;
  for (int round = 0; round < 6000; ++round) {
    const RandomView r(&random);
    const std::vector<int> disparity(r.line.begin(), r.line.end());
    const std::vector<reference::Owner> expected =
        reference::LineScan(disparity, LensOf(r.grid, r.aperture), r.view).Scan();
    const Picture got =
        Record(r.line, r.grid, r.view, Direction::kRightToLeft, 0, int(r.line.size())).pixels;
    int bad = 0;
    for (size_t p = 0; p < got.size(); ++p) {
      const Shown& shown = got[p];
      const reference::Owner& owner = expected[p];
      bad += (shown.kind == Kind::kHole) != owner.hole || shown.source != owner.source;
      if (shown.other >= 0) bad += shown.other != owner.other;
      // Offsets are exact. The width of a subaperture is rounded, which matters most if it is
      // narrow.
      const bool blended = shown.kind == Kind::kSurface;
      bad += std::fabs(shown.weight - 256 * owner.share) > (blended ? 4 : 0);
      mixed += shown.kind == Kind::kMix;
      rims += shown.kind == Kind::kHole && shown.weight != 0;
    }
    CAPTURE(round);
    CHECK(bad == 0);
  }
  CHECK(mixed > 6000);
  CHECK(rims > 6000);
}

}  // namespace
}  // namespace line_scan_test
