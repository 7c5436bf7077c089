// The line scan on hand-made lines, and what holds for every line on random ones.
#include "lib/line_scan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/find_runs.h"
#include "tests/reference_line.h"
#include "tests/test_scene.h"

namespace {

using starfocus::Direction;
using starfocus::kSurfaceStep;
using starfocus::ViewGrid;
using test::Depths;

enum class Kind { kSurface, kMix, kHole };

// What a rendered pixel shows.
struct Shown {
  int times = 0;
  Kind kind = Kind::kSurface;
  int source = -1;  // in a hole the visible pixel whose surface goes on
  int other = -1;   // a neighbour, another surface, or the one whose end covers a part of a hole
  int weight = 0;   // of the other
};

bool operator==(const Shown& a, const Shown& b) {
  return a.times == b.times && a.kind == b.kind && a.source == b.source && a.other == b.other &&
         a.weight == b.weight;
}

using Picture = std::vector<Shown>;

// A sink that writes down what it is given.
struct Recorder {
  Direction direction;
  Picture pixels;
  std::vector<int> begins;  // of every call

  void Surface(int begin, int end, int source, int neighbour, int weight) {
    REQUIRE(begin < end);
    REQUIRE(std::abs(neighbour) == 1);
    begins.push_back(begin);
    for (int p = begin; p < end; ++p) {
      const int from = source + p - begin;
      Show(p, Kind::kSurface, from, weight == 0 ? -1 : from + neighbour, weight);
    }
  }
  void Mix(int p, int source, int other, int weight) {
    begins.push_back(p);
    Show(p, Kind::kMix, source, other, weight);
  }
  void Hole(int begin, int end, int pixel, const starfocus::Rim& rim) {
    REQUIRE(begin < end);
    begins.push_back(begin);
    for (int p = begin; p < end; ++p) Show(p, Kind::kHole, pixel, -1, 0);
    if (rim.pixel < 0) return;
    // The scan goes on from right to left at the hole's left end; a sink may tell it by this.
    CHECK((rim.pixel < pixel) == (direction == Direction::kRightToLeft));
    Shown& shown = pixels[size_t(direction == Direction::kRightToLeft ? begin : end - 1)];
    shown.other = rim.pixel;
    shown.weight = rim.covered;
  }
  void Show(int p, Kind kind, int source, int other, int weight) {
    REQUIRE(p >= 0);
    REQUIRE(p < int(pixels.size()));
    Shown& shown = pixels[size_t(p)];
    shown = {shown.times + 1, kind, source, other, weight};
  }
};

ViewGrid MakeGrid(int n, double focus, double aperture) {
  starfocus::Aperture views;
  views.n = n;
  return starfocus::MakeViewGrid(views, focus, aperture, 0, false, false);
}

Recorder Record(const Depths& line, const ViewGrid& grid, int view, Direction direction, int begin,
                int end) {
  const std::vector<starfocus::Run> runs = test::FindRuns(line, grid, direction);
  // Disparities with a step between them, as a column of a picture has them.
  const int step = 1 + int(line.size()) % 3, length = int(line.size());
  Depths spaced(line.size() * size_t(step));
  for (size_t q = 0; q < line.size(); ++q) spaced[q * size_t(step)] = line[q];
  Recorder recorder = {direction, Picture(line.size()), {}};
  const starfocus::LineView wanted = {&grid, grid.Move(view), begin, end};
  starfocus::ScanLine(starfocus::Line{nullptr, spaced.data(), step, length}, direction, runs.data(),
                      int32_t(runs.size()), wanted, &recorder);
  return recorder;
}

// The rightmost view of a lens of radius 1 focused at 0: pixels move left by their disparity.
Picture Scan(const Depths& line, int begin, int end) {
  const ViewGrid grid = MakeGrid(1, 0, 1);
  return Record(line, grid, 1, Direction::kRightToLeft, begin, end).pixels;
}
Picture Scan(const Depths& line) { return Scan(line, 0, int(line.size())); }

// The same line and its view seen in a mirror.
Depths Mirrored(const Depths& line) { return {line.rbegin(), line.rend()}; }
Picture Mirrored(const Picture& picture) {
  Picture mirrored(picture.rbegin(), picture.rend());
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

void CheckSurface(const Picture& picture, int begin, int end, int moved) {
  for (int p = begin; p < end; ++p) {
    CAPTURE(p);
    CHECK(picture[size_t(p)].times == 1);
    CHECK(picture[size_t(p)].kind == Kind::kSurface);
    CHECK(picture[size_t(p)].source == p + moved);
  }
}

void CheckHole(const Picture& picture, int begin, int end, int pixel) {
  for (int p = begin; p < end; ++p) {
    CAPTURE(p);
    CHECK(picture[size_t(p)].times == 1);
    CHECK(picture[size_t(p)].kind == Kind::kHole);
    CHECK(picture[size_t(p)].source == pixel);
  }
}

TEST_CASE("line scan: a surface in focus stays") {
  CheckSurface(Scan(MakeLine({{9, 0}})), 0, 9, 0);
}

TEST_CASE("line scan: a flat surface moves; its end goes on beyond the line") {
  const Picture nearer = Scan(MakeLine({{9, 2}}));
  CheckSurface(nearer, 0, 7, 2);
  CheckHole(nearer, 7, 9, 8);
  const Picture farther = Scan(MakeLine({{9, -2}}));
  CheckSurface(farther, 2, 9, -2);
  CheckHole(farther, 0, 2, 0);
}

TEST_CASE("line scan: one pixel") {
  CheckSurface(Scan(MakeLine({{1, 0}})), 0, 1, 0);
  CheckHole(Scan(MakeLine({{1, 3}})), 0, 1, 0);
  CheckHole(Scan(MakeLine({{1, -3}})), 0, 1, 0);
}

TEST_CASE("line scan: a near object hides what lies left of it and uncovers what lies right") {
  const Picture picture = Scan(MakeLine({{10, 0}, {5, 4}, {9, 0}}));
  CheckSurface(picture, 0, 6, 0);
  CheckSurface(picture, 6, 11, 4);
  // The side view shows there what goes on behind pixel 15, the first one visible to the right.
  CheckHole(picture, 11, 15, 15);
  CheckSurface(picture, 15, 24, 0);
}

TEST_CASE("line scan: a hole borders on what is visible, not on what the near object hides") {
  // The middle surface lies wholly behind the near one.
  const Picture picture = Scan(MakeLine({{10, 5}, {2, -6}, {9, 9}, {9, 0}}));
  CheckSurface(picture, 0, 3, 5);
  CheckSurface(picture, 3, 12, 9);
  CheckHole(picture, 12, 21, 21);
  CheckSurface(picture, 21, 30, 0);
}

TEST_CASE("line scan: small steps stretch a surface or cover a part of it") {
  const Picture stretched = Scan(MakeLine({{10, 2}, {10, 1}}));
  CheckSurface(stretched, 0, 9, 2);  // pixel 8 repeats the pixel beside the step
  CheckSurface(stretched, 9, 19, 1);
  const Picture covered = Scan(MakeLine({{10, 1}, {10, 2}}));
  CheckSurface(covered, 0, 8, 1);
  CheckSurface(covered, 8, 18, 2);
}

TEST_CASE("line scan: the limit between a stretched surface and a hole") {
  const double step = kSurfaceStep / 64.0;
  CheckSurface(Scan(MakeLine({{10, 2}, {10, 2 - step}})), 0, 8, 2);
  CHECK(Scan(MakeLine({{10, 2}, {10, 2 - step}}))[8].kind == Kind::kSurface);
  CheckHole(Scan(MakeLine({{10, 2}, {10, 2 - step - 1.0 / 64}})), 8, 9, 10);
}

TEST_CASE("line scan: only the wanted part comes out") {
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

// The surface right of a gap may lie beyond the wanted part, with other ones right of it.
TEST_CASE("line scan: a hole at the end of the wanted part") {
  const Picture picture = Scan(MakeLine({{10, 0}, {5, 4}, {7, 0}, {6, 6}}), 0, 13);
  CheckSurface(picture, 6, 11, 4);
  CheckHole(picture, 11, 13, 15);
}

// A gap of one pixel between two surfaces, where a third one is hidden: the stretch copies from
// the third one, but nothing is blended across the edges.
TEST_CASE("line scan: no neighbour across an edge inside a stretch") {
  const Picture picture = Scan(MakeLine({{10, 3.375}, {2, 0}, {12, 4}}));
  CheckSurface(picture, 0, 8, 3);
  CheckSurface(picture, 8, 20, 4);
  CHECK(picture[5].weight == 96);
  CHECK(picture[5].other == 9);
  CHECK(picture[6].weight == 0);
  CHECK(picture[7].weight == 96);
  CHECK(picture[7].other == 11);
}

// --- The ends of near surfaces, which lie between rendered pixels ---

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

TEST_CASE("line scan: what is behind shows through the last pixel of a nearer surface") {
  // Pixels 10 .. 14 move by 4 3/4: from 5 1/4 to 10 1/4.
  const Picture picture = ScanBothWays(MakeLine({{10, 0}, {5, 4.75}, {9, 0}}));
  CheckSurface(picture, 0, 5, 0);
  CheckShown(picture, 5, Mix(10, 5, 64));
  CheckSurface(picture, 6, 10, 5);
  CheckShown(picture, 10, Rim(15, 14, 64));
  CheckHole(picture, 11, 15, 15);
  CheckSurface(picture, 15, 24, 0);
}

TEST_CASE("line scan: a nearer surface covers a part of the pixel beyond its last") {
  // Pixels 10 .. 14 move by 4 1/4: from 5 3/4 to 10 3/4.
  const Picture picture = ScanBothWays(MakeLine({{10, 0}, {5, 4.25}, {9, 0}}));
  CheckSurface(picture, 0, 5, 0);
  CheckShown(picture, 5, Mix(5, 10, 64));
  CheckSurface(picture, 6, 10, 4);
  CheckShown(picture, 10, Rim(15, 14, 192));
  CheckHole(picture, 11, 15, 15);
  CheckSurface(picture, 15, 24, 0);
}

TEST_CASE("line scan: half pixels, and none") {
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

TEST_CASE("line scan: a surface of one pixel ends twice") {
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

TEST_CASE("line scan: at its very end the surface behind has no pixel to show but its last") {
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

TEST_CASE("line scan: a nearer surface stays whole where nothing farther goes on at its end") {
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

TEST_CASE("line scan: a hole below a nearer surface has whole pixels on either side") {
  // Between the two lay ten pixels at -5, now hidden: the farther surface goes on.
  const Picture picture = ScanBothWays(MakeLine({{10, 0.25}, {10, -5}, {5, 4.75}, {9, 0}}));
  CheckSurface(picture, 0, 10, 0);
  for (int p = 10; p < 15; ++p) CheckShown(picture, p, Rim(9, -1, 0));
  CheckShown(picture, 15, Surface(20));
}

TEST_CASE("line scan: an end on the border of the wanted part") {
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

TEST_CASE("line scan: an end on the border of the line") {
  CheckShown(ScanBothWays(MakeLine({{5, 1}, {5, 4.75}, {9, 0}})), 0, Mix(5, 1, 64));
  // The near surface has moved out at the other end, but for a quarter pixel.
  CheckShown(ScanBothWays(MakeLine({{10, -8}, {3, -2.75}})), 12, Mix(4, 10, 64));
}

TEST_CASE("line scan: weights of the aperture cell") {
  for (int cell = 0; cell <= 256; ++cell) {
    for (int offset = -128; offset <= 128; ++offset) {
      const double t = std::abs(offset) / 256.0, width = cell / 256.0;
      const double exact = cell == 0 ? 0 : std::clamp((t - 0.5) / width + 0.5, 0.0, 1.0);
      const double weight = starfocus::CellWeight(offset, cell) / 256.0;
      if (std::fabs(weight - exact) > 0.5001 / 256) {
        CAPTURE(cell);
        CAPTURE(offset);
        CHECK(weight == doctest::Approx(exact));
      }
    }
  }
}

TEST_CASE("line scan: the neighbour lies on the side the surface comes from") {
  const ViewGrid grid = MakeGrid(4, 0, 1);
  for (const int view : {1, 2, 3, 4}) {
    for (const double disparity : {0.9, 1.3, 2.1, -0.7, -1.9}) {
      const Depths line = MakeLine({{12, disparity}});
      const Shown shown = Record(line, grid, view, Direction::kRightToLeft, 0, 12).pixels[6];
      const double shift = disparity * view / 4;
      const double t = shift - std::floor(shift + 0.5),
                   cell = std::min(1.0, std::fabs(disparity) / 4);
      CAPTURE(view);
      CAPTURE(disparity);
      CHECK(shown.source == 6 + int(std::floor(shift + 0.5)));
      CHECK(shown.weight / 256.0 ==
            doctest::Approx(std::clamp((std::fabs(t) - 0.5) / cell + 0.5, 0.0, 1.0)).epsilon(0.1));
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
  // By how much the other surface is nearer.
  const int step = r.line[size_t(shown.other)] - r.line[size_t(shown.source)];
  switch (shown.kind) {
    case Kind::kSurface:
      return std::abs(step) <= kSurfaceStep && shown.weight > 0 && shown.weight <= 128;
    case Kind::kMix:  // between runs, whose pixels differ from their middles by half the spread
      return std::abs(step) > kSurfaceStep - r.grid.spread && shown.weight > 0 &&
             shown.weight <= 128;
    case Kind::kHole:
      return step > kSurfaceStep && shown.weight > 0 && shown.weight < 256;
  }
  return false;
}

TEST_CASE("line scan: every wanted pixel exactly once, in scan order, from inside the line") {
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

TEST_CASE("line scan: a part comes out as it does with the whole line") {
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

// The lens that the reference knows by other numbers.
reference::Lens LensOf(const ViewGrid& grid, double aperture) {
  reference::Lens lens;
  lens.n = grid.n();
  lens.radius = aperture;
  lens.focus = grid.focus;
  lens.step = grid.step;
  return lens;
}

TEST_CASE("line scan: every pixel as the reference has it") {
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
      // Offsets are exact; an aperture cell's width is rounded, the more it matters the narrower.
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
