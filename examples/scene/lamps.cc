// SPDX-License-Identifier: Apache-2.0
// The scene `lamps`: a street at night with lamps that are up to four times as bright as white.
#include "examples/scene/builders.h"
#include "examples/scene/textures.h"

namespace starfocus {
namespace {

constexpr double kDarkWall = -8;
// Colours of lamps as codes, at most as bright as white. kGlare makes the light of a lamp four
// times as bright.
constexpr Color kWarm = {255, 214, 150}, kCold = {190, 220, 255}, kRed = {255, 60, 40};
constexpr double kGlare = 1.825;

void AddLamp(double x, double y, double d, double radius, const Color& color,
             std::vector<Surface>* out) {
  out->push_back(Piece(Outline::kEllipse, {x, y, d}, {radius, radius},
                       {PaintLamp, color, color * 0.6, 1, 401}));
}

void AddHouse(std::vector<Surface>* out) {
  out->push_back(Piece(Outline::kNone, {0, 0, kDarkWall}, {0, 0},
                       {PaintBark, {16, 18, 30}, {46, 48, 66}, 1, 402}));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 7; ++column) {
      const double x = -420 + 140 * column, y = -260 + 170 * row;
      if ((row * 5 + column * 3) % 7 < 3) continue;
      const Color glass = (row + column) % 3 == 0 ? kCold * 0.5 : kWarm * 0.8;
      out->push_back(Piece(Outline::kBox, {x, y, kDarkWall + 0.1}, {26, 38},
                           {PaintLamp, glass, glass * 0.5, 1, 403}));
      out->push_back(Piece(Outline::kBox, {x, y, kDarkWall + 0.2}, {26, 2},
                           {PaintMatter, {24, 20, 18}, {24, 20, 18}, 1, 404}));
    }
  }
}

}  // namespace

Scene MakeLamps() {
  Scene scene;
  scene.name = "lamps";
  scene.description = "a street at night, with lamps brighter than white";
  std::vector<Surface>* out = &scene.surfaces;
  AddHouse(out);
  for (int k = 0; k < 18; ++k) {
    const double x = -490 + 57 * k, y = 120 + 60 * ((k * 5) % 7) / 7.0;
    const Color color = k % 5 == 0 ? kRed : k % 3 == 0 ? kCold : kWarm;
    AddLamp(x, y, kDarkWall + 1 + 0.2 * (k % 4), 3 + k % 4, color * (k % 2 == 0 ? kGlare : 1.0),
            out);
  }
  for (int k = 0; k < 3; ++k) {  // lamp posts
    const double x = -330 + 320 * k, d = -3 + 2.5 * k;
    out->push_back(Wire({x, -160, d}, {x, 900, d}, 5,
                        {PaintTwist, {30, 34, 40}, {14, 16, 20}, 1.5, 410u + uint32_t(k)}));
    AddLamp(x, -180, d + 0.1, 20, kWarm * kGlare, out);
  }
  out->push_back(
      Ellipsoid({-40, 330, 6}, {130, 190, 2}, {PaintTweed, {30, 32, 40}, {70, 70, 74}, 1.1, 420}));
  out->push_back(
      Ellipsoid({-40, 90, 6.4}, {62, 80, 1.6}, {PaintSkin, {120, 86, 70}, {96, 66, 52}, 1, 421}));
  scene.points = {{"near", -40, 90}, {"middle", -10, -180}, {"far", 20, -200}};
  return scene;
}

}  // namespace starfocus
