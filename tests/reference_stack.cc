#include "tests/reference_stack.h"

#include <set>

#include "lib/placed_slice.h"
#include "lib/slices.h"

namespace reference {
namespace {

// --- What the pixels of the extended rectangle show, and what lies behind them. ---

struct Surface {
  int disparity;  // 1/64
  Colour colour;
  double share = 1;   // of the pixel; what is behind it has the rest
  bool ends = false;  // beside a depth edge
};

// The surfaces at each pixel, the nearest first.
struct SurfaceMap {
  int width, height;
  std::vector<std::vector<Surface>> pixels;

  // Beyond the map its outermost pixels go on.
  const std::vector<Surface>& At(int x, int y) const {
    return pixels[size_t(std::clamp(y, 0, height - 1)) * size_t(width) +
                  size_t(std::clamp(x, 0, width - 1))];
  }
};

// What the far side of the depth edge in one direction shows behind a pixel.
struct Background {
  Direction towards;
  int distance;  // in pixels
  int disparity;
  int captured;  // distance of the captured view that sees it, in halves of a unit; 0: none does

  // Those that a captured view sees come first, and of them those nearest to the pixel.
  bool SameRank(const Background& other) const {
    return (captured == 0) == (other.captured == 0) && distance == other.distance;
  }
  bool Before(const Background& other) const {
    if ((captured == 0) != (other.captured == 0)) return captured != 0;
    if (distance != other.distance) return distance < other.distance;
    return disparity > other.disparity;
  }
};

class SurfaceFinder {
 public:
  // (x0, y0): of the extended rectangle in the layer.
  SurfaceFinder(const LightField& field, const Picture& extended, const Lens& lens, int x0, int y0)
      : field_(field),
        extended_(extended),
        lens_(lens),
        x0_(x0),
        y0_(y0),
        unit_(64 << lens.layer) {}

  SurfaceMap Find() const {
    SurfaceMap map = {extended_.width, extended_.height, {}};
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) map.pixels.push_back(SurfacesOf(x, y));
    }
    return map;
  }

 private:
  int Disparity(int x, int y) const { return extended_.disparities[extended_.At(x, y)]; }

  // A step down by more than 3/4 of a pixel of the layer per pixel is a depth edge.
  bool IsEdge(int near, int far) const { return near - far > unit_ * 3 / 4; }

  std::vector<Surface> SurfacesOf(int x, int y) const {
    std::vector<Surface> surfaces = {{Disparity(x, y), extended_.colours[extended_.At(x, y)]}};
    for (const Direction& side : kDirections) {
      if (!extended_.Inside(x + side.x, y + side.y)) continue;
      surfaces[0].ends |= IsEdge(surfaces[0].disparity, Disparity(x + side.x, y + side.y));
    }
    AddHidden(x, y, &surfaces);
    Part(x, y, &surfaces);
    return surfaces;
  }

  // On the far side of a depth edge the pixel is parted into the near surface and the far one, by
  // the mean over the edges beside it, where some view shows them moved against each other.
  void Part(int x, int y, std::vector<Surface>* surfaces) const {
    const bool outermost =
        x == 0 || y == 0 || x == extended_.width - 1 || y == extended_.height - 1;
    if (lens_.layer != 0 || field_.size() == 1 || outermost) return;
    if (!field_.at({0, 0}).Inside(x0_ + x, y0_ + y)) return;
    Surface near = {INT16_MIN, {0, 0, 0}, 0}, far = {Disparity(x, y), {0, 0, 0}};
    double shares = 0;
    for (const Direction& side : kDirections) {
      const int disparity = Disparity(x + side.x, y + side.y);
      if (!IsEdge(disparity, far.disparity)) continue;
      const int moved = lens_.Shift(lens_.n, disparity) - lens_.Shift(lens_.n, far.disparity);
      if (std::abs(moved) <= 256) continue;
      const Mixed mixed = MixtureAt(field_, x0_ + x, y0_ + y, side, unit_ * 3 / 4);
      if (mixed.share == 0) continue;
      for (size_t c = 0; c < 3; ++c) {
        near.colour[c] += mixed.share * mixed.near[c];
        far.colour[c] += mixed.share * mixed.far[c];
      }
      near.share = std::max(near.share, mixed.share);
      near.disparity = std::max(near.disparity, disparity);
      shares += mixed.share;
    }
    near.share = std::floor(near.share * 128 + 0.5) / 128;  // as the engine keeps it
    if (near.share == 0) return;
    for (size_t c = 0; c < 3; ++c) {
      near.colour[c] /= shares;
      far.colour[c] /= shares;
    }
    surfaces->front() = far;
    surfaces->insert(surfaces->begin(), near);
    if (surfaces->size() > starfocus::simd::kSurfaces) surfaces->pop_back();
  }

