// The line scan on hand-made lines, and what holds for every line on random ones.
#include "lib/line_scan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/test_scene.h"

namespace {

using starfocus::Direction;
using starfocus::kSurfaceStep;
using starfocus::ViewGrid;

// What a rendered pixel shows.
struct Shown {
  int times = 0;
  bool hole = false;
  int source = -1;     // or the visible pixel behind which a hole goes on
  int neighbour = -1;  // -1: not read
  int weight = 0;
  int disparity = 0;  // of a hole
};

bool operator==(const Shown& a, const Shown& b) {
  return a.times == b.times && a.hole == b.hole && a.source == b.source &&
         a.neighbour == b.neighbour && a.weight == b.weight && a.disparity == b.disparity;
}

using Picture = std::vector<Shown>;

// A sink that writes down what it is given.
struct Recorder {
  Picture pixels;
  std::vector<int> begins;  // of every call

  void Surface(int begin, int end, int source, int neighbour, int weight) {
    REQUIRE(begin < end);
    REQUIRE(std::abs(neighbour) == 1);
    begins.push_back(begin);
    for (int p = begin; p < end; ++p) {
      Shown& shown = At(p);
      shown.source = source + p - begin;
      shown.weight = weight;
      if (weight != 0) shown.neighbour = shown.source + neighbour;
    }
  }
  void Hole(int begin, int end, int disparity, int pixel) {
    REQUIRE(begin < end);
    begins.push_back(begin);
    for (int p = begin; p < end; ++p) {
      Shown& shown = At(p);
      shown.hole = true;
      shown.source = pixel;
      shown.disparity = disparity;
    }
  }
  Shown& At(int p) {
    REQUIRE(p >= 0);
    REQUIRE(p < int(pixels.size()));
    ++pixels[size_t(p)].times;
    return pixels[size_t(p)];
  }
};

using Depths = std::vector<int16_t>;

ViewGrid MakeGrid(int n, double focus, double aperture) {
  starfocus::Aperture views;
  views.n = n;
  return starfocus::MakeViewGrid(views, focus, aperture, 0, false, false);
}

Recorder Record(const Depths& line, const ViewGrid& grid, int view, Direction direction, int begin,
                int end) {
  std::vector<starfocus::Run> runs(line.size());
  const int length = int(line.size());
  const int count = starfocus::FindRuns(line.data(), length, direction, grid.spread, runs.data());
  Recorder recorder;
  recorder.pixels.resize(line.size());
  const starfocus::LineView wanted = {&grid, grid.Move(view), grid.Move(1), begin, end};
  starfocus::ScanLine(starfocus::Line{nullptr, line.data(), length}, direction, runs.data(), count,
                      wanted, &recorder);
  return recorder;
}

// The rightmost view of a lens of radius 1 focused at 0: pixels move left by their disparity.
Picture Scan(const Depths& line, int begin, int end) {
  const ViewGrid grid = MakeGrid(1, 0, 1);
  return Record(line, grid, 1, Direction::kRightToLeft, begin, end).pixels;
}
Picture Scan(const Depths& line) { return Scan(line, 0, int(line.size())); }

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
    CHECK_FALSE(picture[size_t(p)].hole);
    CHECK(picture[size_t(p)].source == p + moved);
  }
}

void CheckHole(const Picture& picture, int begin, int end, int pixel, double disparity) {
  for (int p = begin; p < end; ++p) {
    CAPTURE(p);
    CHECK(picture[size_t(p)].times == 1);
    CHECK(picture[size_t(p)].hole);
    CHECK(picture[size_t(p)].source == pixel);
    CHECK(picture[size_t(p)].disparity == int(std::lround(disparity * 64)));
  }
}

TEST_CASE("line scan: a surface in focus stays") {
  CheckSurface(Scan(MakeLine({{9, 0}})), 0, 9, 0);
}

TEST_CASE("line scan: a flat surface moves; its end goes on beyond the line") {
  const Picture nearer = Scan(MakeLine({{9, 2}}));
  CheckSurface(nearer, 0, 7, 2);
  CheckHole(nearer, 7, 9, 8, 2);
  const Picture farther = Scan(MakeLine({{9, -2}}));
  CheckSurface(farther, 2, 9, -2);
  CheckHole(farther, 0, 2, 0, -2);
}

