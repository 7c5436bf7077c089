// SPDX-License-Identifier: Apache-2.0
// Line scan of the reference: the opening of the lens, (3) and the shapes of starfocus::Params, the
// lens, and the source of each pixel of a rendered line.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_LINE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_LINE_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace reference {

// Returns the aperture density of equation (3) without its constant factor. `cot2` is the squared
// cotangent of theta.
inline double ApertureDensity(double u, double v, double cot2) {
  const double denominator = u * u + v * v + cot2;
  return cot2 * cot2 / (denominator * denominator);
}

struct ApertureShape {
  double theta;
  int shape = STARFOCUS_SHAPE_FALL_OFF;
  int blades = 0;
  double rotation = 0, curvature = 0, inner = 0, cats_eye = 0;
  double rim_x = 0, rim_y = 0;  // position of the rim behind the lens, seen from a block

  // Edge of a polygon: the direction (x, y) of its normal, and the centre of the edge's arc as a
  // distance along the normal.
  struct Edge {
    double x, y, centre;
  };
  std::array<Edge, STARFOCUS_MAX_BLADES> edges = {};
  double cot2;  // squared cotangent of theta

  ApertureShape(double angle)  // NOLINT: theta alone defines a fall-off
      : theta(angle), cot2(1 / (std::tan(theta) * std::tan(theta))) {}
  ApertureShape(const starfocus::Params& lens)  // NOLINT: converts
      : theta(lens.theta),
        shape(lens.shape),
        blades(lens.blades),
        rotation(lens.rotation),
        curvature(lens.curvature),
        inner(lens.ring_inner),
        cats_eye(lens.cats_eye),
        cot2(1 / (std::tan(theta) * std::tan(theta))) {
    const double half = Half(), r = 1 / curvature, sine = std::sin(half);
    for (int k = 0; k < blades; ++k) {
      const double angle = rotation * kPi / 180 + (2 * k + 1) * half;
      edges[size_t(k)] = {std::sin(angle), -std::cos(angle),
                          std::cos(half) - std::sqrt(r * r - sine * sine)};
    }
  }

  static constexpr double kPi = 3.14159265358979323846;
  // Returns half of the angle between two adjacent corners of the polygon, in radians.
  double Half() const { return kPi / blades; }

  // Returns the opening as seen from the middle of a block, which determines the position of the
  // rim behind the lens.
  ApertureShape At(double x, double y, double block_width, double block_height, double width,
                   double height) const {
    ApertureShape here = *this;
    const double diagonal = std::hypot(width, height);
    here.rim_x = -cats_eye * (2 * x + block_width - width) / diagonal;
    here.rim_y = -cats_eye * (2 * y + block_height - height) / diagonal;
    return here;
  }

  // Returns true if (u, v) is inside all edges of the polygon; edges are straight or arcs of
  // circles.
  bool InPolygon(double u, double v) const {
    const double straight = curvature == 0 ? std::cos(Half()) : 0;
    for (int k = 0; k < blades; ++k) {
      const Edge& edge = edges[size_t(k)];
      if (curvature == 0) {
        if (u * edge.x + v * edge.y > straight) return false;
        continue;
      }
      const double across = u - edge.centre * edge.x, down = v - edge.centre * edge.y;
      if (across * across + down * down > 1 / (curvature * curvature)) return false;
    }
    return true;
  }

  double Density(double u, double v) const {
    const double square = u * u + v * v;
    if (square > 1) return 0;
    if (shape == STARFOCUS_SHAPE_FALL_OFF) return ApertureDensity(u, v, cot2);
    if (shape == STARFOCUS_SHAPE_RING) return square >= inner * inner;
    return shape == STARFOCUS_SHAPE_DISC || InPolygon(u, v) ? 1 : 0;
  }

  // Returns the mean density of the subaperture around (i, j), sampled at `points` x `points`
  // points. The radius of the lens is `width` subapertures.
  double Mean(int i, int j, double width, int points) const {
    double sum = 0;
    ForEachPoint(i, j, width, points, [&](double u, double v) { sum += Density(u, v); });
    return sum / (points * points);
  }

