// SPDX-License-Identifier: Apache-2.0
// The reference's parts that know one line: the lens, and which pixel a view shows where.
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

#include "tests/conformance/reference.h"

namespace reference {

using Colour = std::array<double, 3>;

// Two neighbours belong to one surface when their disparities (1/64) differ by at most this.
inline constexpr int kSurfaceStep = 96;
// A wider gap is no stretched surface, in pixels.
inline constexpr int kWidestStretch = 4;

// Floor of value / 2^bits, plus a half: rounding half up.
inline int64_t Rounded(int64_t value, int bits) {
  const int64_t unit = int64_t{1} << bits, sum = value + unit / 2;
  return sum >= 0 ? sum / unit : -((-sum + unit - 1) / unit);
}

inline int RoundedTo64(double value) { return static_cast<int>(std::floor(value * 64 + 0.5)); }

// A view, rendered or captured, with its disparity (1/64) where it has one.
struct Picture {
  int width = 0, height = 0;
  std::vector<Colour> colours;  // light, or what highlights have of it beyond white
  std::vector<Colour> light;  // by which mixtures are told where colours are not light; else empty
  std::vector<int> disparities;

  Picture(int w, int h)
      : width(w), height(h), colours(size_t(w) * size_t(h)), disparities(size_t(w) * size_t(h)) {}

