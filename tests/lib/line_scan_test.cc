// SPDX-License-Identifier: Apache-2.0
// Tests the line scan: its views of lines against the reference, and the limits of its runs.
#include "lib/line_scan/line_scan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "tests/conformance/reference_line.h"
#include "tests/support/test_scene.h"

namespace line_scan_test {
namespace {

using namespace starfocus;

using Depths = std::vector<int16_t>;

// Returns the runs of a line.
std::vector<Run> FindRuns(const Depths& line, const ViewGrid& grid, int range,
                          Direction direction) {
  const size_t length = line.size();
  Depths disparity = line;
  disparity.resize(length + simd::kPadding / sizeof(int16_t));
  std::vector<uint16_t> starts(RunMarkWords(length, 1), 0xCDCD);
  std::vector<uint16_t> edges = starts;
  std::vector<int16_t> middles(RunMiddles(length, 1), 0x5A5A);
  simd::RunMarks marks = {starts.data(), edges.data(), middles.data(), 0};
  MarkRuns(simd::BestLineScanKernels(), int16_t(range), disparity.data(), 1, int32_t(length), 1,
           direction, &marks);
  std::vector<Run> runs(length);
  const int32_t count =
      ReadRuns(marks, 0, int32_t(length), grid, grid.n() == 0 ? 0 : grid.Move(1), runs.data());
  REQUIRE(count >= 1);
  REQUIRE(count <= int32_t(length));
  runs.resize(size_t(count));
  return runs;
}

enum class Kind { kSurface, kMix, kHole };

// Content of a rendered pixel.
struct Shown {
  int times = 0;
  Kind kind = Kind::kSurface;
  int source = -1;  // Shown pixel of the line; in a hole, the pixel whose surface continues.
  // Pixel of the line that is mixed with `source`: a neighbour, a pixel of another surface, or the
  // end of a surface that covers a part of a hole.
  int other = -1;
  int weight = 0;  // Weight of `other`.
};

bool operator==(const Shown& a, const Shown& b) {
  return a.times == b.times && a.kind == b.kind && a.source == b.source && a.other == b.other &&
         a.weight == b.weight;
}

using View = std::vector<Shown>;

// A sink that records all calls.
struct Recorder {
  Direction direction;
  View pixels;
  std::vector<int> begins;  // argument `begin` of every call

