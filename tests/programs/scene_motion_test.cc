// SPDX-License-Identifier: Apache-2.0
// Tests that consecutive frames of a moving scene show the same world, and that unstable maps have
// the stated errors.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "examples/scene/builders.h"
#include "examples/scene/motion.h"
#include "examples/scene/noise.h"
#include "examples/scene/render.h"
#include "starfocus/starfocus.h"

namespace starfocus::scene_motion_test {
namespace {

constexpr int kWidth = 200, kHeight = 150;
constexpr double kScale = kWidth / kCanvasWidth;  // pixels per canvas unit

// Movement of the foreground from one frame to another, from the surfaces of both.
struct Rigid {
  Rigid(const Scene& from, const Scene& to) {
    const auto is_near = [](const Surface& surface) { return surface.foreground; };
    const auto at = std::find_if(from.surfaces.begin(), from.surfaces.end(), is_near);
    const Surface& a = *at;
    const Surface& b = to.surfaces[size_t(at - from.surfaces.begin())];
    centre = {a.cx, a.cy};
    target = {b.cx, b.cy};
    turn = {a.ax * b.ax + a.ay * b.ay, a.ax * b.ay - a.ay * b.ax};
  }
  Point Turned(Point p) const { return {p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x}; }
  Point Moved(Point p) const {
    const Point turned = Turned({p.x - centre.x, p.y - centre.y});
    return {target.x + turned.x, target.y + turned.y};
  }

  Point centre, target, turn;
};

// The centre view, the map and the coverage of a frame.
struct Seen {
  Seen(const Scene& scene, ThreadRunner* runner) {
    const RayTracer tracer(scene, kWidth, kHeight, STARFOCUS_TRANSFER_NONE, runner);
    view = tracer.View(0, 0, nullptr);
    map = tracer.Disparity();
    coverage = tracer.Coverage(nullptr);
  }

  // Returns true if pixels within 2 pixels show one surface that is not steep.
  bool IsMiddle(int x, int y) const {
    if (x < 2 || y < 2 || x >= kWidth - 2 || y >= kHeight - 2) return false;
    const float d = map.at(x, y);
    const uint8_t share = coverage[size_t(y * kWidth + x)];
    for (int k = 0; k < 25; ++k) {
      const int px = x + k % 5 - 2, py = y + k / 5 - 2;
      if (std::fabs(map.at(px, py) - d) > 0.12) return false;
      if (coverage[size_t(py * kWidth + px)] != share) return false;
    }
    return share == 0 || share == 255;
  }
  bool IsNear(int x, int y) const { return coverage[size_t(y * kWidth + x)] == 255; }
  // Returns a sample of the green channel, interpolated between four pixels.
  double Green(double x, double y) const {
    const int x0 = int(x), y0 = int(y);
    const double fx = x - x0, fy = y - y0;
    const auto at = [&](int px, int py) { return double(view.row(py)[3 * px + 1]); };
    return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
           fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
  }

  Image view;
  FloatMap map;
  std::vector<uint8_t> coverage;
};

// Returns the pixel position at which frame `to` shows what frame `from` shows at pixel (x, y).
Point Predict(const Scene& from, const Scene& to, const std::optional<Rigid>& rigid, int x, int y,
              double d) {
  const Camera &a = from.camera, &b = to.camera;
  const double du = d / kScale;  // canvas units
  Point p = {(x - 0.5 * (kWidth - 1)) / kScale + a.x + a.u * du,
             (y - 0.5 * (kHeight - 1)) / kScale + a.y + a.v * du};
  if (rigid) p = rigid->Moved(p);
  return {(p.x - b.x - b.u * du) * kScale + 0.5 * (kWidth - 1),
          (p.y - b.y - b.v * du) * kScale + 0.5 * (kHeight - 1)};
}

TEST_CASE("motion: a map and the motion predict the next frame inside surfaces") {
  ThreadRunner runner(2);
  for (const char* name : {"portrait", "wires", "cutout"}) {
    CAPTURE(std::string(name));
    const Scene still = MakeScene(name).value();
    for (const int frame : {0, 45}) {
      CAPTURE(frame);
      const Scene from = SceneAt(still, frame), to = SceneAt(still, frame + 3);
      const Seen now(from, &runner), next(to, &runner);
      for (const bool near : {false, true}) {
        if (near && !still.HasForeground()) continue;
        CAPTURE(near);
        std::optional<Rigid> rigid;
        if (near) rigid.emplace(from, to);
        int count = 0, other = 0;
        double predicted = 0, unmoved = 0, distance = 0;
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            if (!now.IsMiddle(x, y) || now.IsNear(x, y) != near) continue;
            const float d = now.map.at(x, y);
            const Point p = Predict(from, to, rigid, x, y, d);
            const int px = int(std::floor(p.x + 0.5)), py = int(std::floor(p.y + 0.5));
            if (p.x < 0 || p.y < 0 || p.x >= kWidth - 1 || p.y >= kHeight - 1) continue;
            if (!next.IsMiddle(px, py) || next.IsNear(px, py) != near) continue;
            ++count;
            other += std::fabs(next.map.at(px, py) - d) > 0.06 ? 1 : 0;
            predicted += std::fabs(next.Green(p.x, p.y) - now.view.row(y)[3 * x + 1]);
            unmoved += std::fabs(next.Green(x, y) - now.view.row(y)[3 * x + 1]);
            distance += std::hypot(p.x - x, p.y - y);
          }
        }
        CHECK(count > 1500);
        CHECK(other < 0.005 * count);
        CHECK(predicted < 0.5 * unmoved);
        CHECK(distance > (near ? 2 : 1) * count);
      }
    }
  }
}

