// SPDX-License-Identifier: Apache-2.0
// Captured views of the reference, and views that line scans render as the paper does.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/conformance/reference.h"

namespace reference {
namespace {

// Returns the colour of a view at (x, y), with linear interpolation. Beyond the picture, the
// outermost pixels are repeated.
Colour ReadPicture(const LightField& field, const Position& view, double x, double y,
                   std::vector<Colour> Picture::*colours = &Picture::colours) {
  const Picture& picture = field.at(view);
  const int left = int(std::floor(x)), top = int(std::floor(y));
  Colour colour = {0, 0, 0};
  for (int row = top; row <= top + 1; ++row) {
    for (int column = left; column <= left + 1; ++column) {
      const double weight = (1 - std::fabs(x - column)) * (1 - std::fabs(y - row));
      const Colour& pixel = (picture.*colours)[picture.Nearest(column, row)];
      for (size_t c = 0; c < 3; ++c) colour[c] += weight * pixel[c];
    }
  }
  return colour;
}

// Returns by how many pixels, at most 1, the blur of the near surface exceeds the blur of the far
// surface. The result falls to 0 as the blur of the far surface grows from 2 to 3 pixels.
double Strength(const Lens& lens, int near, int far) {
  const double r_near = std::abs(lens.Shift(lens.n, near)) / 256.0;
  const double r_far = std::abs(lens.Shift(lens.n, far)) / 256.0;
  return std::min({1.0, r_near - r_far, 3 - r_far});
}

}  // namespace

// Returns the difference of two colours, rounded to 1/16 as the engine rounds differences that it
// compares.
static double Difference(double a, double b) {
  return std::copysign(std::floor(16 * std::fabs(a - b) + 0.5) / 16, a - b);
}

Division Divide(const Colour& near, const Colour& far, const Colour& mixed, double contrast_fade) {
  double along = 0, contrast = 0, distance = 0;
  for (size_t c = 0; c < 3; ++c) {
    const double whole = Difference(near[c], far[c]), part = Difference(mixed[c], far[c]);
    along += part * whole;
    contrast += whole * whole;
    distance += part * part;
  }
  if (contrast <= 64 || along <= 0) return {0, 0};
  const double share = along / contrast;
  const double outside = 16 * (distance - along * share) / (432 + contrast);
  const auto fade = [](double value) { return std::clamp(value, 0.0, 1.0); };
  const double trust = fade((contrast - 64) / contrast_fade) * fade(1.2 - 0.8 * outside) *
                       fade((19 - 20 * share) / 6);
  return {share * trust, fade(16 * share) * trust};
}

Mixed MixtureOf(const Division& division, const Colour& near, const Colour& far,
                const Colour& mixed) {
  Mixed result = {division.share, near, mixed};
  for (size_t c = 0; c < 3; ++c) result.far[c] += division.weight * (far[c] - mixed[c]);
  return result;
}

std::vector<Position> LooksOn(const LightField& field, const Direction& side) {
  const auto along = [&](const Position& at) { return at.first * side.x + at.second * side.y; };
  const auto across = [&](const Position& at) {
    return std::abs(at.first * side.y - at.second * side.x);
  };
  std::vector<Position> near, far;
  for (const auto& [at, picture] : field) {
    if (across(at) < along(at)) near.push_back(at);
    if (across(at) < 8 * along(at)) far.push_back(at);
  }
  std::vector<Position> occlusion_views = near.empty() ? far : near;
  std::stable_sort(occlusion_views.begin(), occlusion_views.end(),
                   [&](const Position& a, const Position& b) {
                     const int first = 2 * along(a) - across(a), second = 2 * along(b) - across(b);
                     return first != second ? first > second : across(a) < across(b);
                   });
  if (occlusion_views.size() > 2) occlusion_views.resize(2);
  return occlusion_views;
}

double Moved(int position, int disparity, int layer) {
  const auto moved = double(Rounded(int64_t{std::abs(position)} * disparity, 12 + layer)) / 256;
  return position < 0 ? -moved : moved;
}

Mixed MixtureAt(const LightField& field, int x, int y, const Direction& side, int step,
                double contrast_fade) {
  const Picture& picture = field.at({0, 0});
  const auto at = [&](int k) { return picture.Nearest(x + k * side.x, y + k * side.y); };
  const int disparity = picture.disparities[at(0)], near = picture.disparities[at(1)];
  const std::vector<Position> occlusion_views = LooksOn(field, {-side.x, -side.y});
  const int beyond = std::abs(picture.disparities[at(2)] - near) <= step ? 2 : 1;
  const auto far_of = [&](std::vector<Colour> Picture::*colours) {
    if (occlusion_views.empty()) {
      const bool same = std::abs(picture.disparities[at(-1)] - disparity) <= step;
      return (picture.*colours)[at(same ? -1 : 0)];
    }
    const Position& view = occlusion_views.back();
    Colour far = ReadPicture(field, view, x - Moved(view.first, disparity, 0),
                             y - Moved(view.second, disparity, 0), colours);
    for (double& value : far) value = std::floor(128 * value + 0.5) / 128;
    return far;
  };
  struct Colours {
    Colour near, far, mixed;
  };
  const auto read = [&](std::vector<Colour> Picture::*colours) {
    return Colours{(picture.*colours)[at(beyond)], far_of(colours), (picture.*colours)[at(0)]};
  };
  const Colours of = read(&Picture::colours);
  const Colours light = picture.light.empty() ? of : read(&Picture::light);
  return MixtureOf(Divide(light.near, light.far, light.mixed, contrast_fade), of.near, of.far,
                   of.mixed);
}

void Unmix(const LightField& field, const Lens& lens, const Rectangle& rect, Picture* centre) {
  if (lens.n == 0 || lens.layer != 0 || field.size() == 1) return;
  const Picture before = *centre;
  for (int y = 1; y + 1 < centre->height; ++y) {
    for (int x = 1; x + 1 < centre->width; ++x) {
      const Colour& mixed = before.colours[centre->At(x, y)];
      const int disparity = centre->disparities[centre->At(x, y)];
      if (!field.at({0, 0}).Inside(rect.x - rect.left + x, rect.y - rect.top + y)) continue;
      Colour sum = {0, 0, 0};
      double shares = 0;
      for (const Direction& side : kDirections) {
        const int near = centre->disparities[centre->At(x + side.x, y + side.y)];
        if (near - disparity <= kSurfaceStep) continue;
        const double strength = Strength(lens, near, disparity);
        if (strength <= 0) continue;
        const Mixed mixture =
            MixtureAt(field, rect.x - rect.left + x, rect.y - rect.top + y, side, kSurfaceStep, 64);
        const double weight = mixture.share * std::min(1.0, 2 * mixture.share) * strength;
        for (size_t c = 0; c < 3; ++c) sum[c] += weight * (mixture.far[c] - mixed[c]);
        shares += mixture.share;
      }
      if (shares == 0) continue;
      centre->colours[centre->At(x, y)] = mixed + 1 / shares * sum;
    }
  }
}

// At layer 0, reads the captured view with linear interpolation. At layers 1 and 2, filters the
// pixels around the picture's pixel nearest to (x, y). The weights are 1 2 1 or 1 2 3 4 3 2 1 along
// either axis.
Colour Read(const LightField& field, int layer, const Position& view, double x, double y) {
  if (layer == 0) return ReadPicture(field, view, x, y);
  const auto nearest = [&](double at) { return int(Rounded(std::lround(at * 256), 8 - layer)); };
  const int reach = (1 << layer) - 1, column = nearest(x), row = nearest(y);
  Colour colour = {0, 0, 0};
  ForEachAround(reach, [&](int dx, int dy) {
    const double weight = double((1 << layer) - std::abs(dx)) * ((1 << layer) - std::abs(dy));
    const Colour pixel = ReadPicture(field, view, column + dx, row + dy);
    for (size_t c = 0; c < 3; ++c) colour[c] += weight / (1 << 4 * layer) * pixel[c];
  });
  return colour;
}

Colour ReadMoved(const LightField& field, int layer, const Position& view, int x, int y,
                 int disparity) {
  return Read(field, layer, view, x - Moved(view.first, disparity, layer),
              y - Moved(view.second, disparity, layer));
}

namespace {

// Returns the number of pixels beyond the edge at (x, y) of the layer that a captured view shows.
// The view is `distance` / kViewUnit away from the centre view, on the axis of `out`. `disparity`
// is the disparity of the pixel at the edge. The count ends before the first pixel that a nearer
// surface covers.
int SeenBeyond(const Picture& picture, int layer, int x, int y, const Direction& out, int distance,
               int disparity) {
  const double unit = 64 << layer;
  int seen = int(std::abs(Moved(distance, disparity, layer)));
  if (disparity >= 0) return seen;
  for (int m = 0; m < 32 >> layer; ++m) {
    const int column = (x - m * out.x) * (1 << layer), row = (y - m * out.y) * (1 << layer);
    if (!picture.Inside(column, row)) break;
    const int difference = picture.disparities[picture.At(column, row)] - disparity;
    const double nearer = double(Rounded(int64_t{distance} * difference, 14)) / unit;
    if (nearer <= 0.5 || nearer <= m) continue;
    for (int k = 1; k <= seen; ++k) {
      if (std::fabs(nearer - m - k) < 0.75) seen = k - 1;
    }
  }
  return seen;
}

}  // namespace

Picture ExtendedRectangle(const LightField& field, const Picture& of_layer, int layer,
                          const Rectangle& rect) {
  const Picture& picture = field.at({0, 0});
  const int x0 = rect.x - rect.left, y0 = rect.y - rect.top;
  const int right = ((picture.width - 1) >> layer), bottom = ((picture.height - 1) >> layer);
  Picture extended(rect.left + rect.width + rect.right, rect.top + rect.height + rect.bottom);
  ForEachPixel(extended.width, extended.height, [&](int column, int row) {
    const int x = x0 + column, y = y0 + row;
    const Direction out = {(x > right) - (x < 0), (y > bottom) - (y < 0)};
    const size_t at = extended.At(column, row), from = of_layer.Nearest(x, y);
    extended.colours[at] = of_layer.colours[from];
    extended.disparities[at] = of_layer.disparities[from];
    // Captured views continue the picture neither inside nor beyond its corners.
    if ((out.x == 0) == (out.y == 0)) return;
    const int edge_x = std::clamp(x, 0, right), edge_y = std::clamp(y, 0, bottom);
    const int disparity =
        picture.disparities[picture.At(edge_x * (1 << layer), edge_y * (1 << layer))];
    const Direction side = {disparity < 0 ? -out.x : out.x, disparity < 0 ? -out.y : out.y};
    const std::vector<Position> occlusion_views = LooksOn(field, side);
    if (occlusion_views.empty()) return;
    const auto [u, v] = occlusion_views[0];
    const int seen =
        SeenBeyond(picture, layer, edge_x, edge_y, out, std::abs(out.x != 0 ? u : v), disparity);
    const int k = std::min(seen, std::abs(x - edge_x) + std::abs(y - edge_y));
    if (seen == 0) return;
    extended.colours[at] = ReadMoved(field, layer, occlusion_views[0], edge_x + out.x * k,
                                     edge_y + out.y * k, disparity);
  });
  return extended;
}

namespace {

double Difference(const Colour& a, const Colour& b) {
  return std::fabs(a[0] - b[0]) + std::fabs(a[1] - b[1]) + std::fabs(a[2] - b[2]);
}

int Sign(int value) { return (value > 0) - (value < 0); }

// Numbers of rows and columns to remove from the sides of a picture.
struct Cut {
  int left, right, top, bottom;
};

Picture Inside(const Picture& from, const Cut& cut) {
  Picture part(from.width - cut.left - cut.right, from.height - cut.top - cut.bottom);
  ForEachPixel(part.width, part.height, [&](int x, int y) {
    const size_t at = from.At(x + cut.left, y + cut.top);
    part.colours[part.At(x, y)] = from.colours[at];
    part.disparities[part.At(x, y)] = from.disparities[at];
  });
  return part;
}

class Views {
 public:
  Views(const LightField& field, const Picture& layer, const Lens& lens, const Rectangle& rect)
      : field_(field),
        lens_(lens),
        rect_(rect),
        x_(rect.x - rect.left),
        y_(rect.y - rect.top),
        centre_(ExtendedRectangle(field, layer, lens.layer, rect)) {
    Unmix(field, lens, rect, &centre_);
  }

