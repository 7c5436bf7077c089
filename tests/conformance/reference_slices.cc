// SPDX-License-Identifier: Apache-2.0
// Refocuses one rectangle in the reference with slices and subapertures. The pixels of each tile
// are divided into a stack of slices. Each view moves the slices of a stack by different distances.
#include <set>

#include "lib/slices/slice_plane.h"
#include "tests/conformance/reference.h"

namespace reference {
namespace {

// --- Slices: ranges of disparity ---

struct Range {
  int low, high;
  // The slice includes surfaces up to the disparity `overlap`, which is no less than `high`.
  int overlap;

  int Disparity() const { return low + (high - low) / 2; }  // disparity by which the slice moves
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
    ForEachPixel(map.width, map.height, [&](int x, int y) {
      for (const Surface& surface : map.At(x, y)) {
        if (Reaches(surface.disparity, x, y)) occupied_.insert((surface.disparity - low_) / bin_);
      }
    });
  }

  // Returns the ranges of disparity of the slices, from near to far: the finest ranges within the
  // limits of `slicing_`.
  std::vector<Range> Find() const {
    for (int64_t coarser = 1;; coarser *= 2) {
      const std::vector<Range> ranges = Part(coarser);
      if (ranges.size() <= slicing_.most && Fit(ranges)) return ranges;
    }
  }

 private:
  static constexpr int64_t kMost = 1 << 20;  // Upper bound of disparities.
  static constexpr int kUnitBits = 24 + 6;   // Fractional bits of disparity * step.

  // Returns true if a pixel of the extended rectangle is blurred into the rectangle.
  bool Reaches(int disparity, int x, int y) const {
    const int right = rect_.left + rect_.width - 1, bottom = rect_.top + rect_.height - 1;
    const int away = std::max({rect_.left - x, x - right, rect_.top - y, y - bottom, 1}) - 1;
    const int64_t least = (int64_t{away} << kUnitBits) / lens_.step;
    return std::abs(lens_.Distance(disparity)) >= std::min(kMost, least);
  }

  // Returns the largest number of bins of disparity in a slice whose nearest bin is `bin`.
  int64_t Span(int bin, int64_t coarser) const {
    constexpr int64_t kSharp = 4 * 256;  // blur of 4 px, in 1/256
    const auto range = int64_t(256 * slicing_.range);
    const int64_t whole = std::min(kMost, (range << (kUnitBits - 8)) / lens_.step);
    const auto rim = Rounded(lens_.step * lens_.Distance(low_ + bin * bin_), kUnitBits - 8);
    const int64_t wider = std::max(kSharp, std::abs(rim) - kSharp);
    return std::min(kMost, wider * whole / kSharp / bin_ * coarser);
  }