  size_t At(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
  bool Inside(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
};

// A unit of u in positions of captured views.
inline constexpr int kViewUnit = 16384;

// The captured views by position, in parts of kViewUnit.
using LightField = std::map<std::pair<int, int>, Picture>;

// The lens: N views along its radius, and how far pixels move in them.
struct Lens {
  int n = 0;                // outermost view
  int most = 0;             // i^2 + j^2 of the views
  double subapertures = 0;  // radius in those that views stand for; 0: they stand for points
  double radius = 0;        // u_t
  ApertureShape opening = 0.0;
  int focus = 0;     // d_t, 1/64
  int64_t step = 0;  // u_t / 2^layer, 2^-24
  int layer = 0;     // L

  // u of view k, 2^-24.
  int64_t Move(int k) const { return (2 * k * step + n) / (2 * n); }
  // Pixels that a disparity (1/64) moves by in view k, 1/256.
  int Shift(int k, int disparity) const {
    return int(Rounded(Move(k) * (disparity - focus), 24 + 6 - 8));
  }
  // Width of the subaperture on the picture, r / N, at most a pixel: as far as it moves from view
  // to view.
  double Subaperture(int disparity) const {
    return std::min(1.0, std::abs(Shift(1, disparity)) / 256.0);
  }
  // Within a run, disparities (1/64) range over a quarter pixel of displacement at the aperture's
  // rim, and never across the edge of a surface.
  int Spread() const { return int(std::min<int64_t>(kSurfaceStep, (int64_t{16} << 24) / step)); }
  // Views at most half a unit from the centre have a captured view at that distance.
  bool Half(int k) const { return 2 * k * radius <= n; }
  bool Contains(int i, int j) const { return i * i + j * j <= most; }
  double Density(int i, int j) const {
    if (n == 0) return 1;
    const double passing = opening.cats_eye > 0 ? opening.Passing(i, j, Radius()) : 1;
    // Openings that end sharply are sampled as the engine has them.
    if (opening.shape != STARFOCUS_SHAPE_FALL_OFF)
      return passing * opening.Mean(i, j, Radius(), 16);
    // By as many points as other shapes. The integral is 5.5 % more for the four views on the rim
    // of N = 4, 0.02 % of all light each: of lamps ten times white that is three codes of the dark.
    if (subapertures > 0) return passing * opening.Mean(i, j, subapertures, 16);
    return passing * ApertureDensity(double(i) / n, double(j) / n, opening.cot2);
  }
  double Radius() const { return subapertures > 0 ? subapertures : n; }
  // Largest j of the views (i, j) rendered from type A view i: below the diagonal.
  int LastAcross(int i) const {
    int j = std::max(0, i - 1);
    while (j > 0 && !Contains(i, j)) --j;
    return j;
  }
};

// --- One line: the pixels that a view of direction +1 along it shows. ---

// Where a rendered pixel comes from: line pixel `source`, or in a hole what goes on of its surface
// behind what hides it. `share` of the pixel shows line pixel `other` instead: a neighbour on the
// same surface, or the surface on the other side of a depth edge.
struct Owner {
  bool hole = true;
  int source = 0;
  int other = 0;
  double share = 0;

  // The line pixel whose disparity the rendered pixel has.
  int Main() const { return share > 0.5 ? other : source; }
};

struct LineRun {
  int begin, end;
  int disparity;  // the middle of its range
};

// From the end of the line that near surfaces move away from; a run is as long as its disparities
// allow.
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
    const LineRun* nearer = nullptr;  // what is visible at `filled_`
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
  // What rounding to whole pixels leaves out: so much farther down, in pixels, does the run lie.
  double Offset(const LineRun& run) const { return Shift(run) / 256.0 - Whole(run); }
  bool Inside(int p) const { return p >= 0 && p < int(owners_.size()); }
  int Disparity(int q) const { return disparity_[size_t(q)]; }
  bool OneSurface(int q, int other) const {
    return std::abs(Disparity(q) - Disparity(other)) <= kSurfaceStep;
  }

  // The pixels between the run's upper end and what is filled: the run's surface, stretched, unless
  // that ends there or is the nearer one: then what is behind the nearer of the two goes on.
  void CloseGap(const LineRun& run, const LineRun* above) {
    const int q = run.end - 1, visible = above == nullptr ? q : above->begin;
    const int begin = run.end - Whole(run), gap = filled_ - begin;
    const int step = Disparity(q) - Disparity(visible);
    const bool inside = filled_ + Whole(run) <= int(disparity_.size());
    if (step <= kSurfaceStep && gap <= kWidestStretch && inside) return;
    if (step <= kSurfaceStep) return SetHole(begin, step < 0 ? q : visible);
    // The nearer surface ends between rendered pixels, inside one of the hole's.
    const double offset = Offset(run);
    const int rim = offset > 0 ? begin - 1 : begin;
    SetHole(rim, visible);
    if (offset != 0) SetOther(rim, q, offset > 0 ? 1 - offset : -offset);
  }

  // The lower end of a surface, whose last pixel is `end`, and a farther one that goes on there.
  // Between rendered pixels the nearer one covers only a part of its last pixel, or some of the
  // pixel below as well.
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

  // Not yet divided between two surfaces: a run of one pixel has both its ends there.
  bool IsWhole(int p) const {
    return Inside(p) && !owners_[size_t(p)].hole && owners_[size_t(p)].share == 0;
  }

  void SetOther(int p, int other, double share) {
    if (!Inside(p)) return;
    owners_[size_t(p)].other = other;
    owners_[size_t(p)].share = share;
  }

  // Rendered pixels from `begin` to what is filled.
  void SetHole(int begin, int source) {
    for (int p = begin; p < filled_; ++p) {
      if (Inside(p)) owners_[size_t(p)] = {true, source, source, 0};
    }
    filled_ = std::min(filled_, begin);
  }

  // The source lies t away from the rendered pixel's centre; its subaperture of width L gives the
  // neighbour on that side clamp((|t| - 1/2) / L + 1/2, 0, 1). None across the edge of a surface.
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
  int filled_ = 0;  // lowest rendered pixel shown so far
};

// --- One view from another, along the lines of direction (u, v). ---

// `hole(x, y, disparity, colour)` gives the colour of pixel (x, y), behind which a surface of
// `disparity` and `colour` goes on.
template <class Hole>
Picture RenderAlong(const Picture& from, int u, int v, const Lens& lens, int k, const Hole& hole) {
  Picture to(from.width, from.height);
  for (int y0 = 0; y0 < from.height; ++y0) {
    for (int x0 = 0; x0 < from.width; ++x0) {
      if (from.Inside(x0 - u, y0 - v)) continue;  // not the first pixel of a line
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
        for (size_t c = 0; c < 3; ++c) {
          colour[c] += owner.share * (from.colours[other][c] - colour[c]);
        }
      }
    }
  }
  return to;
}

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_LINE_H_