  // Renders view (i, j) of the rectangle and adds the weighted view to `sum`.
  void Add(int i, int j, double weight, Picture* sum) {
    if (i == 0 && j == 0) return AddInner(centre_, {0, 0, 0, 0}, weight, sum);
    if (std::abs(i) == std::abs(j)) return AddInner(Diagonal(i, j), {0, 0, 0, 0}, weight, sum);
    AddAcross(std::abs(i) > std::abs(j), i, j, weight, sum);
  }

 private:
  Picture Diagonal(int i, int j) {
    return RenderAlong(centre_, Sign(i), Sign(j), lens_, std::abs(i),
                       [&](int x, int y, int disparity, const Colour& colour) {
                         return FromCaptured(i, j, x + x_, y + y_, disparity, colour);
                       });
  }

  // Returns view `i` of type A (Fig. 11), rendered along rows or columns; each view is rendered
  // once.
  const Picture& Along(bool rows, int i) {
    const auto known = along_.find({rows, i});
    if (known != along_.end()) return known->second;
    Picture view = centre_;
    if (i != 0) {
      const int u = rows ? Sign(i) : 0, v = rows ? 0 : Sign(i);
      view = RenderAlong(
          view, u, v, lens_, std::abs(i), [&](int x, int y, int disparity, const Colour& colour) {
            return FromCaptured(rows ? i : 0, rows ? 0 : i, x + x_, y + y_, disparity, colour);
          });
    }
    return along_.emplace(std::make_pair(rows, i), std::move(view)).first->second;
  }