  void Surface(int begin, int end, int source, int neighbour, int weight) {
    REQUIRE(begin < end);
    REQUIRE(std::abs(neighbour) == 1);
    begins.push_back(begin);
    for (int p = begin; p < end; ++p) {
      const int from = source + p - begin;
      Show(p, Kind::kSurface, from, weight == 0 ? -1 : from + neighbour,
           int(RoundShift(weight, simd::kBlendBits - kShiftBits)));
    }
  }
  void Mix(int p, int source, int other, int weight) {
    begins.push_back(p);
    Show(p, Kind::kMix, source, other, weight);
  }
  void Hole(int begin, int end, int pixel, int rim, int covered) {
    REQUIRE(begin < end);
    begins.push_back(begin);
    for (int p = begin; p < end; ++p) Show(p, Kind::kHole, pixel, -1, 0);
    if (rim < 0) return;
    // A scan from right to left continues at the left end of a hole. A sink may derive the
    // direction from the order of `pixel` and `rim`.
    CHECK((rim < pixel) == (direction == Direction::kRightToLeft));
    Shown& shown = pixels[size_t(direction == Direction::kRightToLeft ? begin : end - 1)];
    shown.other = rim;
    shown.weight = covered;
  }
  void Show(int p, Kind kind, int source, int other, int weight) {
    REQUIRE(p >= 0);
    REQUIRE(p < int(pixels.size()));
    Shown& shown = pixels[size_t(p)];
    shown = {shown.times + 1, kind, source, other, weight};
  }
};

ViewGrid MakeGrid(int n, double focus, double aperture, int layer = 0) {
  ViewWeights views;
  views.n = views.last = n;
  return MakeViewGrid(views, MakeFocusRange(focus), aperture, layer);
}

Recorder Record(const Depths& line, const ViewGrid& grid, int view, Direction direction, int begin,
                int end) {
  const std::vector<Run> runs = FindRuns(line, grid, RunRange(grid), direction);
  // Stores the disparities `step` elements apart, as in a column of a picture.
  const int step = 1 + int(line.size()) % 3, length = int(line.size());
  Depths spaced(line.size() * size_t(step));
  for (size_t q = 0; q < line.size(); ++q) spaced[q * size_t(step)] = line[q];
  Recorder recorder = {direction, View(line.size()), {}};
  const Line scanned = {nullptr, spaced.data(), step, length, runs.data(), int32_t(runs.size())};
  ScanLine(scanned, direction, {begin, end}, {view, view + 1}, grid, &recorder,
           [&](int32_t k) { return grid.Move(k); });
  return recorder;
}

// Return the mirrored line and the mirrored view of the line.
Depths Mirrored(const Depths& line) { return {line.rbegin(), line.rend()}; }
View Mirrored(const View& picture) {
  View mirrored(picture.rbegin(), picture.rend());
  for (Shown& shown : mirrored) {
    if (shown.source >= 0) shown.source = int(picture.size()) - 1 - shown.source;
    if (shown.other >= 0) shown.other = int(picture.size()) - 1 - shown.other;
  }
  return mirrored;
}

struct Stretch {
  int pixels;
  double disparity;
};

Depths MakeLine(const std::vector<Stretch>& stretches) {
  Depths line;
  for (const Stretch& s : stretches) {
    line.insert(line.end(), size_t(s.pixels), int16_t(std::lround(s.disparity * 64)));
  }
  return line;
}

TEST_CASE("runs: rendered views up to 0.5 from the centre use captured views at half distance") {
  CHECK(HalfViews(MakeGrid(8, 0, 1), 17) == 4);
  CHECK(HalfViews(MakeGrid(7, 0, 1), 17) == 3);
  CHECK(HalfViews(MakeGrid(1, 0, 1), 17) == 0);
  CHECK(HalfViews(MakeGrid(8, 0, 0.5), 17) == 8);
  CHECK(HalfViews(MakeGrid(8, 0, 0.51), 17) == 7);
  CHECK(HalfViews(MakeGrid(10, 0, 0.75), 17) == 6);
  CHECK(HalfViews(MakeGrid(8, 0, 1), 9) == 0);
  CHECK(HalfViews(MakeGrid(0, 0, 1), 17) == 0);
}

// All pixels of a run are shifted equally. The spread of the run's disparities is limited, so that
// each pixel is at most 1/8 of a pixel from its exact position.
TEST_CASE("runs: the spread of a run displaces pixels by at most an eighth of a pixel") {
  for (const double aperture : {1.0, 0.9, 0.5, 0.3, 0.2, 0.01, 1e-7}) {
    for (const int layer : {0, 1, 2}) {
      const ViewGrid grid = MakeGrid(9, 0, aperture, layer);
      CAPTURES(aperture, layer);
      const int range = RunRange(grid);
      const double spread = range / 64.0, u = aperture / (1 << layer);
      CHECK(range >= 1);
      CHECK(range <= kSurfaceStep);
      CHECK(spread / 2 * u <= 0.125 + 1e-6);
      // With a spread of one more unit, a pixel would be displaced by more than 1/8 of a pixel.
      const bool largest = range == kSurfaceStep || (spread + 1.0 / 64) / 2 * u > 0.125 - 1e-6;
      CHECK(largest);
    }
  }
}

TEST_CASE("line scan: weights follow the width of the subaperture") {
  for (int width = 0; width <= 256; ++width) {
    for (int offset = -128; offset <= 128; ++offset) {
      const double t = std::abs(offset) / 256.0, L = width / 256.0;
      const double exact = width == 0 ? 0 : std::clamp((t - 0.5) / L + 0.5, 0.0, 1.0);
      constexpr double kOne = 1 << simd::kBlendBits;
      const double weight = SubapertureWeight(offset, width) / kOne;
      if (std::fabs(weight - exact) > 1 / kOne) {
        CAPTURES(width, offset);
        CHECK(weight == doctest::Approx(exact));
      }
    }
  }
}

constexpr double kStep = kSurfaceStep / 64.0;

// Lines whose views have surfaces, holes and ends at special positions.
const struct {
  const char* what;
  std::vector<Stretch> stretches;
} kLines[] = {
    {"a surface in focus does not move", {{9, 0}}},
    {"a flat surface moves, and its end continues beyond the line", {{9, 2}}},
    {"a farther surface moves to the right", {{9, -2}}},
    {"one pixel in focus does not move", {{1, 0}}},
    {"one pixel moves left", {{1, 3}}},
    {"one pixel moves right", {{1, -3}}},
    {"a near object hides pixels on its left and uncovers pixels on its right",
     {{10, 0}, {5, 4}, {9, 0}}},
    {"a hole borders on visible pixels, not on pixels that the near object hides",
     {{10, 5}, {2, -6}, {9, 9}, {9, 0}}},
    {"a small step stretches a surface", {{10, 2}, {10, 1}}},
    {"a small step covers a part of the farther surface", {{10, 1}, {10, 2}}},
    {"a step of kSurfaceStep stretches a surface", {{10, 2}, {10, 2 - kStep}}},
    {"a step above kSurfaceStep leaves a hole", {{10, 2}, {10, 2 - kStep - 1.0 / 64}}},
    {"a pixel inside a run has no neighbour across a depth edge", {{10, 3.375}, {2, 0}, {12, 4}}},
    {"the background shows through the last pixel of a nearer surface",
     {{10, 0}, {5, 4.75}, {9, 0}}},
    {"a nearer surface covers a part of the pixel next to its last pixel",
     {{10, 0}, {5, 4.25}, {9, 0}}},
    {"a surface whose ends lie at half pixels is mixed half and half", {{10, 0}, {5, 4.5}, {9, 0}}},
    {"a surface whose ends lie at whole pixels is not mixed", {{10, 0}, {5, 4}, {9, 0}}},
    {"a surface that moves by 1/64 pixel less than 4 pixels is mixed at its ends",
     {{10, 0}, {5, 4 - 1.0 / 64}, {9, 0}}},
    {"a surface that moves by 1/64 pixel more than 4 pixels is mixed at its ends",
     {{10, 0}, {5, 4 + 1.0 / 64}, {9, 0}}},
    {"a surface of one pixel is mixed at both ends", {{10, 0}, {1, 4.75}, {9, 0}}},
    {"a surface of one pixel that moves to pixels 5 3/4 to 6 3/4 is mixed at both ends",
     {{10, 0}, {1, 4.25}, {9, 0}}},
    {"the last pixel of a farther surface shows through the end of a nearer surface",
     {{10, 0}, {5, -3}, {5, 4.75}, {9, 0}}},
    {"a nearer surface covers a part of the last pixel of a farther surface",
     {{10, 0}, {4, -3}, {5, 4.25}, {9, 0}}},
    {"a nearer surface is not mixed next to a gap of one pixel that is stretched over",
     {{10, 0}, {6, -3}, {5, 4.75}, {9, 0}}},
    {"next to a hole, only the end of the nearer surface is mixed",
     {{10, 2.75}, {6, -5}, {5, 0.75}, {5, -3}}},
    {"a surface that is nearer by only 3/4 pixel is not mixed",
     {{10, 4}, {1, -6}, {9, 4.75}, {9, 0}}},
    {"a surface that is farther by kSurfaceStep is not mixed",
     {{12, 4.75 - kStep}, {2, -6}, {9, 4.75}, {9, -8}}},
    {"a surface that is farther by more than kSurfaceStep is mixed",
     {{12, 4.75 - kStep - 1.0 / 64}, {2, -6}, {9, 4.75}, {9, -8}}},
    {"a hole between a farther and a nearer surface has unmixed pixels on both sides",
     {{10, 0.25}, {10, -5}, {5, 4.75}, {9, 0}}},
    {"a surface whose end covers a part of the view's first pixel is mixed",
     {{5, 1}, {5, 4.75}, {9, 0}}},
    {"a surface that covers a quarter of the view's last pixel is mixed", {{10, -8}, {3, -2.75}}},
    {"steps that are no depth edges are not mixed", {{9, 0.25}, {9, 1.5}, {9, 2.75}}},
};

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

TEST_CASE(
    "line scan: parts and mirrored lines give the pixels of the whole view, once and in order") {
  test::Random random(8);
  for (int round = 0; round < 4000; ++round) {
    const RandomView r(&random);
    const int length = int(r.line.size());
    for (const Direction direction : {Direction::kRightToLeft, Direction::kLeftToRight}) {
      const View whole = Record(r.line, r.grid, r.view, direction, 0, length).pixels;
      Recorder part = Record(r.line, r.grid, r.view, direction, r.begin, r.end);
      int bad = 0;
      for (int p = 0; p < length; ++p) {
        const bool wanted = p >= r.begin && p < r.end;
        bad += whole[size_t(p)].times != 1;
        bad += !(part.pixels[size_t(p)] == (wanted ? whole[size_t(p)] : Shown()));
      }
      CHECK(bad == 0);
      if (direction == Direction::kRightToLeft) {
        std::reverse(part.begins.begin(), part.begins.end());
      }
      CHECK(std::is_sorted(part.begins.begin(), part.begins.end()));
      if (direction == Direction::kLeftToRight) continue;
      const View left = Record(Mirrored(r.line), r.grid, r.view, Direction::kLeftToRight,
                               length - r.end, length - r.begin)
                            .pixels;
      CHECK(Mirrored(left) == part.pixels);
    }
  }
}

// Returns the reference's lens for a grid.
reference::Lens LensOf(const ViewGrid& grid, double aperture) {
  reference::Lens lens;
  lens.n = grid.n();
  lens.radius = aperture;
  lens.far = grid.focus.far;
  lens.near = grid.focus.near;
  lens.step = grid.step;
  return lens;
}

struct Found {
  int mixed = 0, rims = 0;
};

// Compares the view of a whole line with the reference.
void CheckView(const Depths& line, const ViewGrid& grid, double aperture, int view, Found* found) {
  const std::vector<int> disparity(line.begin(), line.end());
  const std::vector<reference::Owner> expected =
      reference::LineScan(disparity, LensOf(grid, aperture), view).Scan();
  const View got = Record(line, grid, view, Direction::kRightToLeft, 0, int(line.size())).pixels;
  int bad = 0;
  for (size_t p = 0; p < got.size(); ++p) {
    const Shown& shown = got[p];
    const reference::Owner& owner = expected[p];
    bad += (shown.kind == Kind::kHole) != owner.hole || shown.source != owner.source;
    if (shown.other >= 0) bad += shown.other != owner.other;
    // Offsets of the engine are exact. Widths of subapertures are rounded, which affects narrow
    // subapertures most.
    const bool blended = shown.kind == Kind::kSurface;
    bad += std::fabs(shown.weight - 256 * owner.share) > (blended ? 4 : 0);
    found->mixed += shown.kind == Kind::kMix;
    found->rims += shown.kind == Kind::kHole && shown.weight != 0;
  }
  CHECK(bad == 0);
}

TEST_CASE("line scan: every pixel of hand-made and random lines matches the reference") {
  Found found;
  for (const auto& line : kLines) {
    CAPTURE(std::string(line.what));
    CheckView(MakeLine(line.stretches), MakeGrid(1, 0, 1), 1, 1, &found);
  }
  test::Random random(11);
  for (int round = 0; round < 6000; ++round) {
    const RandomView r(&random);
    CAPTURE(round);
    CheckView(r.line, r.grid, r.aperture, r.view, &found);
  }
  CHECK(found.mixed > 6000);
  CHECK(found.rims > 6000);
}

}  // namespace
}  // namespace line_scan_test
