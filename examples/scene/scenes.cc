// SPDX-License-Identifier: Apache-2.0
// The scene `portrait`: a person with a woollen hat in a room. The subject is near, objects are at
// a medium distance, and the wall is far.
#include "examples/scene/builders.h"
#include "examples/scene/textures.h"

namespace starfocus {
namespace {

using LayeredDepth = std::vector<Surface>;

constexpr double kX = -110;  // x coordinate of the person
constexpr double kWall = -9;

void AddHead(LayeredDepth* out) {
  const Material face = {PaintFace, {248, 196, 164}, {230, 168, 136}, 1, 11};
  const Material skin = {PaintSkin, {244, 188, 156}, {226, 160, 128}, 1, 12};
  const Material neck = {PaintSkin, {170, 116, 92}, {146, 92, 72}, 1, 17};
  const Material hair = {PaintHair, {58, 28, 16}, {186, 104, 50}, 1, 13};
  out->push_back(Ellipsoid({kX, 112, 4.6}, {60, 100, 1.2}, neck));
  out->push_back(Ellipsoid({kX, -38, 6}, {104, 134, 2.2}, face));
  out->push_back(Ellipsoid({kX, -10, 7.7}, {17, 30, 0.95}, skin));
  for (double side : {-1.0, 1.0}) {
    out->push_back(Ellipsoid({kX + side * 92, -4, 5.7}, {38, 122, 1.5}, hair));
    out->push_back(Ellipsoid({kX + side * 104, 70, 5.5}, {34, 84, 1.3}, hair));
    out->push_back(Ellipsoid({kX + side * 13, 10, 7.75}, {11, 9, 0.6}, skin));
  }
}

void AddEyes(LayeredDepth* out) {
  const Material eye = {PaintEye, {72, 128, 140}, {}, 1, 14};
  const Material brow = {PaintHair, {52, 26, 16}, {130, 74, 38}, 1, 15};
  const Material rim = {PaintTwist, {46, 24, 18}, {150, 84, 40}, 0.6, 16};
  for (double side : {-1.0, 1.0}) {
    const double x = kX + side * 41;
    out->push_back(Ellipsoid({x, -40, 7.55}, {20, 15, 0.55}, eye));
    out->push_back(Turned(Ellipsoid({x, -76, 7.6}, {27, 6.5, 0.5}, brow), 1, side * 0.16));
    Surface ring = Piece(Outline::kRing, {x, -38, 8.45}, {36, 33}, rim);
    ring.thickness = 4;
    out->push_back(ring);
    out->push_back(Wire({x + side * 34, -44, 8.45}, {x + side * 62, -48, 6.4}, 2.6, rim));
  }
  out->push_back(Wire({kX - 7, -44, 8.46}, {kX + 7, -44, 8.46}, 2.4, rim));
}

void AddClothes(LayeredDepth* out) {
  const Material hat = {PaintKnit, {186, 44, 44}, {238, 226, 206}, 1.15, 21};
  const Material brim = {PaintKnit, {238, 226, 206}, {214, 196, 170}, 1.3, 22};
  const Material pompom = {PaintFur, {206, 190, 166}, {252, 246, 234}, 1, 23};
  const Material coat = {PaintTweed, {70, 72, 84}, {148, 146, 146}, 1.1, 24};
  const Material scarf = {PaintKnit, {44, 104, 116}, {224, 172, 66}, 1.25, 25};
  const Material button = {PaintMatter, {96, 56, 30}, {170, 112, 64}, 0.8, 26};
  out->push_back(Ellipsoid({kX, -142, 5.9}, {116, 112, 2.35}, hat));
  out->push_back(Ellipsoid({kX, -116, 6.1}, {120, 36, 2.5}, brim));
  out->push_back(Ellipsoid({kX + 6, -268, 5.9}, {46, 44, 1.3}, pompom));
  out->push_back(Ellipsoid({kX, 420, 5.2}, {290, 250, 2.6}, coat));
  out->push_back(Ellipsoid({kX - 190, 400, 5}, {110, 190, 2.2}, coat));
  out->push_back(Ellipsoid({kX + 190, 400, 5}, {110, 190, 2.2}, coat));
  out->push_back(Turned(Ellipsoid({kX, 158, 6}, {132, 44, 2.1}, scarf), 1, 0.06));
  out->push_back(Turned(Ellipsoid({kX, 190, 6.2}, {118, 36, 2.1}, scarf), 1, -0.1));
  out->push_back(Turned(Ellipsoid({kX + 66, 292, 6.9}, {44, 118, 1.6}, scarf), 1, 0.12));
  for (double y : {262.0, 330.0}) {
    out->push_back(Ellipsoid({kX - 24, y, 7.5}, {13, 13, 0.5}, button));
  }
}

void AddTable(LayeredDepth* out) {
  const Material wood = {PaintWood, {142, 88, 48}, {88, 48, 24}, 1, 31};
  Surface table = Piece(Outline::kBox, {0, 430, 5.2}, {3000, 210}, wood);
  table.slope_y = 0.05;
  out->push_back(table);
}

void AddPlant(LayeredDepth* out) {
  const Material pot = {PaintGlaze, {52, 86, 140}, {230, 226, 214}, 1, 41};
  const Material rim = {PaintMatter, {40, 62, 108}, {84, 116, 164}, 1, 42};
  const Material stem = {PaintTwist, {60, 92, 40}, {96, 134, 58}, 2, 43};
  const double x = 268, d = -0.6;
  const Material mat = {PaintMatter, {62, 26, 22}, {112, 52, 38}, 0.7, 44};
  Surface coaster = Piece(Outline::kEllipse, {x + 8, 304, -1.05}, {104, 24}, mat);
  coaster.slope_y = 0.05;
  out->push_back(coaster);
  out->push_back(Ellipsoid({x, 232, d}, {84, 80, 1.7}, pot));
  out->push_back(Ellipsoid({x, 158, d}, {62, 13, 1.2}, rim));
  struct Branch {
    double x, y, rise, length, width;
    Color color;
  };
  const Branch branches[] = {
      {-150, 60, 0.6, 74, 25, {76, 142, 62}},   {-112, -34, 1.2, 84, 27, {94, 160, 66}},
      {-58, -116, -0.9, 82, 26, {60, 122, 58}}, {8, -150, 0.3, 88, 27, {104, 168, 70}},
      {72, -112, 1.4, 80, 27, {84, 150, 60}},   {124, -40, -1.1, 84, 26, {58, 116, 56}},
      {152, 54, 0.9, 76, 25, {92, 152, 64}},    {-66, 24, 1.9, 72, 24, {112, 176, 76}},
      {62, 34, 2.1, 74, 24, {106, 170, 72}},    {-6, -52, 1.7, 78, 25, {88, 156, 66}}};
  uint32_t seed = 50;
  for (const Branch& branch : branches) {
    const double tip = d + branch.rise;
    const Material leaf = {PaintLeaf, branch.color, {192, 214, 132}, 1, seed++};
    out->push_back(Wire({x + 0.1 * branch.x, 156, d},
                        {x + 0.7 * branch.x, 96 + 0.62 * branch.y, d + 0.5 * branch.rise}, 2.6,
                        stem));
    out->push_back(Leaf({x + branch.x, 60 + branch.y, tip}, {branch.x, branch.y - 50},
                        branch.length, branch.width, 0.5, leaf));
  }
}

void AddBooks(LayeredDepth* out) {
  struct Book {
    double x, width, height;
    Color color, letters;
  };
  const Book books[] = {{-420, 96, 19, {128, 42, 40}, {232, 204, 140}},
                        {-414, 88, 15, {40, 78, 92}, {230, 224, 206}},
                        {-426, 92, 21, {178, 140, 66}, {60, 36, 22}},
                        {-416, 78, 14, {70, 92, 58}, {236, 226, 190}}};
  double bottom = 298;
  uint32_t seed = 70;
  for (const Book& book : books) {
    const Material cover = {PaintBook, book.color, book.letters, 1, seed++};
    out->push_back(Piece(Outline::kBox, {book.x, bottom - book.height, -1.2},
                         {book.width, book.height}, cover));
    bottom -= 2 * book.height + 1;
  }
  const Material apple = {PaintMatter, {196, 48, 40}, {226, 168, 70}, 3, 80};
  out->push_back(Ellipsoid({-436, bottom - 36, -1.3}, {40, 38, 1.1}, apple));
  out->push_back(Wire({-436, bottom - 66, -0.9}, {-428, bottom - 92, -0.7}, 2.6,
                      {PaintTwist, {70, 44, 24}, {110, 76, 40}, 1, 81}));
}

void AddWall(LayeredDepth* out) {
  const Material paper = {PaintWallpaper, {34, 62, 74}, {112, 132, 112}, 1, 90};
  Surface wall = Piece(Outline::kNone, {0, 0, kWall}, {0, 0}, paper);
  wall.slope_x = 0.0008;
  out->push_back(wall);
  const Material picture = {PaintLandscape, {120, 82, 34}, {222, 178, 92}, 1, 91};
  const Material second = {PaintLandscape, {64, 42, 28}, {150, 104, 66}, 1, 95};
  out->push_back(Piece(Outline::kBox, {190, -205, kWall + 0.4}, {104, 82}, picture));
  out->push_back(Piece(Outline::kBox, {-420, -60, kWall + 0.3}, {66, 84}, second));
}

// Adds fairy lights on a sagging cord. Out of focus, the lights become discs with the shape of the
// aperture.
void AddLights(LayeredDepth* out) {
  const Material cord = {PaintTwist, {28, 34, 30}, {62, 74, 60}, 0.8, 100};
  const Color colors[] = {{255, 190, 90}, {255, 140, 70}, {255, 214, 130}, {250, 168, 110}};
  const double d = kWall + 1;
  double x = -560, y = -300;
  for (int i = 1; i <= 22; ++i) {
    const double next_x = -560 + 52 * i;
    const double sag = (i % 11) / 11.0;
    const double next_y = -300 + 250 * sag * (1 - sag) - 20 * (i / 11);
    out->push_back(Wire({x, y, d}, {next_x, next_y, d}, 1.8, cord));
    const Material bulb = {PaintBulb, colors[i % 4], {}, 1, 110u + uint32_t(i)};
    out->push_back(Ellipsoid({next_x, next_y + 12, d + 0.05}, {9, 11, 0.2}, bulb));
    x = next_x;
    y = next_y;
  }
}

}  // namespace

Scene MakePortrait() {
  Scene scene;
  scene.name = "portrait";
  scene.description =
      "a person with a woollen hat before a table with a plant and books and a papered wall";
  AddHead(&scene.surfaces);
  AddEyes(&scene.surfaces);
  AddClothes(&scene.surfaces);
  for (Surface& surface : scene.surfaces) surface.foreground = true;
  scene.is_matte = true;
  AddTable(&scene.surfaces);
  AddPlant(&scene.surfaces);
  AddBooks(&scene.surfaces);
  AddWall(&scene.surfaces);
  AddLights(&scene.surfaces);
  scene.points = {{"near", kX + 20, 30}, {"middle", 268, 232}, {"far", 190, -200}};
  return scene;
}

// The scenes `wires` and `ramp`, which are difficult for line scans.

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

namespace {

// The scene `lamps`: a street at night with lamps that are brighter than white.

constexpr double kDarkWall = -8;
// Colours of lamps as codes, at most as bright as white.
constexpr Color kWarm = {255, 214, 150}, kCold = {190, 220, 255}, kRed = {255, 60, 40};

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

Scene MakeLamps(double glare) {
  Scene scene;
  scene.name = "lamps";
  scene.description = "a street at night, with lamps brighter than white";
  std::vector<Surface>* out = &scene.surfaces;
  AddHouse(out);
  for (int k = 0; k < 18; ++k) {
    const double x = -490 + 57 * k, y = 120 + 60 * ((k * 5) % 7) / 7.0;
    const Color color = k % 5 == 0 ? kRed : k % 3 == 0 ? kCold : kWarm;
    AddLamp(x, y, kDarkWall + 1 + 0.2 * (k % 4), 3 + k % 4, color * (k % 2 == 0 ? glare : 1.0),
            out);
  }
  for (int k = 0; k < 3; ++k) {  // lamp posts
    const double x = -330 + 320 * k, d = -3 + 2.5 * k;
    out->push_back(Wire({x, -160, d}, {x, 900, d}, 5,
                        {PaintTwist, {30, 34, 40}, {14, 16, 20}, 1.5, 410u + uint32_t(k)}));
    AddLamp(x, -180, d + 0.1, 20, kWarm * glare, out);
  }
  out->push_back(
      Ellipsoid({-40, 330, 6}, {130, 190, 2}, {PaintTweed, {30, 32, 40}, {70, 70, 74}, 1.1, 420}));
  out->push_back(
      Ellipsoid({-40, 90, 6.4}, {62, 80, 1.6}, {PaintSkin, {120, 86, 70}, {96, 66, 52}, 1, 421}));
  scene.points = {{"near", -40, 90}, {"middle", -10, -180}, {"far", 20, -200}};
  return scene;
}

}  // namespace starfocus