  // Renders a view of type C (Fig. 11) across the lines of a view of type A. Lines that no view
  // moves into the rectangle are cut off first, since the first line determines where runs start.
  void AddAcross(bool rows, int i, int j, double weight, Picture* sum) {
    const int along = rows ? i : j, across = rows ? j : i;
    const int last = lens_.LastAcross(std::abs(along));
    const auto cut = [&](int border) {
      const int splat = last == 0 ? 0 : (border * last + lens_.n - 1) / lens_.n + 1;
      return border - std::min(border, splat);
    };
    const Cut cuts = rows ? Cut{0, 0, cut(rect_.top), cut(rect_.bottom)}
                          : Cut{cut(rect_.left), cut(rect_.right), 0, 0};
    Picture view = Inside(Along(rows, along), cuts);
    if (across != 0) {
      const int u = rows ? 0 : Sign(across), v = rows ? Sign(across) : 0;
      view = RenderAlong(view, u, v, lens_, std::abs(across),
                         [&](int x, int y, int disparity, const Colour& colour) {
                           return FromCaptured(i, j, x + cuts.left + x_, y + cuts.top + y_,
                                               disparity, colour);
                         });
    }
    AddInner(view, cuts, weight, sum);
  }

  void AddInner(const Picture& view, const Cut& cut, double weight, Picture* sum) const {
    ForEachPixel(rect_.width, rect_.height, [&](int x, int y) {
      const Colour& colour =
          view.colours[view.At(x + rect_.left - cut.left, y + rect_.top - cut.top)];
      Colour& to = sum->colours[sum->At(x, y)];
      for (size_t c = 0; c < 3; ++c) to[c] += weight * colour[c];
    });
  }

