// SPDX-License-Identifier: Apache-2.0
// Tests the line scan on hand-made lines. Checks the source of each pixel of the view, and the ends
// of near surfaces, which lie between rendered pixels.
#include <doctest/doctest.h>

#include <climits>
#include <string>
#include <vector>

#include "tests/lib/line_scan_recorder.h"
#include "tests/support/test_scene.h"

namespace lines_test {
namespace {

using namespace starfocus;
using namespace test;

// Scans a line in both directions, checks that the results are equal, and returns the view.
Picture ScanBothWays(const Depths& line) {
  const Picture right = Scan(line);
  const ViewGrid grid = MakeGrid(1, 0, 1);
  const int length = int(line.size());
  const Picture left = Record(Mirrored(line), grid, 1, Direction::kLeftToRight, 0, length).pixels;
  CHECK(Mirrored(left) == right);
  return right;
}

// Expected content of the pixels [begin, end) of a view. Pixel `begin` shows line pixel `source`,
// and the following pixels show the following line pixels.
constexpr int kAny = INT_MIN;
struct Part {
  Kind kind;
  int begin, end, source, other, weight;
};
Part Moved(int begin, int end, int by) {
  return {Kind::kSurface, begin, end, begin + by, kAny, kAny};
}
Part Hole(int begin, int end, int pixel) { return {Kind::kHole, begin, end, pixel, kAny, kAny}; }
Part Mix(int p, int source, int other, int weight) {
  return {Kind::kMix, p, p + 1, source, other, weight};
}
Part Rim(int p, int source, int other, int weight) {
  return {Kind::kHole, p, p + 1, source, other, weight};
}
Part Plain(int p, int source) { return {Kind::kSurface, p, p + 1, source, -1, 0}; }

void CheckPart(const Picture& picture, const Part& part) {
  for (int p = part.begin; p < part.end; ++p) {
    const Shown& shown = picture[size_t(p)];
    CAPTURE(p);
    CHECK(shown.times == 1);
    CHECK(shown.kind == part.kind);
    CHECK(shown.source == part.source + (part.kind == Kind::kSurface ? p - part.begin : 0));
    if (part.other != kAny) CHECK(shown.other == part.other);
    if (part.weight != kAny) CHECK(shown.weight == part.weight);
  }
}

struct Line {
  std::string what;
  std::vector<Stretch> stretches;
  std::vector<Part> parts;
};
constexpr double kStep = kSurfaceStep / 64.0;

const Line kLines[] = {
    {"a surface in focus does not move", {{9, 0}}, {Moved(0, 9, 0)}},
    {"a flat surface moves, and its end continues beyond the line",
     {{9, 2}},
     {Moved(0, 7, 2), Hole(7, 9, 8)}},
    {"a farther surface moves to the right", {{9, -2}}, {Moved(2, 9, -2), Hole(0, 2, 0)}},
    {"one pixel in focus does not move", {{1, 0}}, {Moved(0, 1, 0)}},
    {"one pixel moves left", {{1, 3}}, {Hole(0, 1, 0)}},
    {"one pixel moves right", {{1, -3}}, {Hole(0, 1, 0)}},
    // In the hole next to the near object, the surface of pixel 15 continues.
    {"a near object hides pixels on its left and uncovers pixels on its right",
     {{10, 0}, {5, 4}, {9, 0}},
     {Moved(0, 6, 0), Moved(6, 11, 4), Hole(11, 15, 15), Moved(15, 24, 0)}},
    // The middle surface is completely behind the near surface.
    {"a hole borders on visible pixels, not on pixels that the near object hides",
     {{10, 5}, {2, -6}, {9, 9}, {9, 0}},
     {Moved(0, 3, 5), Moved(3, 12, 9), Hole(12, 21, 21), Moved(21, 30, 0)}},
    // Pixel 8 repeats the pixel next to the step.
    {"a small step stretches a surface", {{10, 2}, {10, 1}}, {Moved(0, 9, 2), Moved(9, 19, 1)}},
    {"a small step covers a part of the farther surface",
     {{10, 1}, {10, 2}},
     {Moved(0, 8, 1), Moved(8, 18, 2)}},
    {"a step of kSurfaceStep stretches a surface", {{10, 2}, {10, 2 - kStep}}, {Moved(0, 9, 2)}},
    {"a step above kSurfaceStep leaves a hole",
     {{10, 2}, {10, 2 - kStep - 1.0 / 64}},
     {Hole(8, 9, 10)}},
    // A third surface lies in the gap of one pixel. The stretched pixel is a copy of the third
    // surface, and is not blended with neighbours across depth edges.
    {"a pixel inside a run has no neighbour across a depth edge",
     {{10, 3.375}, {2, 0}, {12, 4}},
     {Moved(0, 8, 3),
      Moved(8, 20, 4),
      {Kind::kSurface, 5, 6, 8, 9, 96},
      Plain(6, 9),
      {Kind::kSurface, 7, 8, 10, 11, 96}}},

    // The following cases test the ends of near surfaces. Pixels 10 to 14 of the line move by 4 3/4
    // pixels, to the range from 5 1/4 to 10 1/4 of the view.
    {"the background shows through the last pixel of a nearer surface",
     {{10, 0}, {5, 4.75}, {9, 0}},
     {Moved(0, 5, 0), Mix(5, 10, 5, 64), Moved(6, 10, 5), Rim(10, 15, 14, 64), Hole(11, 15, 15),
      Moved(15, 24, 0)}},
    // Pixels 10 to 14 of the line move by 4 1/4 pixels, to the range from 5 3/4 to 10 3/4 of the
    // view.
    {"a nearer surface covers a part of the pixel next to its last pixel",
     {{10, 0}, {5, 4.25}, {9, 0}},
     {Moved(0, 5, 0), Mix(5, 5, 10, 64), Moved(6, 10, 4), Rim(10, 15, 14, 192), Hole(11, 15, 15),
      Moved(15, 24, 0)}},
    {"a surface whose ends lie at half pixels is mixed half and half",
     {{10, 0}, {5, 4.5}, {9, 0}},
     {Moved(0, 5, 0), Mix(5, 10, 5, 128), Moved(6, 10, 5), Rim(10, 15, 14, 128)}},
    {"a surface whose ends lie at whole pixels is not mixed",
     {{10, 0}, {5, 4}, {9, 0}},
     {Moved(0, 6, 0), Plain(5, 5), Plain(6, 10), Moved(6, 11, 4), Rim(11, 15, -1, 0),
      Hole(11, 15, 15)}},
    {"a surface that moves by 1/64 pixel less than 4 pixels is mixed at its ends",
     {{10, 0}, {5, 4 - 1.0 / 64}, {9, 0}},
     {Mix(6, 10, 6, 4), Rim(11, 15, 14, 4)}},
    {"a surface that moves by 1/64 pixel more than 4 pixels is mixed at its ends",
     {{10, 0}, {5, 4 + 1.0 / 64}, {9, 0}},
     {Mix(5, 5, 10, 4), Rim(10, 15, 14, 252)}},
    // Pixel 10 moves to the range from 5 1/4 to 6 1/4, and covers parts of pixels 5 and 6.
    {"a surface of one pixel is mixed at both ends",
     {{10, 0}, {1, 4.75}, {9, 0}},
     {Moved(0, 5, 0), Mix(5, 10, 5, 64), Rim(6, 11, 10, 64), Hole(7, 11, 11)}},
    {"a surface of one pixel that moves to pixels 5 3/4 to 6 3/4 is mixed at both ends",
     {{10, 0}, {1, 4.25}, {9, 0}},
     {Moved(0, 5, 0), Mix(5, 5, 10, 64), Rim(6, 11, 10, 192), Hole(7, 11, 11)}},
    // The surface with disparity -3 is hidden. The surface with disparity 0 starts where the near
    // surface ends.
    {"the last pixel of a farther surface shows through the end of a nearer surface",
     {{10, 0}, {5, -3}, {5, 4.75}, {9, 0}},
     {Moved(0, 10, 0), Mix(10, 15, 9, 64), Moved(11, 15, 5)}},
    {"a nearer surface covers a part of the last pixel of a farther surface",
     {{10, 0}, {4, -3}, {5, 4.25}, {9, 0}},
     {Moved(0, 9, 0), Mix(9, 9, 14, 64), Moved(10, 14, 4)}},
    {"a nearer surface is not mixed next to a gap of one pixel that is stretched over",
     {{10, 0}, {6, -3}, {5, 4.75}, {9, 0}},
     {Moved(0, 11, 0), Moved(11, 15, 5)}},
    {"next to a hole, only the end of the nearer surface is mixed",
     {{10, 2.75}, {6, -5}, {5, 0.75}, {5, -3}},
     {Rim(7, 16, 9, 64), Hole(8, 15, 16), Plain(15, 16)}},
    // One pixel with disparity -6 is hidden between two surfaces whose disparities differ by 3/4.
    {"a surface that is nearer by only 3/4 pixel is not mixed",
     {{10, 4}, {1, -6}, {9, 4.75}, {9, 0}},
     {Moved(0, 6, 4), Moved(6, 15, 5)}},
    {"a surface that is farther by kSurfaceStep is not mixed",
     {{12, 4.75 - kStep}, {2, -6}, {9, 4.75}, {9, -8}},
     {{Kind::kSurface, 9, 10, 14, kAny, kAny}}},
    {"a surface that is farther by more than kSurfaceStep is mixed",
     {{12, 4.75 - kStep - 1.0 / 64}, {2, -6}, {9, 4.75}, {9, -8}},
     {{Kind::kMix, 9, 10, 14, kAny, kAny}}},
    // Ten pixels with disparity -5 between two surfaces are hidden, so the farther of the two
    // surfaces continues.
    {"a hole between a farther and a nearer surface has unmixed pixels on both sides",
     {{10, 0.25}, {10, -5}, {5, 4.75}, {9, 0}},
     {Moved(0, 10, 0), {Kind::kHole, 10, 15, 9, -1, 0}, Plain(15, 20)}},
    {"a surface whose end covers a part of the view's first pixel is mixed",
     {{5, 1}, {5, 4.75}, {9, 0}},
     {Mix(0, 5, 1, 64)}},
    // The near surface has left the line at the right end, except for a quarter of a pixel.
    {"a surface that covers a quarter of the view's last pixel is mixed",
     {{10, -8}, {3, -2.75}},
     {Mix(12, 4, 10, 64)}},
};

TEST_CASE("lines: each pixel of a view has the expected source and weight") {
  for (const Line& line : kLines) {
    CAPTURE(line.what);
    const Picture picture = ScanBothWays(MakeLine(line.stretches));
    for (const Part& part : line.parts) CheckPart(picture, part);
  }
}

TEST_CASE("lines: pixels are not mixed without a depth edge") {
  for (const Shown& shown : ScanBothWays(MakeLine({{9, 0.25}, {9, 1.5}, {9, 2.75}}))) {
    CHECK(shown.kind != Kind::kMix);
    CHECK((shown.kind == Kind::kSurface || shown.weight == 0));
  }
}

TEST_CASE(
    "lines: only the requested part is reported, and is equal to the same part of the whole line") {
  for (const double disparity : {4.0, 4.25, 4.75}) {
    const Depths line = MakeLine({{10, 0}, {5, disparity}, {9, 0}});
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
  // The surface to the right of a gap may lie beyond the requested part, and further surfaces may
  // lie to the right of this surface.
  const Picture picture = Scan(MakeLine({{10, 0}, {5, 4}, {7, 0}, {6, 6}}), 0, 13);
  CheckPart(picture, Moved(6, 11, 4));
  CheckPart(picture, Hole(11, 13, 15));
}

}  // namespace
}  // namespace lines_test