  // Behind the visible surface.
  void AddHidden(int x, int y, std::vector<Surface>* hidden) const {
    std::vector<Surface>& surfaces = *hidden;
    std::vector<Background> backgrounds;
    for (const Direction& towards : kDirections) LookBehind(x, y, towards, &backgrounds);
    while (!backgrounds.empty() && surfaces.size() < starfocus::simd::kSurfaces) {
      const Background best =
          *std::min_element(backgrounds.begin(), backgrounds.end(),
                            [](const Background& a, const Background& b) { return a.Before(b); });
      surfaces.push_back({best.disparity, MeanColour(x, y, best, backgrounds)});
      // Within a pixel of disparity it is the same surface.
      const auto same = [&](const Background& other) {
        return std::abs(other.disparity - best.disparity) <= unit_;
      };
      backgrounds.erase(std::remove_if(backgrounds.begin(), backgrounds.end(), same),
                        backgrounds.end());
    }
  }

  // The nearest depth edge in that direction counts, where the pixel hides the edge's far side from
  // the centre view and a view at distance 1 can look that far behind it.
  void LookBehind(int x, int y, const Direction& towards, std::vector<Background>* found) const {
    const int here = Disparity(x, y);
    for (int k = 0;; ++k) {
      const int far_x = x + (k + 1) * towards.x, far_y = y + (k + 1) * towards.y;
      if (!extended_.Inside(far_x, far_y)) return;
      const int far = Disparity(far_x, far_y);
      if (!IsEdge(Disparity(x + k * towards.x, y + k * towards.y), far)) continue;
      if (!IsEdge(here, far) || k * unit_ > here - far) return;
      Background background = {towards, k + 1, far, 0};
      if (field_.size() > 1 && !IsCovered(x, y, background, 2)) {
        background.captured = 2;
      } else if (field_.size() == 17 && !IsCovered(x, y, background, 1)) {
        background.captured = 1;
      }
      found->push_back(background);
      return;
    }
  }

  // Whether a nearer pixel, by more than half a pixel, comes to lie within 3/4 of a pixel of the
  // pixel's background in the captured view at `halves` of a unit.
  bool IsCovered(int x, int y, const Background& background, int halves) const {
    const int unit = unit_ * 2 / halves;
    int moved = 0;
    for (; extended_.Inside(x, y); x += background.towards.x, y += background.towards.y) {
      const int nearer = Disparity(x, y) - background.disparity;
      if (2 * nearer > unit && 4 * std::abs(nearer - moved) < 3 * unit) return true;
      moved += unit;
    }
    return false;
  }

  // The background's colour: the mean over all directions that tie.
  Colour MeanColour(int x, int y, const Background& best,
                    const std::vector<Background>& backgrounds) const {
    Colour sum = {0, 0, 0};
    int count = 0;
    for (const Background& background : backgrounds) {
      if (!background.SameRank(best) || background.disparity != best.disparity) continue;
      const Colour colour = ColourOf(x, y, background);
      for (size_t c = 0; c < 3; ++c) sum[c] += colour[c];
      ++count;
    }
    for (double& value : sum) value /= count;
    return sum;
  }

  Colour ColourOf(int x, int y, const Background& background) const {
    const auto& [dx, dy] = background.towards;
    if (background.captured == 0) {  // the far side goes on
      return extended_
          .colours[extended_.At(x + dx * background.distance, y + dy * background.distance)];
    }
    const double moved =
        double(Rounded(int64_t{4} * background.disparity * background.captured, 1 + lens_.layer)) /
        256;
    return Read(field_, lens_.layer, dx * background.captured, dy * background.captured,
                x0_ + x - dx * moved, y0_ + y - dy * moved);
  }

  const LightField& field_;
  const Picture& extended_;
  const Lens& lens_;
  const int x0_, y0_;
  const int unit_;  // disparity by which pixels move by one from unit to unit
};

// --- Slices: ranges of disparity. ---

struct Range {
  int low, high;
  int overlap;  // a little nearer than high: a part of the next slice too

  int Disparity() const { return low + (high - low) / 2; }  // as which the slice moves
};