  std::vector<Range> Part(int64_t coarser) const {
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

  bool Fit(const std::vector<Range>& ranges) const {
    int area = 0;
    for (const Range& range : ranges) {
      const int rim = std::abs(lens_.Shift(lens_.n, range.Disparity()));
      const int subaperture = std::abs(lens_.Shift(1, range.Disparity()));
      const int reach = starfocus::SliceReach(rim, subaperture);
      area += (reach + 16) * (reach + 16);
    }
    return area <= slicing_.area;
  }

  const Lens& lens_;
  const Rectangle& rect_;
  const Slicing slicing_;
  int low_ = 0;  // Smallest disparity of bin 0, 1/64 pixel.
  int bin_ = 1;  // Number of disparities in a bin.
  std::set<int> occupied_;
};

// --- Pixels of a slice, and the positions of these pixels in views ---

// Colour of a pixel, three channels multiplied by the coverage, followed by the coverage.
using Light = std::array<double, 4>;

// Pixels of a rectangle and its surroundings. Pixel (0, 0) is the first pixel of the refocused
// rectangle.
using Plane = Grid<Light>;

// Widest subaperture, in pixels, that the filter of a view applies while the slice is moved. For
// wider subapertures, the slice is spread before the slice is moved.
constexpr double kWidestBox = 3;

// Spreads a plane by a box along x or y. Pixels beyond the plane count as empty, since no view
// shows the pixels that they would affect.
Plane Spread(const Plane& from, double box, int dx, int dy) {
  Plane to = from;
  const int reach = int(std::ceil((box - 1) / 2));
  from.ForEach([&](int x, int y) {
    Light sum = {};
    for (int k = -reach; k <= reach; ++k) {
      if (!from.Inside(x + k * dx, y + k * dy)) continue;
      const double covered = std::min(box / 2, k + 0.5) - std::max(-box / 2, k - 0.5);
      const Light& light = from.At(x + k * dx, y + k * dy);
      for (size_t c = 0; c < 4; ++c) sum[c] += covered / box * light[c];
    }
    to.At(x, y) = sum;
  });
  return to;
}

Plane MakePlane(const SurfaceMap& map, const Range& range, const Lens& lens,
                const Rectangle& rect) {
  // The plane is larger than the rectangle on each side by more than the movement of the slice in
  // any view.
  const int reach = std::abs(lens.Shift(lens.n, range.Disparity())) / 256 + 6;
  Plane plane(reach, reach, rect.width + 2 * reach, rect.height + 2 * reach);
  plane.ForEach([&](int x, int y) {
    for (const Surface& surface : map.At(x + rect.left, y + rect.top)) {
      // A pixel at the end of a surface must be in a single slice, since in two slices its
      // coverage would be doubled.
      const int high = surface.share < 1 || surface.ends ? range.high : range.overlap;
      if (surface.disparity < range.low || surface.disparity > high) continue;
      Light& light = plane.At(x, y);
      const double part = (1 - light[3]) * surface.share;
      for (size_t c = 0; c < 3; ++c) light[c] += part * surface.colour[c];
      light[3] += part;
    }
  });
  const double width = std::abs(lens.Shift(1, range.Disparity())) / 256.0;
  const double box = std::min(width, 2.0 * starfocus::simd::kMaxSpread + 1);
  return box > kWidestBox ? Spread(Spread(plane, box, 1, 0), box, 0, 1) : plane;
}

// Filter of a view: weights of consecutive pixels, starting at `first`.
struct Offset {
  int first;
  std::vector<double> parts;
  double inside;  // Weight that replaces parts[1] if two pixels have equal coverage.

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

// Returns the share of the second pixel of two, where each part of a subaperture shows the nearer
// pixel.
double NearerShare(double rest, double width) {
  return std::clamp((rest - 0.5) / width + 0.5, 0.0, 1.0);
}

// Returns the factor by which pixels inside a slice move more or less than the slice. With this
// factor, the variance of the shown pixels exceeds the variance of the subapertures, which are
// `width` wide, by a quarter, or by 1/24 of a pixel.
double InnerScale(const Lens& lens, int disparity, double width) {
  std::vector<double> shifts, weights;
  double total = 0, exact = 0;
  for (int i = 0; i <= lens.n; ++i) {
    shifts.push_back(i == 0 ? 0 : std::abs(lens.Shift(i, disparity)) / 256.0);
    weights.push_back(0);
    lens.ForEachView([&](int column, int j) {
      if (std::abs(column) == i) weights.back() += lens.Density(column, j);
    });
    total += weights.back();
    exact += weights.back() * shifts.back() * shifts.back();
  }
  const double own = std::abs(lens.Shift(1, disparity)) / 256.0;
  exact = exact / total + own * own / 12;
  const double wanted = exact + std::min(exact / 4, 1.0 / 24);
  const double outermost = std::max(shifts.back(), 1.0 / 256);
  const auto is_narrow = [&](double scale) {
    double variance = 0;
    for (size_t i = 1; i < shifts.size(); ++i) {
      const double moved = scale * shifts[i], whole = std::floor(moved);
      const double share = NearerShare(moved - whole, scale * width);
      variance += weights[i] * (whole * whole + (2 * whole + 1) * share) / total;
    }
    return variance < wanted;
  };
  double low = 0, high = std::max(outermost, 1.0) / outermost;
  if (is_narrow(high)) return high;
  for (int k = 0; k < 12; ++k) {
    const double middle = (low + high) / 2;
    if (is_narrow(middle)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return high;
}

// Returns the filter of view k along an axis. A subaperture of one to three pixels weights pixels
// by their overlap with the subaperture. A narrower subaperture uses linear interpolation between
// pixels with different coverage, and a steeper transition between pixels with equal coverage.
Offset OffsetOf(const Lens& lens, int k, int disparity) {
  const int shift = (k < 0 ? -1 : 1) * (k == 0 ? 0 : lens.Shift(std::abs(k), disparity));
  const double moved = shift / 256.0;
  const double width = std::max(1, std::abs(lens.Shift(1, disparity))) / 256.0;
  if (width > 1 && width <= kWidestBox) {
    const double left = moved - width / 2 + 0.5, right = moved + width / 2 + 0.5;
    Offset box = {int(std::floor(left)), {}, 0};
    for (int x = box.first; x < right; ++x) {
      box.parts.push_back((std::min(right, x + 1.0) - std::max(left, double(x))) / width);
    }
    if (box.parts.size() == 2) box.inside = box.parts[1];
    return box;
  }
  const double whole = std::floor(moved), edge = moved - whole;
  const double scale = width < 1 ? InnerScale(lens, disparity, width) : 1;
  const double inside = width >= 1 ? edge : NearerShare(moved * scale - whole, width * scale);
  return {int(whole), {1 - edge, edge}, inside};
}

// Moves a plane of pixels along x by the shift of one column of views, and returns the columns of
// the rectangle.
Plane MovedAlongX(const Plane& from, const Offset& offset, int width) {
  Plane to(0, from.top, width, from.height);
  to.ForEach(
      [&](int x, int y) { to.At(x, y) = offset.See([&](int k) { return from.At(x + k, y); }); });
  return to;
}

// --- Compositing of slices to views ---

// Returns the factor by which a slice is scaled if its coverage exceeds the light that is left. The
// factor approximates light / covered by the first terms of a series in 1 - covered.
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

  // Returns the weighted sum of all views.
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

  // Returns the sum of the weights of all added views.
  double total() const { return total_; }

 private:
  void AddView(const std::vector<Plane>& column, int j, double weight) {
    total_ += weight;
    std::vector<Offset> offsets;
    for (const Range& range : ranges_) offsets.push_back(OffsetOf(lens_, j, range.Disparity()));
    ForEachPixel(rect_.width, rect_.height, [&](int x, int y) {
      double light = 1;
      for (size_t k = 0; k < column.size() && light > 0; ++k) {
        const auto at = [&](int row) { return column[k].At(x, y + row); };
        Take(offsets[k].See(at), weight, &light, &sum_.At(x, y));
      }
    });
  }

  // Adds a slice, and subtracts the coverage of the slice from the light that is left. A slice
  // whose coverage exceeds the light that is left takes all of this light.
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
  double total_ = 0;
};

// Returns the tile that starts at (x, y) of a rectangle. The sides of a tile are 64 pixels, or the
// rest of the rectangle if at most 80 pixels are left. The border of the tile includes the part of
// the rectangle outside the tile.
Rectangle TileAt(const Rectangle& rectangle, int x, int y) {
  const auto side = [](int rest) { return rest <= 80 ? rest : 64; };
  Rectangle tile = rectangle;
  tile.x += x;
  tile.y += y;
  tile.width = side(rectangle.width - x);
  tile.height = side(rectangle.height - y);
  tile.left += x;
  tile.top += y;
  tile.right += rectangle.width - x - tile.width;
  tile.bottom += rectangle.height - y - tile.height;
  return tile;
}

// Composites a tile at (left, top) of the picture from the tile's own slices.
void CompositeBucket(const SurfaceMap& map, const Picture& extended, const Lens& lens,
                     const Rectangle& tile, const Slicing& slicing, int left, int top,
                     Picture* picture) {
  const std::vector<Range> ranges = RangeFinder(map, lens, tile, slicing).Find();
  Stack stack(map, ranges, lens, tile);
  const Plane& sum = stack.AddViews();
  ForEachPixel(tile.width, tile.height, [&](int x, int y) {
    // If the slices take less than a quarter of the light of all views, the pixel of the centre
    // view is used.
    const Light& light = sum.At(x, y);
    Colour& colour = picture->colours[picture->At(left + x, top + y)];
    colour = extended.colours[extended.At(x + tile.left, y + tile.top)];
    if (4 * light[3] < stack.total()) return;
    for (size_t c = 0; c < 3; ++c) colour[c] = std::min(255.0, light[c] / light[3]);
  });
}

}  // namespace

Picture CompositeRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                           const Rectangle& rectangle, const Slicing& slicing) {
  const Picture extended = ExtendedRectangle(field, centre, lens.layer, rectangle);
  SurfaceMap map = FindLayeredDepth(field, extended, lens, rectangle.x - rectangle.left,
                                    rectangle.y - rectangle.top);
  // Surfaces inside the range in focus belong to one slice.
  Lens closed = lens;
  closed.near = lens.far;
  for (auto& surfaces : map.pixels) {
    for (Surface& surface : surfaces) surface.disparity = lens.Closed(surface.disparity);
  }
  Picture picture(rectangle.width, rectangle.height);
  Rectangle tile = {};
  for (int y = 0; y < picture.height; y += tile.height) {
    for (int x = 0; x < picture.width; x += tile.width) {
      tile = TileAt(rectangle, x, y);
      CompositeBucket(map, extended, closed, tile, slicing, x, y, &picture);
    }
  }
  return picture;
}

}  // namespace reference
