// SPDX-License-Identifier: Apache-2.0
// Tests the properties of the line scan on random lines.
#include "lib/line_scan/line_scan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/conformance/reference_line.h"
#include "tests/lib/line_scan_recorder.h"
#include "tests/support/test_scene.h"

namespace line_scan_test {
namespace {

using namespace starfocus;
using namespace test;

TEST_CASE("line scan: weights follow the width of the subaperture") {
  for (int width = 0; width <= 256; ++width) {
    for (int offset = -128; offset <= 128; ++offset) {
      const double t = std::abs(offset) / 256.0, L = width / 256.0;
      const double exact = width == 0 ? 0 : std::clamp((t - 0.5) / L + 0.5, 0.0, 1.0);
      constexpr double kOne = 1 << starfocus::simd::kBlendBits;
      const double weight = starfocus::SubapertureWeight(offset, width) / kOne;
      if (std::fabs(weight - exact) > 1 / kOne) {
        CAPTURES(width, offset);
        CHECK(weight == doctest::Approx(exact));
      }
    }
  }
}

TEST_CASE("line scan: a pixel is blended with the neighbour on the side of the exact position") {
  const ViewGrid grid = MakeGrid(4, 0, 1);
  for (const int view : {1, 2, 3, 4}) {
    for (const double disparity : {0.9, 1.3, 2.1, -0.7, -1.9}) {
      const Depths line = MakeLine({{12, disparity}});
      const Shown shown = Record(line, grid, view, Direction::kRightToLeft, 0, 12).pixels[6];
      const double shift = disparity * view / 4;
      const double t = shift - std::floor(shift + 0.5),
                   width = std::min(1.0, std::fabs(disparity) / 4);
      CAPTURES(view, disparity);
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
  // Disparity by which the surface of `shown.other` is nearer than the surface of `shown.source`.
  const int step = r.line[size_t(shown.other)] - r.line[size_t(shown.source)];
  switch (shown.kind) {
    case Kind::kSurface:
      return std::abs(step) <= kSurfaceStep && shown.weight > 0 && shown.weight <= 128;
    // The disparities of pixels differ from the middle of their run by up to half the spread.
    case Kind::kMix:
      return std::abs(step) > kSurfaceStep - starfocus::RunRange(r.grid) && shown.weight > 0 &&
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

TEST_CASE("line scan: the view of a part of a line equals the same part of the whole view") {
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
  lens.far = grid.focus.far;
  lens.near = grid.focus.near;
  lens.step = grid.step;
  return lens;
}

TEST_CASE("line scan: every pixel matches the reference") {
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
      // Offsets of the engine are exact. Widths of subapertures are rounded, which affects narrow
      // subapertures most.
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