class RangeFinder {
 public:
  RangeFinder(const SurfaceMap& map, const Lens& lens, const Rectangle& rect,
              const Slicing& slicing)
      : lens_(lens), rect_(rect), slicing_(slicing) {
    int high = INT32_MIN;
    low_ = INT32_MAX;
    for (const auto& surfaces : map.pixels) {
      for (const Surface& surface : surfaces) {
        low_ = std::min(low_, surface.disparity);
        high = std::max(high, surface.disparity);
      }
    }
    while ((high - low_) / bin_ >= starfocus::kSliceBins) bin_ *= 2;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        for (const Surface& surface : map.At(x, y)) {
          if (Reaches(surface.disparity, x, y)) occupied_.insert((surface.disparity - low_) / bin_);
        }
      }
    }
  }

  // From near to far, the finest that are few and small enough.
  std::vector<Range> Find() const {
    for (int64_t coarser = 1;; coarser *= 2) {
      const std::vector<Range> ranges = Cut(coarser);
      if (ranges.size() <= slicing_.most && Samples(ranges) <= slicing_.samples) {
        return ranges;
      }
    }
  }

 private:
  static constexpr int64_t kMost = 1 << 20;  // no disparity is larger
  static constexpr int kUnitBits = 24 + 6;   // of a disparity times a step

  // Whether a pixel of the extended rectangle is blurred into the rectangle.
  bool Reaches(int disparity, int x, int y) const {
    const int right = rect_.left + rect_.width - 1, bottom = rect_.top + rect_.height - 1;
    const int away = std::max({rect_.left - x, x - right, rect_.top - y, y - bottom, 1}) - 1;
    const int64_t least = (int64_t{away} << kUnitBits) / lens_.step;
    return std::abs(disparity - lens_.focus) >= std::min(kMost, least);
  }

  // How many bins a slice may span whose nearest one is `bin`.
  int64_t Span(int bin, int64_t coarser) const {
    constexpr int64_t kSharp = 4 * 256;  // a blur of 4 pixels
    const auto range = int64_t(256 * slicing_.range);
    const int64_t whole = std::min(kMost, (range << (kUnitBits - 8)) / lens_.step);
    const auto rim = Rounded(lens_.step * (low_ + bin * bin_ - lens_.focus), kUnitBits - 8);
    const int64_t wider = std::max(kSharp, std::abs(rim) - kSharp);
    return std::min(kMost, wider * whole / kSharp / bin_ * coarser);
  }

  std::vector<Range> Cut(int64_t coarser) const {
    std::vector<Range> ranges;
    for (auto nearest = occupied_.rbegin(); nearest != occupied_.rend();) {
      const int64_t span = Span(*nearest, coarser);
      auto next = nearest, farthest = nearest;
      for (; next != occupied_.rend() && *next > *nearest - span; ++next) farthest = next;
      const int low = low_ + *farthest * bin_;
      const int high = std::min(low_ + (*nearest + 1) * bin_ - 1, int{INT16_MAX});
      const int64_t overlap = std::min<int64_t>(high + span * bin_ / 10, INT16_MAX);
      ranges.push_back({low, high, int(overlap)});
      nearest = next;
    }
    return ranges;
  }

  size_t Samples(const std::vector<Range>& ranges) const {
    size_t samples = 0;
    for (const Range& range : ranges) {
      const int rim = std::abs(lens_.Shift(lens_.n, range.Disparity()));
      samples += starfocus::SliceSize(size_t(rect_.width), size_t(rect_.height),
                                      size_t(starfocus::SliceReach(rim)));
    }
    return samples;
  }

  const Lens& lens_;
  const Rectangle& rect_;
  const Slicing slicing_;
  int low_ = 0;  // disparity of bin 0
  int bin_ = 1;  // disparities of a bin
  std::set<int> occupied_;
};

// --- A slice: its pixels, and where views show it. ---

// Three colours times coverage, and the coverage.
using Light = std::array<double, 4>;

// Of a rectangle whose pixel (0, 0) is the refocused one's, reaching beyond it.
struct Plane {
  int left, top, width, height;  // left, top: pixels beyond the rectangle
  std::vector<Light> pixels;

  Plane(int l, int t, int w, int h)
      : left(l), top(t), width(w), height(h), pixels(size_t(w) * size_t(h), Light{}) {}

