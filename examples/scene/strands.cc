// SPDX-License-Identifier: Apache-2.0
#include "examples/scene/strands.h"

#include <algorithm>
#include <cmath>

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
  reach_ = 0.5 * (bounds_.d1 - bounds_.d0);
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

}  // namespace starfocus
