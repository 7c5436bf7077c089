// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/reference_rectangle.h"

namespace reference {
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
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      const size_t at = from.At(x + cut.left, y + cut.top);
      part.colours[part.At(x, y)] = from.colours[at];
      part.disparities[part.At(x, y)] = from.disparities[at];
    }
  }
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
        centre_(ExtendedRectangle(layer, rect)) {
    ExtendEdges(field, field.at({0, 0}), lens.layer, rect, &centre_);
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
    for (int y = 0; y < rect_.height; ++y) {
      for (int x = 0; x < rect_.width; ++x) {
        const Colour& colour =
            view.colours[view.At(x + rect_.left - cut.left, y + rect_.top - cut.top)];
        Colour& to = sum->colours[sum->At(x, y)];
        for (size_t c = 0; c < 3; ++c) to[c] += weight * colour[c];
      }
    }
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
    Colour mixed;
    for (size_t c = 0; c < 3; ++c) {
      mixed[c] = (a[c] * weight_a + b[c] * weight_b) / (weight_a + weight_b);
    }
    return mixed;
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
  for (int j = -lens.n; j <= lens.n; ++j) {
    for (int i = -lens.n; i <= lens.n; ++i) {
      if (!lens.Contains(i, j)) continue;
      densities.push_back(lens.Density(i, j));
      total += densities.back();
    }
  }
  Views views(field, centre, lens, rectangle);
  Picture sum(rectangle.width, rectangle.height);
  auto density = densities.begin();
  for (int j = -lens.n; j <= lens.n; ++j) {
    for (int i = -lens.n; i <= lens.n; ++i) {
      if (lens.Contains(i, j)) views.Add(i, j, *density++ / total, &sum);
    }
  }
  return sum;
}

}  // namespace reference
