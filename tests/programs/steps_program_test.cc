// SPDX-License-Identifier: Apache-2.0
// Tests the pictures of `starfocus-lab steps` with a scene of two planes whose views and hidden
// parts are known.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "platform/image_io.h"
#include "platform/light_field.h"
#include "platform/runner.h"
#include "tests/programs/session.h"
#include "tests/support/error_line.h"

namespace starfocus::steps_program_test {
namespace {

constexpr int kWidth = 160, kHeight = 80;
constexpr int kNear = 4, kFar = -4;                              // Disparities.
constexpr int kLeft = 32, kRight = 64, kTop = 24, kBottom = 56;  // The square.
constexpr int kCombLeft = 100, kCombRight = 132;

// Returns the part of a pixel of the centre view that the near plane covers. The plane consists of
// a square with a column of mixed pixels on the left, and of a comb of strands 1.5 pixels wide.
double CoverageAt(int x, int y) {
  if (y < kTop || y >= kBottom) return 0;
  if (x >= kCombLeft && x < kCombRight) return x % 4 == 0 ? 1 : x % 4 == 1 ? 0.5 : 0;
  return x >= kLeft && x < kRight ? 1 : x == kLeft - 1 ? 0.5 : 0;
}

double FarCode(int x, int y, int c) {
  return 90 + 40 * (c == 1) + 20 * std::sin(x / 5.0 + c) + 15 * std::cos(y / 7.0);
}
double NearCode(int c) { return c == 0 ? 200 : 60; }

// Returns a sample of view (u, v). The coverage averages light, which is approximately the code to
// the power of 2.2.
uint8_t SampleOf(int u, int v, int x, int y, int c) {
  const double coverage = CoverageAt(x + u * kNear, y + v * kNear);
  const double light = coverage * std::pow(NearCode(c), 2.2) +
                       (1 - coverage) * std::pow(FarCode(x + u * kFar, y + v * kFar, c), 2.2);
  return static_cast<uint8_t>(std::lround(std::pow(light, 1 / 2.2)));
}

LightField TwoPlanes() {
  LightField field;
  field.disparity = {kWidth, kHeight, std::vector<float>(size_t{kWidth} * kHeight)};
  for (int view = 0; view < 5; ++view) {
    double u = 0, v = 0;
    starfocus_view_position(view, &u, &v, nullptr);
    Image picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int c = 0; c < 3; ++c) {
          picture.row(y)[3 * x + c] = SampleOf(int(u), int(v), x, y, c);
        }
        field.disparity.values[size_t(y * kWidth + x)] = CoverageAt(x, y) > 0.5 ? kNear : kFar;
      }
    }
    field.views.push_back(picture);
  }
  return field;
}

// The light field of TwoPlanes and its pictures with the far plane in focus.
struct Steps {
  TempFolder folder;
  LightField field = TwoPlanes();

  Steps() {
    SaveField(folder, "lf", field);
    Succeed(folder, "steps lf -o steps --focus -4");
  }
  Image Get(const std::string& name) const { return Picture(folder, "steps/" + name + ".png"); }
};

const uint8_t* At(const Image& picture, int x, int y) { return picture.row(y) + 3 * x; }

bool IsGrey(const uint8_t* pixel) { return pixel[0] == pixel[1] && pixel[1] == pixel[2]; }

int Distance(const uint8_t* a, const uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// Calls `check` for each pixel of the left part of the picture, which contains only the square.
void ForSquare(const std::function<void(int x, int y)>& check) {
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kCombLeft - 12; ++x) check(x, y);
  }
}

bool IsInSquare(int x, int y) { return x >= kLeft && x < kRight && y >= kTop && y < kBottom; }

TEST_CASE("steps: the mean is sharp in focus, and shows a copy of each view elsewhere") {
  const Steps steps;
  const Image mean = steps.Get("mean"), &centre = steps.field.views[0];
  for (int y = 0; y < kTop - 9; ++y) {
    for (int x = 8; x < kWidth - 8; ++x) CHECK(Distance(At(mean, x, y), At(centre, x, y)) <= 1);
  }
  // Next to the square, where the centre view shows the background, one of the five views shows the
  // square.
  const int red = At(mean, kRight + 4, 40)[0];
  CHECK(red > At(centre, kRight + 4, 40)[0] + 10);
  CHECK(red < NearCode(0) - 50);
  Succeed(steps.folder, "steps lf -o near --focus 4");
  const Image near = Picture(steps.folder, "near/mean.png");
  for (int x = kLeft; x < kRight; ++x) CHECK(Distance(At(near, x, 40), At(centre, x, 40)) <= 1);
  CHECK(Distance(At(near, 12, 12), At(centre, 12, 12)) > 1);
}

TEST_CASE("steps: disparities are brighter if nearer, and each plane is one slice") {
  const Steps steps;
  const Image disparity = steps.Get("disparity"), slices = steps.Get("slices");
  std::set<std::pair<int, int>> colours[2];
  ForSquare([&](int x, int y) {
    CHECK(At(disparity, x, y)[0] == (IsInSquare(x, y) ? 255 : 0));
    if (x == kLeft - 1) return;  // mixed pixels show the slice of the nearer surface
    const uint8_t* const pixel = At(slices, x, y);
    colours[IsInSquare(x, y)].insert({(pixel[0] - pixel[1]) / 4, (pixel[1] - pixel[2]) / 4});
  });
  for (const auto& colour : colours) CHECK(colour.size() <= 4);  // rounded differences
  for (const auto& colour : colours[0]) CHECK(colours[1].count(colour) == 0);
}

