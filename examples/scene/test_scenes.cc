// SPDX-License-Identifier: Apache-2.0
// The scenes `wires` and `ramp`, which are difficult for line scans.
#include "examples/scene/builders.h"
#include "examples/scene/textures.h"

namespace starfocus {

Scene MakeWires() {
  Scene scene;
  scene.name = "wires";
  scene.description = "thin wires and two balls over a deep background";
  std::vector<Surface>* out = &scene.surfaces;
  Surface wall = Piece(Outline::kNone, {0, 0, -6}, {0, 0},
                       {PaintBark, {84, 108, 160}, {186, 200, 226}, 1, 201});
  wall.slope_x = 0.002;
  wall.slope_y = 0.001;
  out->push_back(wall);
  out->push_back(Ellipsoid({-150, 110, 4}, {130, 130, 2},
                           {PaintChecker, {64, 150, 74}, {200, 96, 70}, 1, 202}));
  out->push_back(Ellipsoid({230, -90, -1}, {108, 108, 1.4},
                           {PaintChecker, {60, 84, 180}, {226, 190, 90}, 0.7, 203}));
  for (int i = 0; i < 9; ++i) {
    const double x = -480 + 120 * i, d = 9 - 1.25 * i;
    const Color color = {240.0 - 12 * i, 130.0 + 9 * i, 70.0 + 18 * i};
    out->push_back(
        Wire({x, -900, d}, {x + 24, 900, d}, 2.2 + 0.6 * (i % 5),
             {PaintTwist, color, color * 0.25, 1.0 + 0.3 * (i % 3), 210u + uint32_t(i)}));
  }
  for (int i = 0; i < 7; ++i) {
    out->push_back(Wire({-330.0 + 30 * i, -260, -4}, {330.0 - 85 * i, 60.0 + 52 * i, 7}, 2.4,
                        {PaintTwist, {96, 214, 130}, {20, 46, 36}, 1.2, 230u + uint32_t(i)}));
  }
  scene.points = {{"near", -150, 110}, {"middle", 230, -90}, {"far", 40, -310}};
  return scene;
}

Scene MakeRamp() {
  Scene scene;
  scene.name = "ramp";
  scene.description = "a smooth slanted floor";
  Surface floor = Piece(Outline::kNone, {0, 0, 0}, {0, 0},
                        {PaintFloor, {186, 128, 96}, {104, 120, 126}, 1, 301});
  floor.slope_x = 0.002;
  floor.slope_y = 0.024;
  scene.surfaces.push_back(floor);
  scene.points = {{"near", 0, 320}, {"middle", 0, 0}, {"far", 0, -320}};
  return scene;
}

}  // namespace starfocus
