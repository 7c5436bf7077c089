// SPDX-License-Identifier: Apache-2.0
// Makes lines to scan, and records the results of a line scan.
#ifndef STARFOCUS_TESTS_LIB_LINE_SCAN_RECORDER_H_
#define STARFOCUS_TESTS_LIB_LINE_SCAN_RECORDER_H_

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "lib/line_scan/line_scan.h"
#include "tests/lib/find_runs.h"

namespace test {

using starfocus::Direction;
using starfocus::ViewGrid;

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

inline bool operator==(const Shown& a, const Shown& b) {
  return a.times == b.times && a.kind == b.kind && a.source == b.source && a.other == b.other &&
         a.weight == b.weight;
}

using Picture = std::vector<Shown>;

// A sink that records all calls.
struct Recorder {
  Direction direction;
  Picture pixels;
  std::vector<int> begins;  // argument `begin` of every call

  void Surface(int begin, int end, int source, int neighbour, int weight) {
    REQUIRE(begin < end);
    REQUIRE(std::abs(neighbour) == 1);
    begins.push_back(begin);
    for (int p = begin; p < end; ++p) {
      const int from = source + p - begin;
      Show(p, Kind::kSurface, from, weight == 0 ? -1 : from + neighbour,
           int(starfocus::RoundShift(weight, starfocus::simd::kBlendBits - starfocus::kShiftBits)));
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

inline ViewGrid MakeGrid(int n, double focus, double aperture) {
  starfocus::ViewWeights views;
  views.n = views.last = n;
  return starfocus::MakeViewGrid(views, starfocus::MakeFocusRange(focus), aperture, 0);
}

inline Recorder Record(const Depths& line, const ViewGrid& grid, int view, Direction direction,
                       int begin, int end) {
  const std::vector<starfocus::Run> runs =
      test::FindRuns(line, grid, starfocus::RunRange(grid), direction);
  // Stores the disparities `step` elements apart, as in a column of a picture.
  const int step = 1 + int(line.size()) % 3, length = int(line.size());
  Depths spaced(line.size() * size_t(step));
  for (size_t q = 0; q < line.size(); ++q) spaced[q * size_t(step)] = line[q];
  Recorder recorder = {direction, Picture(line.size()), {}};
  const starfocus::Line scanned = {nullptr, spaced.data(), step,
                                   length,  runs.data(),   int32_t(runs.size())};
  starfocus::ScanLine(scanned, direction, {begin, end}, {view, view + 1}, grid, &recorder,
                      [&](int32_t k) { return grid.Move(k); });
  return recorder;
}

// Scans for the rightmost view of a lens of radius 1 focused at 0: pixels move left by their
// disparity.
inline Picture Scan(const Depths& line, int begin, int end) {
  const ViewGrid grid = MakeGrid(1, 0, 1);
  return Record(line, grid, 1, Direction::kRightToLeft, begin, end).pixels;
}
inline Picture Scan(const Depths& line) { return Scan(line, 0, int(line.size())); }

// Return the mirrored line and the mirrored view of the line.
inline Depths Mirrored(const Depths& line) { return {line.rbegin(), line.rend()}; }
inline Picture Mirrored(const Picture& picture) {
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

inline Depths MakeLine(const std::vector<Stretch>& stretches) {
  Depths line;
  for (const Stretch& s : stretches) {
    line.insert(line.end(), size_t(s.pixels), int16_t(std::lround(s.disparity * 64)));
  }
  return line;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_LIB_LINE_SCAN_RECORDER_H_