// Returns the number of slices of a scene of stripes 16 pixels wide, with disparities 13 and
// 13 - step in turn. Each tile shows both disparities.
size_t SlicesOfStep(float step) {
  TempFolder folder;
  LightField field;
  field.views.assign(5, Image(kWidth, kHeight));
  field.disparity = {kWidth, kHeight, {}};
  for (int k = 0; k < kWidth * kHeight; ++k) {
    field.disparity.values.push_back(k % 32 < 16 ? 13 : 13 - step);
  }
  SaveField(folder, "lf", field);
  Succeed(folder, "steps lf -o steps --focus 0");
  const Image slices = Picture(folder, "steps/slices.png");
  std::set<std::pair<int, int>> colours;
  for (int x = 0; x < kWidth; ++x) colours.insert({At(slices, x, 40)[0], At(slices, x, 40)[1]});
  return colours.size();
}

TEST_CASE("steps: slices are as thick as in the engine") {
  // At a blur of 13 pixels N is 5, and the outermost views lie at 0.859 times the radius of the
  // lens. The blur of these views is 11.17 pixels, and varies within a slice by at most 3/8 of a
  // pixel times (11.17 - 4) / 4. Rounded down several times in units of 1/64, the disparities of a
  // slice differ by at most 47/64 of a pixel.
  CHECK(SlicesOfStep(46 / 64.F) == 1);
  CHECK(SlicesOfStep(49 / 64.F) == 2);
}

TEST_CASE("steps: hidden surfaces show the far plane behind edges only") {
  const Steps steps;
  const Image hidden = steps.Get("hidden");
  ForSquare([&](int x, int y) {
    const int inside = std::min({x - kLeft, kRight - 1 - x, y - kTop, kBottom - 1 - y});
    if (x == kLeft - 1 || inside == 7 || inside == 8) return;
    CHECK(IsGrey(At(hidden, x, y)) == (inside < 0 || inside > 8));
  });
  for (int x = kRight - 7; x < kRight; ++x) {
    for (int c = 0; c < 3; ++c) CHECK(std::abs(At(hidden, x, 40)[c] - FarCode(x, 40, c)) < 12);
  }
}

TEST_CASE("steps: the matte and the coverage show shares of the nearer surface where they differ") {
  const Steps steps;
  const Image matte = steps.Get("matte"), coverage = steps.Get("coverage");
  ForSquare([&](int x, int y) {
    CHECK(!IsGrey(At(coverage, x, y)));  // coverage is measured in thin structures only
    if (x != kLeft - 1) CHECK(IsGrey(At(matte, x, y)));
    // A mixed pixel is half of the nearer and half of the farther colour.
    const uint8_t half[3] = {147, 147, 147};
    if (x == kLeft - 1 && y > kTop && y < kBottom - 1) CHECK(Distance(At(matte, x, y), half) < 25);
  });
  for (int y = kTop + 8; y < kBottom - 8; ++y) {
    for (int x = kCombLeft + 8; x < kCombRight - 8; ++x) {
      CHECK(IsGrey(At(coverage, x, y)));
      CHECK(std::abs(At(coverage, x, y)[0] - 255 * CoverageAt(x, y)) < 50);
    }
  }
}

TEST_CASE(
    "steps: `view` shows the scene from the right, and `holes` marks the square's right edge") {
  const Steps steps;
  const Image view = steps.Get("view"), holes = steps.Get("holes");
  const uint8_t magenta[3] = {255, 0, 255};
  ForSquare([&](int x, int y) {
    const bool is_beside = y > kTop + 1 && y < kBottom - 2;
    if (x > 30 && x < 54 && is_beside) CHECK(std::abs(At(view, x, y)[0] - NearCode(0)) <= 2);
    if (x > kRight) CHECK(Distance(At(view, x, y), At(steps.field.views[0], x, y)) <= 2);
    const bool hole = Distance(At(holes, x, y), magenta) < 60;
    if (hole) CHECK((x > kRight - 9 && x < kRight && y >= kTop - 1 && y <= kBottom));
    if (x > kRight - 6 && x < kRight && is_beside) CHECK(hole);
  });
}

TEST_CASE("steps: the picture `gathered` marks only cells away from depth edges") {
  const Steps steps;
  Succeed(steps.folder, "refocus lf --focus -4 -o plain.png");
  const Image gathered = steps.Get("gathered");
  const Image plain = Picture(steps.folder, "plain.png");
  int marked = 0;
  ForSquare([&](int x, int y) {
    if (Distance(At(gathered, x, y), At(plain, x, y)) == 0) return;
    ++marked;
    CHECK(At(gathered, x, y)[2] > At(gathered, x, y)[1]);
    const bool beside = y >= kTop && y < kBottom;
    for (const int edge : {kLeft, kRight - 1}) CHECK((!beside || std::abs(x - edge) > 7));
  });
  CHECK(marked > 500);
  CHECK(marked < 6000);
}

}  // namespace
}  // namespace starfocus::steps_program_test
