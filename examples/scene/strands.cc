// SPDX-License-Identifier: Apache-2.0

#include "examples/scene/strands.h"

#include <algorithm>
#include <cmath>

#include "examples/scene/builders.h"
#include "examples/scene/noise.h"
#include "examples/scene/textures.h"

namespace starfocus {
namespace {

constexpr int kParts = 12;  // segments per strand
// Side of a cell in canvas units: about half the length of a segment of hair.
constexpr double kCell = 4;

Point PointAt(const Strand& s, double t) {
  const double a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
  return {a * s.root.x + b * s.middle.x + c * s.tip.x, a * s.root.y + b * s.middle.y + c * s.tip.y};
}

double Square(Point p) { return p.x * p.x + p.y * p.y; }

}  // namespace

Strands::Strands(std::vector<Strand> strands) {
  std::stable_sort(strands.begin(), strands.end(),
                   [](const Strand& p, const Strand& q) { return p.d > q.d; });
  for (size_t i = 0; i < strands.size(); ++i) AddSegments(strands[i], i);
  FitBounds();
  FillGrid();
}

double Strands::Segment::Nearest(Point p) const {
  return std::clamp((p.x - start.x) * direction.x + (p.y - start.y) * direction.y, 0.0, length);
}

Point Strands::Segment::From(double t, Point p) const {
  return {p.x - start.x - t * direction.x, p.y - start.y - t * direction.y};
}

double Strands::Segment::LargestRadius() const {
  return std::max(radius, radius + growth * length);
}

void Strands::AddSegments(const Strand& strand, size_t index) {
  double along = 0;
  Point start = strand.root;
  for (int k = 0; k < kParts; ++k) {
    const Point end = PointAt(strand, (k + 1.0) / kParts);
    const double dx = end.x - start.x, dy = end.y - start.y;
    const double length = std::sqrt(dx * dx + dy * dy);
    if (length > 0) {
      const double change = (strand.tip_radius - strand.root_radius) / kParts;
      segments_.push_back({start,
                           {dx / length, dy / length},
                           length,
                           along,
                           strand.root_radius + k * change,
                           change / length,
                           strand.d,
                           index});
      along += length;
    }
    start = end;
  }
}

void Strands::FitBounds() {
  const Segment& first = segments_.front();
  bounds_ = {first.start.x, first.start.x,      first.start.y,
             first.start.y, segments_.back().d, first.d};
  for (const Segment& s : segments_) {
    const double radius = s.LargestRadius();
    for (const double t : {0.0, s.length}) {
      const Point p = {s.start.x + t * s.direction.x, s.start.y + t * s.direction.y};
      bounds_.x0 = std::min(bounds_.x0, p.x - radius);
      bounds_.x1 = std::max(bounds_.x1, p.x + radius);
      bounds_.y0 = std::min(bounds_.y0, p.y - radius);
      bounds_.y1 = std::max(bounds_.y1, p.y + radius);
    }
  }
}

int Strands::CellAt(double from, int count) {
  return std::clamp(static_cast<int>(from / kCell), 0, count - 1);
}

void Strands::AddToCells(uint32_t index, std::vector<std::vector<uint32_t>>* cells) const {
  const Segment& s = segments_[index];
  // A cell whose centre is farther than `far` from the segment cannot contain a point of a ray that
  // meets the segment.
  const double far = s.LargestRadius() + reach_ * std::sqrt(2.0) + kCell * std::sqrt(0.5);
  const double x = s.start.x - origin_.x, y = s.start.y - origin_.y;
  const double dx = s.length * s.direction.x, dy = s.length * s.direction.y;
  const int x0 = CellAt(x + std::min(0.0, dx) - far, columns_);
  const int x1 = CellAt(x + std::max(0.0, dx) + far, columns_);
  const int y0 = CellAt(y + std::min(0.0, dy) - far, rows_);
  const int y1 = CellAt(y + std::max(0.0, dy) + far, rows_);
  for (int row = y0; row <= y1; ++row) {
    for (int column = x0; column <= x1; ++column) {
      const Point centre = {origin_.x + (column + 0.5) * kCell, origin_.y + (row + 0.5) * kCell};
      if (Square(s.From(s.Nearest(centre), centre)) > far * far) continue;
      (*cells)[size_t(row) * size_t(columns_) + size_t(column)].push_back(index);
    }
  }
}

void Strands::FillGrid() {
  d_ = 0.5 * (bounds_.d0 + bounds_.d1);
  reach_ = kMostSlope * 0.5 * (bounds_.d1 - bounds_.d0);
  origin_ = {bounds_.x0 - reach_, bounds_.y0 - reach_};
  columns_ = static_cast<int>((bounds_.x1 + reach_ - origin_.x) / kCell) + 1;
  rows_ = static_cast<int>((bounds_.y1 + reach_ - origin_.y) / kCell) + 1;
  std::vector<std::vector<uint32_t>> cells(size_t(columns_) * size_t(rows_));
  for (size_t i = 0; i < segments_.size(); ++i) AddToCells(static_cast<uint32_t>(i), &cells);
  first_.push_back(0);
  for (const std::vector<uint32_t>& cell : cells) {
    indices_.insert(indices_.end(), cell.begin(), cell.end());
    first_.push_back(static_cast<uint32_t>(indices_.size()));
  }
}

bool Strands::Find(Point at, double u, double v, StrandHit* hit) const {
  const double x = at.x + u * d_ - origin_.x, y = at.y + v * d_ - origin_.y;
  if (!(x >= 0 && x < columns_ * kCell && y >= 0 && y < rows_ * kCell)) return false;
  const size_t cell = size_t(CellAt(y, rows_)) * size_t(columns_) + size_t(CellAt(x, columns_));
  for (uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const Segment& s = segments_[indices_[i]];
    const Point p = {at.x + u * s.d, at.y + v * s.d};
    const double t = s.Nearest(p), radius = s.radius + s.growth * t;
    const Point from = s.From(t, p);
    if (Square(from) > radius * radius) continue;
    const double across = (from.y * s.direction.x - from.x * s.direction.y) / radius;
    *hit = {p.x, p.y, s.d, s.along + t, across, s.strand};
    return true;
  }
  return false;
}

namespace {

// The scenes `hair`, `grass` and `cutout`: strands thinner and thicker than a pixel in front of a
// far wall. All near disparities lie within a few pixels, so that coverage separates two surfaces.

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

// Disparity of the person of the scene `cutout`. The disparity of the wall is 0.
constexpr double kPerson = 24;
constexpr double kPersonX = -90;

// Creates a curl that starts at an ellipse around the face.
Strand Curl(Dice dice) {
  const double side = dice.Between(0, 1) < 0.5 ? -1 : 1, down = dice.Between(-0.5, 1);
  const double radius = dice.Between(0.25, 0.8), length = dice.Between(40, 130);
  const double bend = dice.Between(-0.5, 0.5);
  const Point root = {kPersonX + side * 118 * std::sqrt(1 - 0.6 * down * down), -20 + 120 * down};
  const Point middle = {root.x + side * 0.6 * length, root.y + 0.3 * length};
  return {root,   middle, {middle.x + side * bend * length, middle.y + 0.6 * length},
          radius, radius, kPerson};
}

// Creates a hair of the hat's fur.
Strand Fur(Dice dice) {
  const double x = dice.Between(-1, 1), y = dice.Between(-1, 1), length = dice.Between(56, 76);
  const Point centre = {kPersonX + 6, -268};
  const Point tip = {centre.x + length * x, centre.y + length * y};
  return {centre, {centre.x + 0.5 * length * x + 4 * y, centre.y + 0.5 * length * y}, tip, 1.2, 0.4,
          kPerson};
}

// Adds a person of one disparity. Where surfaces of equal disparity overlap, the first one is
// visible.
void AddPerson(uint32_t seed, std::vector<Surface>* out) {
  const Material knit = {PaintKnit, {186, 44, 44}, {238, 226, 206}, 1.15, 701};
  const Material brim = {PaintKnit, {238, 226, 206}, {214, 196, 170}, 1.3, 702};
  const Material face = {PaintFace, {248, 196, 164}, {230, 168, 136}, 1, 703};
  const Material eye = {PaintEye, {72, 128, 140}, {}, 1, 704};
  const Material rim = {PaintTwist, {46, 24, 18}, {150, 84, 40}, 0.6, 705};
  const Material hair = {PaintHair, {58, 28, 16}, {186, 104, 50}, 1, 706};
  const Material coat = {PaintTweed, {70, 72, 84}, {148, 146, 146}, 1.1, 707};
  const Material scarf = {PaintKnit, {44, 104, 116}, {224, 172, 66}, 1.25, 708};
  const Material fur = {PaintStrand, {206, 190, 166}, {252, 246, 234}, 1, 709};
  const Material curl = {PaintStrand, {112, 70, 40}, {44, 28, 18}, 1, 710};
  const auto ellipse = [&](double x, double y, const Radii& radii, const Material& material) {
    out->push_back(Piece(Outline::kEllipse, {kPersonX + x, y, kPerson}, radii, material));
  };
  const auto ring = [&](double x, double y, const Radii& radii, double thickness,
                        const Material& material) {
    out->push_back(Piece(Outline::kRing, {kPersonX + x, y, kPerson}, radii, material));
    out->back().thickness = thickness;
  };
  for (double side : {-1.0, 1.0}) {
    ring(side * 41, -38, {36, 33}, 4, rim);
    ellipse(side * 41, -40, {20, 15}, eye);
  }
  std::vector<Strand> furs, curls;
  for (int i = 0; i < 500; ++i) furs.push_back(Fur(Dice(i, seed)));
  for (int i = 0; i < 350; ++i) curls.push_back(Curl(Dice(i, seed + 1)));
  out->push_back(Tuft(furs, fur));
  ellipse(0, -116, {124, 36}, brim);
  ellipse(0, -142, {116, 112}, knit);
  ellipse(0, -38, {104, 134}, face);
  out->push_back(Tuft(curls, curl));
  ellipse(0, 20, {124, 130}, hair);
  ellipse(0, 160, {132, 44}, scarf);
  ellipse(0, 420, {170, 262}, coat);
  // Arms with gaps through which the wall is visible.
  for (double side : {-1.0, 1.0}) ring(side * 150, 320, {122, 130}, 46, coat);
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

Scene MakeCutout(uint32_t seed) {
  Scene scene;
  scene.name = "cutout";
  scene.description = "a person of one disparity before a wall of another disparity";
  scene.seeded = true;
  std::vector<Surface>* out = &scene.surfaces;
  AddPerson(seed, out);
  for (Surface& surface : *out) surface.foreground = true;
  for (int i = 0; i < 14; ++i) {
    const double x = -500 + 76 * i, y = -330 + 90 * HashUnit(i, 0, 720 + seed);
    out->push_back(Piece(Outline::kEllipse, {x, y, 0}, {9, 11},
                         {PaintBulb, {255, 190, 90}, {}, 1, 721u + uint32_t(i)}));
  }
  out->push_back(Piece(Outline::kBox, {330, -40, 0}, {104, 122},
                       {PaintLandscape, {120, 82, 34}, {222, 178, 92}, 1, 740 + seed}));
  out->push_back(Piece(Outline::kNone, {0, 0, 0}, {0, 0},
                       {PaintWallpaper, {34, 62, 74}, {112, 132, 112}, 1, 750 + seed}));
  scene.points = {{"near", kPersonX, 0}, {"far", 330, -40}};
  return scene;
}

}  // namespace starfocus