TEST_CASE("line scan: one pixel") {
  CheckSurface(Scan(MakeLine({{1, 0}})), 0, 1, 0);
  CheckHole(Scan(MakeLine({{1, 3}})), 0, 1, 0, 3);
  CheckHole(Scan(MakeLine({{1, -3}})), 0, 1, 0, -3);
}

TEST_CASE("line scan: a near object hides what lies left of it and uncovers what lies right") {
  const Picture picture = Scan(MakeLine({{10, 0}, {5, 4}, {9, 0}}));
  CheckSurface(picture, 0, 6, 0);
  CheckSurface(picture, 6, 11, 4);
  // The side view shows there what goes on behind pixel 15, the first one visible to the right.
  CheckHole(picture, 11, 15, 15, 0);
  CheckSurface(picture, 15, 24, 0);
}

TEST_CASE("line scan: a hole borders on what is visible, not on what the near object hides") {
  // The middle surface lies wholly behind the near one.
  const Picture picture = Scan(MakeLine({{10, 5}, {2, -6}, {9, 9}, {9, 0}}));
  CheckSurface(picture, 0, 3, 5);
  CheckSurface(picture, 3, 12, 9);
  CheckHole(picture, 12, 21, 21, 0);
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
  CHECK_FALSE(Scan(MakeLine({{10, 2}, {10, 2 - step}}))[8].hole);
  CheckHole(Scan(MakeLine({{10, 2}, {10, 2 - step - 1.0 / 64}})), 8, 9, 10, 2 - step - 1.0 / 64);
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
  CheckHole(picture, 11, 13, 15, 0);
}

// A gap of one pixel between two surfaces, where a third one is hidden: the stretch copies from
// the third one, but nothing is blended across the edges.
TEST_CASE("line scan: no neighbour across an edge inside a stretch") {
  const Picture picture = Scan(MakeLine({{10, 3.375}, {2, 0}, {12, 4}}));
  CheckSurface(picture, 0, 8, 3);
  CheckSurface(picture, 8, 20, 4);
  CHECK(picture[5].weight == 96);
  CHECK(picture[5].neighbour == 9);
  CHECK(picture[6].weight == 0);
  CHECK(picture[7].weight == 96);
  CHECK(picture[7].neighbour == 11);
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
      if (shown.weight != 0) CHECK(shown.neighbour == shown.source + (t > 0 ? 1 : -1));
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
        grid(MakeGrid(random->Int(1, 9), random->Real(-4, 4), random->Real(0.2, 1))),
        view(random->Int(1, grid.n())),
        begin(random->Int(0, int(line.size()) - 1)),
        end(random->Int(begin + 1, int(line.size()))) {}

  Depths line;
  ViewGrid grid;
  int view, begin, end;
};

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
        if (shown.times == 0) continue;
        REQUIRE(shown.source >= 0);
        REQUIRE(shown.source < length);
        if (shown.hole) {
          bad += shown.disparity != r.line[size_t(shown.source)];
          continue;
        }
        bad += shown.weight < 0 || shown.weight > 128;
        if (shown.weight == 0) continue;
        REQUIRE(shown.neighbour >= 0);
        REQUIRE(shown.neighbour < length);
        bad +=
            std::abs(r.line[size_t(shown.source)] - r.line[size_t(shown.neighbour)]) > kSurfaceStep;
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
    const Depths mirrored(r.line.rbegin(), r.line.rend());
    Picture left =
        Record(mirrored, r.grid, r.view, Direction::kLeftToRight, length - r.end, length - r.begin)
            .pixels;
    std::reverse(left.begin(), left.end());
    for (Shown& shown : left) {
      if (shown.source >= 0) shown.source = length - 1 - shown.source;
      if (shown.neighbour >= 0) shown.neighbour = length - 1 - shown.neighbour;
    }
    CHECK(left == right);
  }
}

}  // namespace
