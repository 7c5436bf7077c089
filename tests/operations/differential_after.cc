// SPDX-License-Identifier: Apache-2.0
// Sequences of frames: each frame must be equal to the frame refocused alone.
#include <algorithm>

#include "starfocus/starfocus.hpp"
#include "tests/operations/differential.h"

namespace starfocus::stress {
namespace {

// Part of the input that differs between a frame and the previous frame.
enum class Change { kDepths, kCentre, kSides, kRectangle, kEdges, kCoverage, kNothing };

struct Changer {
  test::Scene* scene;
  test::Random* random;

  int X() { return random->Int(0, scene->width - 1); }
  int Y() { return random->Int(0, scene->height - 1); }
  float Depth() {
    const int end = random->Int(0, 2);
    const float low = scene->disparity_min, high = scene->disparity_max;
    if (end < 2) return end == 0 ? low : high;
    return std::clamp(static_cast<float>(random->Real(low, high)), low, high);
  }
  void Sample(int view, int x, int y) {
    scene->Pixel(view, x, y)[random->Int(0, 2)] = random->Byte();
  }

  void Apply(Change change) {
    if (change == Change::kNothing) return;
    if (change == Change::kRectangle) return Rectangle();
    for (int count = random->Int(0, 1) == 0 ? 1 : random->Int(1, 40); count > 0; --count) {
      if (change == Change::kDepths) scene->Disparity(X(), Y()) = Depth();
      if (change == Change::kCentre) Sample(0, X(), Y());
      if (change == Change::kSides) Sample(random->Int(0, scene->views() - 1), X(), Y());
      if (change == Change::kEdges) Edge();
      if (change == Change::kCoverage) Coverage();
    }
  }
  void Coverage() {
    if (scene->coverage.empty()) return;
    scene->coverage[size_t(Y()) * size_t(scene->width) + size_t(X())] = random->Byte();
  }
  // Changes a rectangle of the map or of a view.
  void Rectangle() {
    const int x0 = X(), y0 = Y();
    const int x1 = random->Int(x0, scene->width - 1), y1 = random->Int(y0, scene->height - 1);
    const int view = random->Int(-2, scene->views() - 1);
    const float depth = Depth();
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        if (view < 0) {
          scene->Disparity(x, y) = depth;
        } else {
          Sample(view, x, y);
        }
      }
    }
  }
  // Changes a pixel of the first or last row or column.
  void Edge() {
    const bool upright = random->Int(0, 1) == 0, last = random->Int(0, 1) == 0;
    const int x = upright ? (last ? scene->width - 1 : 0) : X();
    const int y = upright ? Y() : (last ? scene->height - 1 : 0);
    const int view = random->Int(-1, scene->views() - 1);
    if (view < 0) {
      scene->Disparity(x, y) = Depth();
    } else {
      Sample(view, x, y);
    }
  }
};

}  // namespace

std::string After(const Asked& asked, test::Random* random) {
  const bool part = random->Int(0, 2) == 0;
  const test::Scene& first = asked.setup.scene;
  const starfocus_region region =
      part ? RandomRegion(first, random) : starfocus_region{0, 0, first.width, first.height};
  Asked now = asked;
  test::Scene before = first;
  std::vector<uint8_t> last = Crop(asked, region);
  Rig rig(asked.setup.config, RandomVariant(random));
  for (int frame = random->Int(1, 3); frame > 0; --frame) {
    Changer changer = {&now.setup.scene, random};
    changer.Apply(static_cast<Change>(random->Int(0, 6)));
    now.picture = Refocused(now.setup, Variant());
    starfocus::Params params = now.setup.params;
    if (part) params.region = region;
    const starfocus_light_field field = now.setup.scene.Field();
    const starfocus_light_field before_field = before.Field();
    const starfocus_image before_image = starfocus_image_rgb(last.data(), 3 * size_t(region.width));
    const starfocus_previous previous = {sizeof previous, &before_field, &before_image};
    test::Output out(region.width, region.height, random->Int(0, 5));
    const starfocus_status status = Retried(&rig, random, [&] {
      rig.SetCallbacks();
      return test::RefocusAfterRgb(rig.get(), &params, &field, &previous, out.bytes.data(),
                                   out.stride, nullptr);
    });
    const std::string failure = Verdict(rig, status, Crop(now, region), out);
    if (!failure.empty()) return failure;
    last = out.Tight();
    before = now.setup.scene;
  }
  return "";
}

}  // namespace starfocus::stress
