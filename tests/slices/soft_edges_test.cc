// SPDX-License-Identifier: Apache-2.0
// The ends of near surfaces in the line scan, which lie between rendered pixels.
#include <doctest/doctest.h>

#include "tests/line_scan/line_scan_recorder.h"

namespace soft_edges_test {
namespace {

using namespace starfocus;
using namespace test;

// The view of a line, the same in either direction.
Picture ScanBothWays(const Depths& line) {
  const Picture right = Scan(line);
  const ViewGrid grid = MakeGrid(1, 0, 1);
  const int length = int(line.size());
  const Picture left = Record(Mirrored(line), grid, 1, Direction::kLeftToRight, 0, length).pixels;
  CHECK(Mirrored(left) == right);
  return right;
}

Shown Surface(int source) { return {1, Kind::kSurface, source, -1, 0}; }
Shown Mix(int source, int other, int weight) { return {1, Kind::kMix, source, other, weight}; }
Shown Rim(int source, int other, int weight) { return {1, Kind::kHole, source, other, weight}; }

void CheckShown(const Picture& picture, int p, const Shown& expected) {
  const Shown& shown = picture[size_t(p)];
  CAPTURE(p);
  CHECK(shown.times == expected.times);
  CHECK(shown.kind == expected.kind);
  CHECK(shown.source == expected.source);
  CHECK(shown.other == expected.other);
  CHECK(shown.weight == expected.weight);
}

TEST_CASE("soft edges: what is behind shows through the last pixel of a nearer surface") {
  // Pixels 10 .. 14 move by 4 3/4: from 5 1/4 to 10 1/4.
  const Picture picture = ScanBothWays(MakeLine({{10, 0}, {5, 4.75}, {9, 0}}));
  CheckSurface(picture, 0, 5, 0);
  CheckShown(picture, 5, Mix(10, 5, 64));
  CheckSurface(picture, 6, 10, 5);
  CheckShown(picture, 10, Rim(15, 14, 64));
  CheckHole(picture, 11, 15, 15);
  CheckSurface(picture, 15, 24, 0);
}

TEST_CASE("soft edges: a nearer surface covers a part of the pixel beyond its last") {
  // Pixels 10 .. 14 move by 4 1/4: from 5 3/4 to 10 3/4.
  const Picture picture = ScanBothWays(MakeLine({{10, 0}, {5, 4.25}, {9, 0}}));
  CheckSurface(picture, 0, 5, 0);
  CheckShown(picture, 5, Mix(5, 10, 64));
  CheckSurface(picture, 6, 10, 4);
  CheckShown(picture, 10, Rim(15, 14, 192));
  CheckHole(picture, 11, 15, 15);
  CheckSurface(picture, 15, 24, 0);
}

TEST_CASE("soft edges: half pixels, and none") {
  const Picture half = ScanBothWays(MakeLine({{10, 0}, {5, 4.5}, {9, 0}}));
  CheckSurface(half, 0, 5, 0);
  CheckShown(half, 5, Mix(10, 5, 128));
  CheckSurface(half, 6, 10, 5);
  CheckShown(half, 10, Rim(15, 14, 128));
  const Picture whole = ScanBothWays(MakeLine({{10, 0}, {5, 4}, {9, 0}}));
  CheckSurface(whole, 0, 6, 0);
  CheckSurface(whole, 6, 11, 4);
  CheckHole(whole, 11, 15, 15);
  for (const Shown& shown : whole) CHECK(shown.weight == 0);
  // The smallest parts: 1/64 of a pixel either way.
  const Picture less = ScanBothWays(MakeLine({{10, 0}, {5, 4 - 1.0 / 64}, {9, 0}}));
  CheckShown(less, 6, Mix(10, 6, 4));
  CheckShown(less, 11, Rim(15, 14, 4));
  const Picture more = ScanBothWays(MakeLine({{10, 0}, {5, 4 + 1.0 / 64}, {9, 0}}));
  CheckShown(more, 5, Mix(5, 10, 4));
  CheckShown(more, 10, Rim(15, 14, 252));
}

TEST_CASE("soft edges: a surface of one pixel ends twice") {
  // 10 moves to between 5 1/4 and 6 1/4: what is missing in pixel 5 is in 6.
  const Picture before = ScanBothWays(MakeLine({{10, 0}, {1, 4.75}, {9, 0}}));
  CheckSurface(before, 0, 5, 0);
  CheckShown(before, 5, Mix(10, 5, 64));
  CheckShown(before, 6, Rim(11, 10, 64));
  CheckHole(before, 7, 11, 11);
  // To between 5 3/4 and 6 3/4.
  const Picture beyond = ScanBothWays(MakeLine({{10, 0}, {1, 4.25}, {9, 0}}));
  CheckSurface(beyond, 0, 5, 0);
  CheckShown(beyond, 5, Mix(5, 10, 64));
  CheckShown(beyond, 6, Rim(11, 10, 192));
  CheckHole(beyond, 7, 11, 11);
}

TEST_CASE("soft edges: at its very end the surface behind has no pixel to show but its last") {
  // The surface at -3 is hidden: that at 0 begins where the near one ends.
  const Picture through = ScanBothWays(MakeLine({{10, 0}, {5, -3}, {5, 4.75}, {9, 0}}));
  CheckSurface(through, 0, 10, 0);
  CheckShown(through, 10, Mix(15, 9, 64));
  CheckSurface(through, 11, 15, 5);
  const Picture covered = ScanBothWays(MakeLine({{10, 0}, {4, -3}, {5, 4.25}, {9, 0}}));
  CheckSurface(covered, 0, 9, 0);
  CheckShown(covered, 9, Mix(9, 14, 64));
  CheckSurface(covered, 10, 14, 4);
}

TEST_CASE("soft edges: a nearer surface stays whole where nothing farther goes on at its end") {
  // A gap of one pixel, stretched over.
  const Picture gap = ScanBothWays(MakeLine({{10, 0}, {6, -3}, {5, 4.75}, {9, 0}}));
  CheckSurface(gap, 0, 11, 0);
  CheckSurface(gap, 11, 15, 5);
  // A hole: the nearer of the two surfaces beside it ends between pixels, the farther does not.
  const Picture hole = ScanBothWays(MakeLine({{10, 2.75}, {6, -5}, {5, 0.75}, {5, -3}}));
  CheckShown(hole, 7, Rim(16, 9, 64));
  CheckHole(hole, 8, 15, 16);
  CheckShown(hole, 15, Surface(16));
  // Hardly farther: one pixel at -6 is hidden between two surfaces 3/4 apart.
  const Picture near = ScanBothWays(MakeLine({{10, 4}, {1, -6}, {9, 4.75}, {9, 0}}));
  CheckSurface(near, 0, 6, 4);
  CheckSurface(near, 6, 15, 5);
  // Beside the limit.
  for (const int over : {0, 1}) {
    const double farther = 4.75 - (kSurfaceStep + over) / 64.0;
    const Picture limit = ScanBothWays(MakeLine({{12, farther}, {2, -6}, {9, 4.75}, {9, -8}}));
    CAPTURE(over);
    CHECK(limit[9].source == 14);
    CHECK((limit[9].kind == Kind::kMix) == (over == 1));
  }
  // No depth edge at all.
  for (const Shown& shown : ScanBothWays(MakeLine({{9, 0.25}, {9, 1.5}, {9, 2.75}}))) {
    CHECK(shown.kind != Kind::kMix);
    CHECK((shown.kind == Kind::kSurface || shown.weight == 0));
  }
}

TEST_CASE("soft edges: a hole below a nearer surface has whole pixels on either side") {
  // Between the two lay ten pixels at -5, now hidden: the farther surface goes on.
  const Picture picture = ScanBothWays(MakeLine({{10, 0.25}, {10, -5}, {5, 4.75}, {9, 0}}));
  CheckSurface(picture, 0, 10, 0);
  for (int p = 10; p < 15; ++p) CheckShown(picture, p, Rim(9, -1, 0));
  CheckShown(picture, 15, Surface(20));
}

TEST_CASE("soft edges: an end on the border of the wanted part") {
  // The end lies at 5 1/4 and 5 3/4: pixel 5 is mixed, whatever else is wanted.
  for (const double disparity : {4.75, 4.25}) {
    const Depths line = MakeLine({{10, 0}, {5, disparity}, {9, 0}});
    const Shown expected = disparity > 4.5 ? Mix(10, 5, 64) : Mix(5, 10, 64);
    for (int begin = 0; begin <= 5; ++begin) {
      for (int end = 6; end <= 24; ++end) {
        CAPTURE(begin);
        CAPTURE(end);
        CheckShown(Scan(line, begin, end), 5, expected);
      }
    }
  }
}

TEST_CASE("soft edges: an end on the border of the line") {
  CheckShown(ScanBothWays(MakeLine({{5, 1}, {5, 4.75}, {9, 0}})), 0, Mix(5, 1, 64));
  // The near surface has moved out at the other end, but for a quarter pixel.
  CheckShown(ScanBothWays(MakeLine({{10, -8}, {3, -2.75}})), 12, Mix(4, 10, 64));
}

}  // namespace
}  // namespace soft_edges_test