  bool Inside(int x, int y) const {
    return x >= -left && x < width - left && y >= -top && y < height - top;
  }
  Light& At(int x, int y) { return pixels[size_t(y + top) * size_t(width) + size_t(x + left)]; }
  const Light& At(int x, int y) const {
    return pixels[size_t(y + top) * size_t(width) + size_t(x + left)];
  }
};

// A wider cell of the aperture, in pixels, is spread before its slice is moved.
constexpr double kWidestBox = 3;

// Spread by a box along x or y. What lies beyond the plane is empty: no view shows what it changes.
Plane Spread(const Plane& from, double box, int dx, int dy) {
  Plane to = from;
  const int reach = int(std::ceil((box - 1) / 2));
  for (int y = -from.top; y < from.height - from.top; ++y) {
    for (int x = -from.left; x < from.width - from.left; ++x) {
      Light sum = {};
      for (int k = -reach; k <= reach; ++k) {
        if (!from.Inside(x + k * dx, y + k * dy)) continue;
        const double covered = std::min(box / 2, k + 0.5) - std::max(-box / 2, k - 0.5);
        const Light& light = from.At(x + k * dx, y + k * dy);
        for (size_t c = 0; c < 4; ++c) sum[c] += covered / box * light[c];
      }
      to.At(x, y) = sum;
    }
  }
  return to;
}

Plane MakePlane(const SurfaceMap& map, const Range& range, const Lens& lens,
                const Rectangle& rect) {
  const int reach = starfocus::SliceReach(std::abs(lens.Shift(lens.n, range.Disparity())));
  Plane plane(reach, reach, rect.width + 2 * reach, rect.height + 2 * reach);
  for (int y = -reach; y < rect.height + reach; ++y) {
    for (int x = -reach; x < rect.width + reach; ++x) {
      for (const Surface& surface : map.At(x + rect.left, y + rect.top)) {
        // In two slices the end of a surface would cover twice as much.
        const int high = surface.share < 1 || surface.ends ? range.high : range.overlap;
        if (surface.disparity < range.low || surface.disparity > high) continue;
        Light& light = plane.At(x, y);
        const double part = (1 - light[3]) * surface.share;
        for (size_t c = 0; c < 3; ++c) light[c] += part * surface.colour[c];
        light[3] += part;
      }
    }
  }
  const double cell = std::abs(lens.Shift(1, range.Disparity())) / 256.0;
  const double box = std::min(cell, 2.0 * starfocus::simd::kMaxSpread + 1);
  return box > kWidestBox ? Spread(Spread(plane, box, 1, 0), box, 0, 1) : plane;
}

// What a view sees of pixels one after the other, from `first` on.
struct Offset {
  int first;
  std::vector<double> parts;
  double inside;  // of the second of two pixels that are covered alike, instead of parts[1]

  template <class At>
  Light See(const At& at) const {
    Light seen = {};
    for (size_t k = 0; k < parts.size(); ++k) {
      const Light light = at(first + int(k));
      for (size_t c = 0; c < 4; ++c) seen[c] += parts[k] * light[c];
    }
    if (parts.size() != 2) return seen;
    const Light from = at(first), to = at(first + 1);
    if (std::abs(from[3] - to[3]) >= 1e-9) return seen;
    for (size_t c = 0; c < 4; ++c) seen[c] = from[c] + inside * (to[c] - from[c]);
    return seen;
  }
};

// Of view k along an axis. An aperture's cell of one to three pixels covers what it does of pixels;
// a narrower one less of the pixels on either side of it than interpolation.
Offset OffsetOf(const Lens& lens, int k, int disparity) {
  const int shift = (k < 0 ? -1 : 1) * (k == 0 ? 0 : lens.Shift(std::abs(k), disparity));
  const double moved = shift / 256.0;
  const double cell = std::max(1, std::abs(lens.Shift(1, disparity))) / 256.0;
  if (cell > 1 && cell <= kWidestBox) {
    const double left = moved - cell / 2 + 0.5, right = moved + cell / 2 + 0.5;
    Offset box = {int(std::floor(left)), {}, 0};
    for (int x = box.first; x < right; ++x) {
      box.parts.push_back((std::min(right, x + 1.0) - std::max(left, double(x))) / cell);
    }
    if (box.parts.size() == 2) box.inside = box.parts[1];
    return box;
  }
  const double whole = std::floor(moved), edge = moved - whole;
  if (edge == 0) return {int(whole), {1}, 0};
  const double inside = cell >= 1 ? edge : std::clamp((edge - 0.5) / cell + 0.5, 0.0, 1.0);
  return {int(whole), {1 - edge, edge}, inside};
}

