// SPDX-License-Identifier: Apache-2.0
// Hair, needles and blades: curves with a thickness and a constant disparity. A grid of cells over
// the canvas limits the intersection tests of a ray to the strands near the ray.
#ifndef STARFOCUS_EXAMPLES_SCENE_STRANDS_H_
#define STARFOCUS_EXAMPLES_SCENE_STRANDS_H_

#include <cstddef>
#include <cstdint>
#include <vector>

namespace starfocus {

struct Point {
  double x, y;
};

// A quadratic Bezier curve, in canvas units. The half width changes linearly from root to tip.
struct Strand {
  Point root, middle, tip;
  double root_radius, tip_radius;
  double d;  // disparity
};

// Intersection of a ray and a strand.
struct StrandHit {
  double x, y, d;
  // `along` is the distance from the root in canvas units. `across` grows from -1 on one side of
  // the strand to 1 on the other side.
  double along, across;
  size_t strand;  // index of the strand, counted from the nearest strand
};

// Ranges of x, y and d that contain a whole surface.
struct Bounds {
  double x0, x1, y0, y1, d0, d1;
};

class Strands {
 public:
  // Largest |u| and |v| of rays: 1 for the views of a camera, and 1 for the way that it moves.
  static constexpr double kMostSlope = 2;

  // @param strands at least one strand; lengths must be above 0
  explicit Strands(std::vector<Strand> strands);

  const Bounds& bounds() const { return bounds_; }

  // Returns true if the points (x, y) + (u, v) * d meet a strand, and sets *hit to the nearest
  // intersection. u and v must be within +-kMostSlope.
  bool Find(Point at, double u, double v, StrandHit* hit) const;

 private:
  // A straight part of a strand, with round ends.
  struct Segment {
    Point start, direction;  // Direction is a unit vector.
    double length, along;    // Length of the segment, and distance of its start from the root.
    double radius, growth;   // Half width at the start, and its change per canvas unit.
    double d;
    size_t strand;

    // Returns the distance from the start of the segment to the point of the segment nearest to p.
    double Nearest(Point p) const;
    // Returns the vector to p from the point of the segment at distance t from the start.
    Point From(double t, Point p) const;
    double LargestRadius() const;
  };

  void AddSegments(const Strand& strand, size_t index);
  void FitBounds();
  void AddToCells(uint32_t index, std::vector<std::vector<uint32_t>>* cells) const;
  void FillGrid();
  // Returns the column (or row) of cells at distance `from` from the grid's left (or upper) side.
  static int CellAt(double from, int count);

  // Segments of all strands, from the nearest strand to the farthest.
  std::vector<Segment> segments_;
  Bounds bounds_ = {};
  // The grid lies in the plane of disparity d_. A ray meets strands only at distances of at most
  // reach_ from the intersection of the ray with this plane.
  double d_ = 0, reach_ = 0;
  Point origin_ = {0, 0};
  int columns_ = 0, rows_ = 0;
  // Segments of cell i: indices_[first_[i]] to indices_[first_[i + 1] - 1], nearest first.
  std::vector<uint32_t> first_, indices_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_STRANDS_H_