  // Returns the share of the subaperture's open points that the rim behind the lens lets through.
  double Passing(int i, int j, double width) const {
    int open = 0, both = 0;
    ForEachPoint(i, j, width, 16, [&](double u, double v) {
      if (Density(u, v) == 0) return;
      ++open;
      both += std::hypot(u - rim_x, v - rim_y) <= 1;
    });
    return open == 0 ? 0 : double(both) / open;
  }

 private:
  template <class Visit>
  static void ForEachPoint(int i, int j, double width, int points, const Visit& visit) {
    for (int point = 0; point < points * points; ++point) {
      visit((i + (point % points + 0.5) / points - 0.5) / width,
            (j + (point / points + 0.5) / points - 0.5) / width);
    }
  }
};

using Colour = std::array<double, 3>;

inline Colour operator+(const Colour& a, const Colour& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Colour operator-(const Colour& a, const Colour& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Colour operator*(double factor, const Colour& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
inline Colour Clamped(Colour colour) {
  for (double& value : colour) value = std::clamp(value, 0.0, 255.0);
  return colour;
}

// Largest difference of disparity, in 1/64 pixel, between neighbouring pixels of one surface.
inline constexpr int kSurfaceStep = 96;
// Widest gap, in pixels, that is closed by stretching a surface.
inline constexpr int kWidestStretch = 4;

// Returns value / 2^bits, rounded half up.
inline int64_t Rounded(int64_t value, int bits) {
  const int64_t unit = int64_t{1} << bits, sum = value + unit / 2;
  return sum >= 0 ? sum / unit : -((-sum + unit - 1) / unit);
}

inline int RoundedTo64(double value) { return static_cast<int>(std::floor(value * 64 + 0.5)); }

// Calls visit(x, y) for each pixel from (left, top) to before (right, bottom), row by row.
template <class Visit>
void ForEachIn(int left, int top, int right, int bottom, const Visit& visit) {
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) visit(x, y);
  }
}

// Calls visit(x, y) for each pixel of a rectangle, row by row.
template <class Visit>
void ForEachPixel(int width, int height, const Visit& visit) {
  ForEachIn(0, 0, width, height, visit);
}

// Calls visit(dx, dy) for each offset of up to `reach` pixels along both axes, row by row.
template <class Visit>
void ForEachAround(int reach, const Visit& visit) {
  ForEachIn(-reach, -reach, reach + 1, reach + 1, visit);
}

// Values of a rectangle that begins `left` columns before and `top` rows above (0, 0).
template <class T>
struct Grid {
  int left, top, width, height;
  std::vector<T> values;

  Grid(int l, int t, int w, int h)
      : left(l), top(t), width(w), height(h), values(size_t(w) * size_t(h), T{}) {}

  bool Inside(int x, int y) const {
    return x >= -left && x < width - left && y >= -top && y < height - top;
  }
  size_t Index(int x, int y) const { return size_t(y + top) * size_t(width) + size_t(x + left); }
  T& At(int x, int y) { return values[Index(x, y)]; }
  const T& At(int x, int y) const { return values[Index(x, y)]; }
  template <class Visit>
  void ForEach(const Visit& visit) const {
    ForEachIn(-left, -top, width - left, height - top, visit);
  }
};

// Picture of a rendered or captured view; the disparities, in 1/64 pixel, are 0 if the view has no
// map.
struct Picture {
  int width = 0, height = 0;
  std::vector<Colour> colours;  // Light, or the excess of highlights beyond white.
  // Light for finding mixtures of surfaces if `colours` holds the excess of highlights; otherwise
  // empty.
  std::vector<Colour> light;
  std::vector<int> disparities;

  Picture(int w, int h)
      : width(w), height(h), colours(size_t(w) * size_t(h)), disparities(size_t(w) * size_t(h)) {}

  size_t At(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
  // Returns the index of a pixel. Beyond the picture, the outermost pixels are repeated.
  size_t Nearest(int x, int y) const {
    return At(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
  }
  bool Inside(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
};

// Scale of the positions of captured views: kViewUnit is 1 unit of u.
inline constexpr int kViewUnit = 16384;

// Map from the position of a captured view, in 1/kViewUnit, to its picture.
using LightField = std::map<std::pair<int, int>, Picture>;

// The lens: N views along its radius, and the shifts of pixels in the views.
struct Lens {
  int n = 0;                // Index of the outermost view.
  int most = 0;             // Largest i^2 + j^2 of a view (i, j).
  double subapertures = 0;  // Radius of the lens in subapertures; 0: the paper's rule, by which
                            // each view is a point of the lens.
  double radius = 0;        // u_t.
  ApertureShape opening = 0.0;
  // d_t: smallest and largest disparity in focus, in 1/64 pixel.
  int far = 0, near = 0;
  int64_t step = 0;  // u_t / 2^layer, in units of 2^-24.
  int layer = 0;     // L.

  // Returns the position u of view k, in units of 2^-24.
  int64_t Move(int k) const { return (2 * k * step + n) / (2 * n); }
  // Returns the distance of a disparity from the range in focus, negative behind the range.
  int Distance(int disparity) const {
    return std::max(disparity - near, 0) - std::max(far - disparity, 0);
  }
  // Returns the disparity at the same distance from `far` alone.
  int Closed(int disparity) const { return far + Distance(disparity); }
  // Returns the shift, in 1/256 pixels, of a point of `disparity` (in 1/64 pixel) in view k.
  int Shift(int k, int disparity) const {
    return int(Rounded(Move(k) * Distance(disparity), 24 + 6 - 8));
  }
  // Returns the width of a subaperture in the picture: the shift r / N from view to view, but at
  // most one pixel.
  double Subaperture(int disparity) const {
    return std::min(1.0, std::abs(Shift(1, disparity)) / 256.0);
  }
  // Returns the largest range of disparity in a run, in 1/64 pixel: a quarter pixel of displacement
  // at the rim of the aperture. The range never exceeds kSurfaceStep.
  int Spread() const { return int(std::min<int64_t>(kSurfaceStep, (int64_t{16} << 24) / step)); }
  // Returns true if view k is at most half a unit from the centre, where a captured view may exist.
  bool Half(int k) const { return 2 * k * radius <= n; }
  bool Contains(int i, int j) const { return i * i + j * j <= most; }
  // Calls visit(i, j) for each view of the lens, row by row.
  template <class Visit>
  void ForEachView(const Visit& visit) const {
    ForEachAround(n, [&](int i, int j) {
      if (Contains(i, j)) visit(i, j);
    });
  }
  double Density(int i, int j) const {
    if (n == 0) return 1;
    const double passing = opening.cats_eye > 0 ? opening.Passing(i, j, Radius()) : 1;
    // Subapertures of openings with sharp edges are sampled at 16x16 points, as in the engine.
    if (opening.shape != STARFOCUS_SHAPE_FALL_OFF)
      return passing * opening.Mean(i, j, Radius(), 16);
    // The fall-off over a subaperture is sampled at 16x16 points, as for other shapes. With
    // N = 4, the exact integral over each of the four subapertures at the rim is 5.5 % larger than
    // the sampled value. This difference is 0.02 % of all light. Next to lamps ten times as bright
    // as white, the difference is three codes in dark parts of the picture.
    if (subapertures > 0) return passing * opening.Mean(i, j, subapertures, 16);
    return passing * ApertureDensity(double(i) / n, double(j) / n, opening.cot2);
  }
  double Radius() const { return subapertures > 0 ? subapertures : n; }
  // Returns the largest j of the views (i, j), j < i, that are rendered from view i of type A (Fig.
  // 11).
  int LastAcross(int i) const {
    int j = std::max(0, i - 1);
    while (j > 0 && !Contains(i, j)) --j;
    return j;
  }
};

// --- Scan of one line: the pixels that a view in direction +1 along the line shows ---

// Source of a rendered pixel. Outside holes, the rendered pixel shows line pixel `source`. In a
// hole, the surface of line pixel `source` continues behind a nearer surface. A share of the
// rendered pixel shows line pixel `other`. Pixel `other` is a neighbour of `source` on one surface,
// or is on the other side of a depth edge.
struct Owner {
  bool hole = true;
  int source = 0;
  int other = 0;
  double share = 0;

  // Returns the line pixel from which the rendered pixel takes its disparity.
  int Main() const { return share > 0.5 ? other : source; }
};

struct LineRun {
  int begin, end;
  int disparity;  // middle of the run's range of disparities, 1/64 pixel
};

// Returns the runs of a line, starting at the end of the line that near surfaces move away from.
// Each run extends as far as its disparities differ by at most `spread`.
inline std::vector<LineRun> Runs(const std::vector<int>& disparity, int spread) {
  std::vector<LineRun> runs;
  int end = int(disparity.size());
  while (end > 0) {
    int begin = end - 1, low = disparity[size_t(begin)], high = low;
    while (begin > 0) {
      const int next = disparity[size_t(begin - 1)];
      if (std::max(high, next) - std::min(low, next) > spread) break;
      low = std::min(low, next);
      high = std::max(high, next);
      --begin;
    }
    runs.push_back({begin, end, int(std::floor((low + high) / 2.0))});
    end = begin;
  }
  return runs;
}

class LineScan {
 public:
  LineScan(const std::vector<int>& disparity, const Lens& lens, int k)
      : disparity_(disparity), lens_(lens), k_(k), owners_(disparity.size()) {}

  std::vector<Owner> Scan() {
    const int length = int(disparity_.size());
    const std::vector<LineRun> runs = Runs(disparity_, lens_.Spread());
    filled_ = std::max(length, length - Whole(runs[0]));
    const LineRun* nearer = nullptr;  // run that is visible at the pixel `filled_`
    for (const LineRun& run : runs) {
      const int whole = Whole(run);
      if (run.begin - whole >= filled_) continue;  // hidden
      const bool gap = run.end - whole < filled_;
      if (gap) CloseGap(run, nearer);
      const int end = filled_;
      for (; filled_ > run.begin - whole; --filled_) SetSurface(filled_ - 1, run);
      if (!gap && nearer != nullptr) SoftenEnd(*nearer, run, end);
      nearer = &run;
    }
    SetHole(0, nearer->begin);
    return owners_;
  }

 private:
  int Shift(const LineRun& run) const { return lens_.Shift(k_, run.disparity); }
  int Whole(const LineRun& run) const { return int(Rounded(Shift(run), 8)); }
  // Returns the remainder of rounding the run's shift to whole pixels; positive remainders point to
  // the start of the line.
  double Offset(const LineRun& run) const { return Shift(run) / 256.0 - Whole(run); }
  bool Inside(int p) const { return p >= 0 && p < int(owners_.size()); }
  int Disparity(int q) const { return disparity_[size_t(q)]; }
  bool OneSurface(int q, int other) const {
    return std::abs(Disparity(q) - Disparity(other)) <= kSurfaceStep;
  }

  // Closes the gap between the run's upper end and the filled pixels. If the run and the filled
  // pixels belong to one surface, this surface is stretched. Otherwise the farther surface
  // continues into the gap.
  void CloseGap(const LineRun& run, const LineRun* above) {
    const int q = run.end - 1, visible = above == nullptr ? q : above->begin;
    const int begin = run.end - Whole(run), gap = filled_ - begin;
    const int step = Disparity(q) - Disparity(visible);
    const bool inside = filled_ + Whole(run) <= int(disparity_.size());
    if (step <= kSurfaceStep && gap <= kWidestStretch && inside) return;
    if (step <= kSurfaceStep) return SetHole(begin, step < 0 ? q : visible);
    // The nearer surface may cover a part of one rendered pixel at the edge of the hole.
    const double offset = Offset(run);
    const int rim = offset > 0 ? begin - 1 : begin;
    SetHole(rim, visible);
    if (offset != 0) SetOther(rim, q, offset > 0 ? 1 - offset : -offset);
  }

  // Softens the lower end of a surface, whose last pixel is `end`, where a farther surface
  // continues. If the end lies inside a pixel, the nearer surface covers a part of either its last
  // pixel or the next lower pixel.
  void SoftenEnd(const LineRun& nearer, const LineRun& farther, int end) {
    const int q = nearer.begin;
    if (q == 0 || OneSurface(q - 1, q)) return;
    if (nearer.disparity - farther.disparity <= kSurfaceStep) return;
    const double offset = Offset(nearer);
    if (offset < 0 && IsWhole(end)) {
      SetOther(end, std::min(end + Whole(farther), farther.end - 1), -offset);
    } else if (offset > 0 && Inside(end - 1)) {
      owners_[size_t(end - 1)] = {false, end - 1 + Whole(farther), q, offset};
    }
  }

  // Returns true if rendered pixel p is not yet divided between two surfaces. The two ends of a run
  // of one pixel may lie in the same rendered pixel.
  bool IsWhole(int p) const {
    return Inside(p) && !owners_[size_t(p)].hole && owners_[size_t(p)].share == 0;
  }

  void SetOther(int p, int other, double share) {
    if (!Inside(p)) return;
    owners_[size_t(p)].other = other;
    owners_[size_t(p)].share = share;
  }

  // Marks the rendered pixels from `begin` up to the filled pixels as a hole.
  void SetHole(int begin, int source) {
    for (int p = begin; p < filled_; ++p) {
      if (Inside(p)) owners_[size_t(p)] = {true, source, source, 0};
    }
    filled_ = std::min(filled_, begin);
  }

  // Sets a rendered pixel whose source is t pixels away from the centre of the rendered pixel. With
  // a subaperture of width L, the next pixel of the line on the side of the source's offset gets a
  // share. The share is (|t| - 1/2) / L + 1/2, clamped to [0, 1], or 0 if this pixel is on another
  // surface.
  void SetSurface(int p, const LineRun& run) {
    if (!Inside(p)) return;
    Owner owner = {false, p + Whole(run), p + Whole(run), 0};
    const double t = Offset(run), width = lens_.Subaperture(run.disparity);
    const int neighbour = owner.source + (t > 0 ? 1 : -1);
    if (width > 0 && Inside(neighbour) && OneSurface(owner.source, neighbour)) {
      owner.other = neighbour;
      owner.share = std::clamp((std::fabs(t) - 0.5) / width + 0.5, 0.0, 1.0);
    }
    owners_[size_t(p)] = owner;
  }

  const std::vector<int>& disparity_;
  const Lens& lens_;
  int k_;
  std::vector<Owner> owners_;
  int filled_ = 0;  // lowest rendered pixel that is filled
};

// --- Rendering of one view from another view, along lines of direction (u, v) ---

// `hole(x, y, disparity, colour)` returns the colour of pixel (x, y) in a hole. The surface with
// `disparity` and `colour` continues into the hole.
template <class Hole>
Picture RenderAlong(const Picture& from, int u, int v, const Lens& lens, int k, const Hole& hole) {
  Picture to(from.width, from.height);
  for (int y0 = 0; y0 < from.height; ++y0) {
    for (int x0 = 0; x0 < from.width; ++x0) {
      // Pixels that are not the first pixel of a line are skipped.
      if (from.Inside(x0 - u, y0 - v)) continue;
      std::vector<size_t> line;
      std::vector<int> disparity;
      for (int x = x0, y = y0; from.Inside(x, y); x += u, y += v) {
        line.push_back(from.At(x, y));
        disparity.push_back(from.disparities[line.back()]);
      }
      const std::vector<Owner> owners = LineScan(disparity, lens, k).Scan();
      for (size_t p = 0; p < line.size(); ++p) {
        const Owner& owner = owners[p];
        const size_t source = line[size_t(owner.source)], other = line[size_t(owner.other)];
        to.disparities[line[p]] = from.disparities[line[size_t(owner.Main())]];
        Colour& colour = to.colours[line[p]];
        colour = from.colours[source];
        if (owner.hole) {
          colour = hole(x0 + int(p) * u, y0 + int(p) * v, from.disparities[source], colour);
        }
        colour = colour + owner.share * (from.colours[other] - colour);
      }
    }
  }
  return to;
}

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_LINE_H_
