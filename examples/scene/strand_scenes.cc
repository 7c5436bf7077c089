// SPDX-License-Identifier: Apache-2.0
// The scenes `hair` and `grass`: strands thinner and thicker than a pixel in front of a far wall.
// All near disparities lie within a few pixels, so that coverage separates two surfaces.
#include <cmath>

#include "examples/scene/builders.h"
#include "examples/scene/noise.h"
#include "examples/scene/textures.h"

namespace starfocus {
namespace {

// A sequence of random numbers for one strand.
class Dice {
 public:
  Dice(int strand, uint32_t seed) : strand_(strand), seed_(seed) {}

  double Between(double low, double high) {
    return low + (high - low) * HashUnit(strand_, thrown_++, seed_);
  }

 private:
  int strand_;
  int thrown_ = 0;
  uint32_t seed_;
};

constexpr Point kHead = {-10, 30};
constexpr double kHeadRadius = 155;

// Returns a random direction from the centre of the head, except a sector of a third of a turn on
// the right.
Point HairDirection(Dice* dice) {
  for (;;) {
    const double x = dice->Between(-1, 1), y = dice->Between(-1, 1);
    const double length = std::sqrt(x * x + y * y);
    if (length > 0.05 && length <= 1 && x < 0.5 * length) return {x / length, y / length};
  }
}

Strand Hair(Dice dice) {
  const Point out = HairDirection(&dice);
  const double length = dice.Between(50, 105), lean = dice.Between(-0.7, 0.7);
  const double bend = lean + dice.Between(-0.6, 0.6), droop = dice.Between(0, 0.15);
  const double radius = dice.Between(0.25, 0.75), start = 0.96 * kHeadRadius;
  const Point root = {kHead.x + start * out.x, kHead.y + start * out.y};
  const double half = 0.5 * length;
  // Concentrates the disparities of strands near the middle of the range from 8 to 12.
  const double d = 8 + 4.0 / 3 * (dice.Between(0, 1) + dice.Between(0, 1) + dice.Between(0, 1));
  return {
      root,
      {root.x + half * (out.x - lean * out.y), root.y + half * (out.y + lean * out.x)},
      {root.x + length * (out.x - bend * out.y), root.y + length * (out.y + bend * out.x + droop)},
      radius,
      radius,
      d};
}

constexpr double kGround = 384;

// Creates a blade of grass. Nine of ten blades of grass grow in the left half of the scene.
Strand Blade(int index, Dice dice) {
  const double left = index % 10 == 9 ? 0 : -580;
  const Point root = {dice.Between(left, left + 580), kGround + dice.Between(20, 70)};
  const double height = dice.Between(180, 560), lean = dice.Between(-0.25, 0.25);
  const double bend = lean + dice.Between(-0.2, 0.2);
  return {root,
          {root.x + 0.5 * height * lean, root.y - 0.5 * height},
          {root.x + height * bend, root.y - height},
          dice.Between(0.7, 2),
          0.5,
          dice.Between(7, 11)};
}

}  // namespace

Scene MakeHair(uint32_t seed) {
  Scene scene;
  scene.name = "hair";
  scene.description = "900 strands 0.5 to 1.5 units thick, on a ball before a far wall";
  scene.seeded = true;
  std::vector<Surface>* out = &scene.surfaces;
  out->push_back(Piece(Outline::kNone, {0, 0, -11.4}, {0, 0},
                       {PaintClouds, {196, 220, 230}, {168, 142, 156}, 3.4, 501}));
  out->push_back(Ellipsoid({kHead.x, kHead.y, 9}, {kHeadRadius, kHeadRadius, 5.5},
                           {PaintChecker, {224, 158, 120}, {150, 92, 70}, 0.9, 502}));
  out->back().foreground = true;
  std::vector<Strand> strands;
  for (int i = 0; i < 900; ++i) strands.push_back(Hair(Dice(i, seed)));
  out->push_back(Tuft(strands, {PaintStrand, {112, 70, 40}, {44, 28, 18}, 1, 503}));
  out->back().foreground = true;
  scene.points = {{"near", kHead.x, kHead.y}, {"middle", 100, 30}, {"far", 400, -250}};
  return scene;
}

Scene MakeGrass(uint32_t seed) {
  Scene scene;
  scene.name = "grass";
  scene.description = "600 blades 1 to 4 units thick, dense on the left, before a far wall";
  scene.seeded = true;
  std::vector<Surface>* out = &scene.surfaces;
  Surface wall = Piece(Outline::kNone, {0, 0, -9}, {0, 0},
                       {PaintMatter, {120, 146, 190}, {232, 228, 214}, 6, 601});
  wall.slope_y = 0.003;
  out->push_back(wall);
  out->push_back(Ellipsoid({330, 300, 8.5}, {100, 80, 3},
                           {PaintMatter, {150, 140, 128}, {84, 80, 78}, 1.5, 602}));
  out->back().foreground = true;
  std::vector<Strand> strands;
  for (int i = 0; i < 600; ++i) strands.push_back(Blade(i, Dice(i, seed)));
  out->push_back(Tuft(strands, {PaintStrand, {104, 150, 58}, {44, 74, 30}, 1, 603}));
  out->back().foreground = true;
  scene.points = {{"near", 330, 300}, {"middle", 280, 300}, {"far", 300, -340}};
  return scene;
}

}  // namespace starfocus