// As views of one column show a plane: moved along x, over the rectangle's columns.
Plane MovedAlongX(const Plane& from, const Offset& offset, int width) {
  Plane to(0, from.top, width, from.height);
  for (int y = -from.top; y < from.height - from.top; ++y) {
    for (int x = 0; x < width; ++x) {
      to.At(x, y) = offset.See([&](int k) { return from.At(x + k, y); });
    }
  }
  return to;
}

// --- Views: slices in front of each other. ---

// What a slice that covers more than what is left of the light gives of itself: the part that is
// left, light / covered, as the first terms of a series in what the slice leaves open.
double ShareOf(double covered, double light) {
  const double open = 1 - covered;
  return std::min(4 * light, 1 - (covered - light) * (1 + open + open * open));
}

class Stack {
 public:
  Stack(const SurfaceMap& map, const std::vector<Range>& ranges, const Lens& lens,
        const Rectangle& rect)
      : ranges_(ranges), lens_(lens), rect_(rect), sum_(0, 0, rect.width, rect.height) {
    for (const Range& range : ranges) planes_.push_back(MakePlane(map, range, lens, rect));
  }

  // The weighted sum of all views.
  const Plane& AddViews() {
    for (int i = -lens_.n; i <= lens_.n; ++i) {
      std::vector<Plane> column;
      for (size_t k = 0; k < planes_.size(); ++k) {
        column.push_back(
            MovedAlongX(planes_[k], OffsetOf(lens_, i, ranges_[k].Disparity()), rect_.width));
      }
      for (int j = -lens_.n; j <= lens_.n; ++j) {
        if (lens_.Contains(i, j)) AddView(column, j, lens_.Density(i, j));
      }
    }
    return sum_;
  }

 private:
  void AddView(const std::vector<Plane>& column, int j, double weight) {
    std::vector<Offset> offsets;
    for (const Range& range : ranges_) offsets.push_back(OffsetOf(lens_, j, range.Disparity()));
    for (int y = 0; y < rect_.height; ++y) {
      for (int x = 0; x < rect_.width; ++x) {
        double light = 1;
        for (size_t k = 0; k < column.size() && light > 0; ++k) {
          const auto at = [&](int row) { return column[k].At(x, y + row); };
          Take(offsets[k].See(at), weight, &light, &sum_.At(x, y));
        }
      }
    }
  }

  // A slice takes of the light what it covers, the last one what is left.
  static void Take(const Light& slice, double weight, double* light, Light* sum) {
    const double covered = slice[3];
    if (covered > *light) weight *= ShareOf(covered, *light);
    for (size_t c = 0; c < 4; ++c) (*sum)[c] += weight * slice[c];
    *light = std::max(0.0, *light - covered);
  }

  const std::vector<Range>& ranges_;
  const Lens& lens_;
  const Rectangle& rect_;
  std::vector<Plane> planes_;
  Plane sum_;
};

}  // namespace

Picture RefocusStack(const LightField& field, const Picture& centre, const Lens& lens,
                     const Rectangle& rectangle, const Slicing& slicing) {
  Picture extended = ExtendedRectangle(centre, rectangle);
  LookBeyond(field, field.at({0, 0}), lens.layer, rectangle, &extended);
  const SurfaceMap map = SurfaceFinder(field, extended, lens, rectangle.x - rectangle.left,
                                       rectangle.y - rectangle.top)
                             .Find();
  const std::vector<Range> ranges = RangeFinder(map, lens, rectangle, slicing).Find();
  Stack stack(map, ranges, lens, rectangle);
  const Plane& sum = stack.AddViews();
  double total = 0;
  for (int j = -lens.n; j <= lens.n; ++j) {
    for (int i = -lens.n; i <= lens.n; ++i) total += lens.Contains(i, j) ? lens.Density(i, j) : 0;
  }
  Picture picture(rectangle.width, rectangle.height);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      // Where slices cover less than a quarter of all light, the pixel is that of the centre view.
      const Light& light = sum.At(x, y);
      Colour& colour = picture.colours[picture.At(x, y)];
      colour = extended.colours[extended.At(x + rectangle.left, y + rectangle.top)];
      if (4 * light[3] < total) continue;
      for (size_t c = 0; c < 3; ++c) colour[c] = std::min(255.0, light[c] / light[3]);
    }
  }
  return picture;
}

}  // namespace reference
