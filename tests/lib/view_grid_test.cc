// SPDX-License-Identifier: Apache-2.0
// Compares the shifts of pixels from view to view with u * (d - d_t) in double precision.
#include "lib/optics/view_grid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace view_grid_test {
namespace {

using starfocus::ViewGrid;

ViewGrid MakeGrid(int n, double focus, double aperture, int layer = 0) {
  starfocus::ViewWeights views;
  views.n = views.last = n;
  return starfocus::MakeViewGrid(views, starfocus::MakeFocusRange(focus), aperture, layer);
}

TEST_CASE("view grid: the focus is rounded to 1/64, half up") {
  CHECK(MakeGrid(4, 0, 1).focus.far == 0);
  CHECK(MakeGrid(4, 1.5, 1).focus.far == 96);
  CHECK(MakeGrid(4, 1.0 / 128, 1).focus.far == 1);
  CHECK(MakeGrid(4, -1.0 / 128, 1).focus.far == 0);
  CHECK(MakeGrid(4, -3.0 / 128, 1).focus.far == -1);
  CHECK(MakeGrid(4, STARFOCUS_MAX_FOCUS, 1).focus.far == 64000000);
  CHECK(MakeGrid(4, -STARFOCUS_MAX_FOCUS, 1).focus.far == -64000000);
}

TEST_CASE("view grid: shifts grow with the distance from a range in focus, and are 0 inside") {
  ViewGrid grid = MakeGrid(8, 0, 0.7);
  grid.focus = starfocus::MakeFocusRange(0.5, 3, 2);
  const ViewGrid far = MakeGrid(8, -1.5, 0.7), near = MakeGrid(8, 3.5, 0.7);
  for (int disparity = -500 * 64; disparity <= 500 * 64; disparity += 7) {
    const bool behind = disparity<-96, before = disparity> 224;
    if (std::abs(grid.focus.Distance(disparity)) * 0.7 / 64 > STARFOCUS_MAX_BLUR) continue;
    const int expected = behind   ? far.Shift(far.Move(5), disparity)
                         : before ? near.Shift(near.Move(5), disparity)
                                  : 0;
    CHECK(grid.Shift(grid.Move(5), disparity) == expected);
    CHECK(grid.focus.WithoutRange(int16_t(disparity)) ==
          disparity - std::clamp(disparity + 96, 0, 224 + 96));
  }
}

TEST_CASE("view grid: the far end of a range is at least the smallest disparity") {
  CHECK(starfocus::MakeFocusRange(3, 1, 1000).far == -500 * 64);
  CHECK(starfocus::MakeFocusRange(-600, 0, 1000).far == -600 * 64);
  CHECK(starfocus::MakeFocusRange(-600).far == -600 * 64);
}

TEST_CASE("view grid: view i lies at i u_t / N") {
  for (const double aperture : {1.0, 0.5, 0.123456, 1e-9}) {
    for (const int n : {1, 2, 3, 7, 26, 256}) {
      for (const int layer : {0, 1, 2}) {
        const ViewGrid grid = MakeGrid(n, 0, aperture, layer);
        const double rim = std::max(aperture / (1 << layer), 1.0 / (1 << 24));
        double furthest = 0;
        for (int i = 0; i <= n; ++i) {
          furthest = std::max(furthest, std::fabs(double(grid.Move(i)) - rim * i / n * (1 << 24)));
        }
        CAPTURES(aperture, n, layer);
        CHECK(grid.Move(0) == 0);
        CHECK(grid.Move(n) == grid.step);
        CHECK(furthest <= 1.5);
      }
    }
  }
}

TEST_CASE("view grid: shifts are u (d - d_t), to 1/256 of a pixel, within the blur radius") {
  test::Random random(5);
  for (int round = 0; round < 20000; ++round) {
    const double aperture = random.Real(0.01, 1);
    const double radius = random.Real(0, STARFOCUS_MAX_BLUR);
    const double disparity = random.Int(-500 * 64, 500 * 64) / 64.0;
    const double focus =
        std::floor((disparity + (random.Int(0, 1) == 0 ? 1 : -1) * radius / aperture) * 64 + 0.5) /
        64;
    const int n = random.Int(1, 256), i = random.Int(0, n);
    const ViewGrid grid = MakeGrid(n, focus, aperture);
    const int shift = grid.Shift(grid.Move(i), int(disparity * 64));
    const double exact = aperture * i / n * (disparity - focus) * 256;
    // The bound is half a unit of the shift, plus 1.5 units of the view's position (2^-24) times
    // the difference between disparity and focus.
    const double bound = 0.5 + 1.5 * 256 / (1 << 24) * std::fabs(disparity - focus) + 1e-9;
    if (std::fabs(shift - exact) > bound) {
      CAPTURES(aperture, focus, disparity);
      CHECK(std::fabs(shift - exact) <= bound);
    }
    const double blur = aperture * std::fabs(disparity - focus);
    if (std::abs(shift) > std::ceil(blur * 256)) CHECK(std::abs(shift) <= std::ceil(blur * 256));
  }
}

TEST_CASE("view grid: shifts are rounded half up, and pixels in focus do not move") {
  const ViewGrid grid = MakeGrid(4, 2, 1);
  CHECK(grid.Shift(grid.Move(4), 128) == 0);
  CHECK(grid.Shift(grid.Move(4), 129) == 4);
  CHECK(grid.Shift(grid.Move(4), 127) == -4);
  CHECK(grid.Shift(grid.Move(1), 129) == 1);
  const ViewGrid fine = MakeGrid(8, 2, 1);  // halves of 1/256
  CHECK(fine.Shift(fine.Move(1), 129) == 1);
  CHECK(fine.Shift(fine.Move(1), 127) == 0);
  CHECK(fine.Shift(fine.Move(3), 129) == 2);
  CHECK(fine.Shift(fine.Move(3), 127) == -1);
}

}  // namespace
}  // namespace view_grid_test