TEST_CASE("motion: moved rays meet moved surfaces at the same points of their textures") {
  for (const char* name : {"portrait", "hair", "grass", "cutout"}) {
    CAPTURE(std::string(name));
    const Scene still = MakeScene(name).value(), moved = SceneAt(still, 17);
    const Rigid rigid(still, moved);
    CHECK(rigid.Moved({still.points[0].x, still.points[0].y}).x ==
          doctest::Approx(moved.points[0].x));
    int met = 0, wrong = 0;
    for (size_t i = 0; i < still.surfaces.size(); ++i) {
      const Surface &a = still.surfaces[i], &b = moved.surfaces[i];
      if (!a.foreground) {
        CHECK((a.cx == b.cx && a.cy == b.cy && a.ax == b.ax && a.ay == b.ay));
        continue;
      }
      const Bounds box = SurfaceBounds(b, 0);
      for (int k = 0; k < 800; ++k) {
        const Point origin = {1024 * HashUnit(k, 0, 5) - 512, 768 * HashUnit(k, 1, 5) - 384};
        const Point slope = {2 * HashUnit(k, 2, 5) - 1, 2 * HashUnit(k, 3, 5) - 1};
        const Point at = rigid.Moved(origin), along = rigid.Turned(slope);
        Hit first = {}, second = {};
        const bool hits = Intersect(a, {origin.x, origin.y, slope.x, slope.y}, &first);
        wrong += hits != Intersect(b, {at.x, at.y, along.x, along.y}, &second) ? 1 : 0;
        if (!hits) continue;
        ++met;
        const double error =
            std::max({std::fabs(first.d - second.d), std::fabs(first.lx - second.lx),
                      std::fabs(first.ly - second.ly)});
        const bool inside = second.x > box.x0 - 1e-6 && second.x < box.x1 + 1e-6 &&
                            second.y > box.y0 - 1e-6 && second.y < box.y1 + 1e-6;
        wrong += error > 1e-6 || !inside ? 1 : 0;
      }
    }
    CHECK(met > 50);
    CHECK(wrong == 0);
  }
}

TEST_CASE("motion: the camera's points to focus on are found where the map shows them") {
  ThreadRunner runner(1);
  const Scene still = MakeScene("portrait").value();
  const Scene moved = SceneAt(still, 7);
  const RayTracer before(still, 640, 480, STARFOCUS_TRANSFER_NONE, &runner);
  const RayTracer after(moved, 640, 480, STARFOCUS_TRANSFER_NONE, &runner);
  const FloatMap from = before.Disparity(), to = after.Disparity();
  for (size_t i = 0; i < still.points.size(); ++i) {
    int x, y, px, py;
    before.ToPixel(still.points[i].x, still.points[i].y, &x, &y);
    after.ToPixel(moved.points[i].x, moved.points[i].y, &px, &py);
    CHECK(std::fabs(from.at(x, y) - to.at(px, py)) < 0.02);
    CHECK(std::abs(px - x) >= 5);
  }
}

TEST_CASE("unstable maps: noise, offset and outlines change by up to the stated amounts") {
  // A square of disparity 20 in front of disparity 0.
  FloatMap exact = {160, 120, std::vector<float>(160 * 120)};
  const auto outside = [](int x, int y) {  // distance from the square; inside: negative
    return std::max({40 - x, x - 119, 30 - y, y - 89});
  };
  for (int i = 0; i < 160 * 120; ++i) {
    exact.values[size_t(i)] = outside(i % 160, i / 160) <= 0 ? 20.0F : 0.0F;
  }
  std::vector<double> offsets;
  int grown = 0, shrunk = 0, far = 0;
  double noise = 0, step = 0, most = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const FloatMap map = UnstableMap(exact, 3, frame);
    CHECK(map.values == UnstableMap(exact, 3, frame).values);
    CHECK(map.values != UnstableMap(exact, 3, frame + 1).values);
    CHECK(map.values != UnstableMap(exact, 4, frame).values);
    double sum = 0;
    std::vector<double> errors;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const int away = outside(x, y);
        const double d = map.at(x, y);
        const bool near = d > 10;
        grown += near && away > 0 ? 1 : 0;
        shrunk += !near && away <= 0 ? 1 : 0;
        far += near != (away <= 0) && (away > kUnstableOutline || away <= -kUnstableOutline);
        errors.push_back(d - (near ? 20 : 0));
        sum += errors.back();
        if (x > 0) step = std::max(step, std::fabs(errors.back() - errors.end()[-2]));
      }
    }
    // Noise is drawn around 0, so the mean error is about the offset of the frame.
    offsets.push_back(sum / double(errors.size()));
    for (const double error : errors) noise = std::max(noise, std::fabs(error - offsets.back()));
    for (const double error : errors) most = std::max(most, std::fabs(error));
  }
  CHECK(most <= kUnstableNoise + kUnstableOffset + 1e-5);
  CHECK(far == 0);
  // The outline has 360 pixels in each of 12 frames.
  CHECK(grown > 1000);
  CHECK(shrunk > 1000);
  CHECK(noise > 0.7 * kUnstableNoise);
  CHECK(step < 0.08);
  const auto ends = std::minmax_element(offsets.begin(), offsets.end());
  CHECK(*ends.second - *ends.first > kUnstableOffset);
}

}  // namespace
}  // namespace starfocus::scene_motion_test