  // Returns the colour of a surface, read from the captured view in the direction of view (i, j).
  // The pixel (x, y) of the picture shows the surface in view (i, j).
  Colour FromCaptured(int i, int j, int x, int y, int disparity, const Colour& behind) const {
    if (field_.size() == 1) return behind;
    const int u = Sign(i), v = Sign(j);
    const bool half = field_.size() == 17 && lens_.Half(std::max(std::abs(i), std::abs(j)));
    const int distance = half ? 1 : 2;  // distance of the captured view, in halves of a unit of u
    const auto moved = [&](int view, bool captured) {
      const int shift = view == 0 ? 0 : lens_.Shift(std::abs(view), disparity);
      const auto far = Rounded(int64_t{4} * disparity * distance, 1 + lens_.layer);
      return Sign(view) * (shift - (captured ? int(far) : 0)) / 256.0;
    };
    const double x_far = x + moved(i, true), y_far = y + moved(j, true);
    if (u == 0 || v == 0 || field_.size() != 5) {
      return Read(field_, lens_.layer, {u * distance * kViewUnit / 2, v * distance * kViewUnit / 2},
                  x_far, y_far);
    }
    // The star of 5 views has no diagonal views, so two views on the axes are mixed. The weights
    // depend on how well each view agrees with `behind`.
    const Colour a = Read(field_, lens_.layer, {u * kViewUnit, 0}, x_far, y + moved(j, false));
    const Colour b = Read(field_, lens_.layer, {0, v * kViewUnit}, x + moved(i, false), y_far);
    const double weight_a = std::pow(Difference(b, behind), 2) + 1;
    const double weight_b = std::pow(Difference(a, behind), 2) + 1;
    return 1 / (weight_a + weight_b) * (weight_a * a + weight_b * b);
  }

  const LightField& field_;
  const Lens& lens_;
  const Rectangle& rect_;
  int x_, y_;  // position of the extended rectangle in the layer
  Picture centre_;
  std::map<std::pair<bool, int>, Picture> along_;
};

}  // namespace

Picture RefocusRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                         const Rectangle& rectangle) {
  double total = 0;
  std::vector<double> densities;
  lens.ForEachView([&](int i, int j) {
    densities.push_back(lens.Density(i, j));
    total += densities.back();
  });
  Views views(field, centre, lens, rectangle);
  Picture sum(rectangle.width, rectangle.height);
  auto density = densities.begin();
  lens.ForEachView([&](int i, int j) { views.Add(i, j, *density++ / total, &sum); });
  return sum;
}

}  // namespace reference
