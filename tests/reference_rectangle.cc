#include "tests/reference_rectangle.h"

namespace reference {
namespace {

// Interpolated linearly; beyond the picture its edge goes on.
Colour ReadPicture(const LightField& field, int u2, int v2, double x, double y) {
  const Picture& picture = field.at({u2, v2});
  const int left = int(std::floor(x)), top = int(std::floor(y));
  Colour colour = {0, 0, 0};
  for (int row = top; row <= top + 1; ++row) {
    for (int column = left; column <= left + 1; ++column) {
      const double weight = (1 - std::fabs(x - column)) * (1 - std::fabs(y - row));
      const Colour& pixel = picture.colours[picture.At(std::clamp(column, 0, picture.width - 1),
                                                       std::clamp(row, 0, picture.height - 1))];
      for (size_t c = 0; c < 3; ++c) colour[c] += weight * pixel[c];
    }
  }
  return colour;
}

// At a layer the picture's pixel nearest to (x, y), weighed with those around it by 1 2 1 or
// 1 2 3 4 3 2 1 along either axis.
Colour Read(const LightField& field, int layer, int u2, int v2, double x, double y) {
  if (layer == 0) return ReadPicture(field, u2, v2, x, y);
  const auto nearest = [&](double at) { return int(Rounded(std::lround(at * 256), 8 - layer)); };
  const int reach = (1 << layer) - 1, column = nearest(x), row = nearest(y);
  Colour colour = {0, 0, 0};
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double weight = double((1 << layer) - std::abs(dx)) * ((1 << layer) - std::abs(dy));
      const Colour pixel = ReadPicture(field, u2, v2, column + dx, row + dy);
      for (size_t c = 0; c < 3; ++c) colour[c] += weight / (1 << 4 * layer) * pixel[c];
    }
  }
  return colour;
}

double Difference(const Colour& a, const Colour& b) {
  return std::fabs(a[0] - b[0]) + std::fabs(a[1] - b[1]) + std::fabs(a[2] - b[2]);
}

// Where `mixed` lies from `far` to `near`; 0 when they are too similar, it is too far away from the
// line between them, or beyond 4/5 of the way.
double ShareOf(const Colour& near, const Colour& far, const Colour& mixed) {
  double along = 0, contrast = 0, distance = 0;
  for (size_t c = 0; c < 3; ++c) {
    along += (mixed[c] - far[c]) * (near[c] - far[c]);
    contrast += (near[c] - far[c]) * (near[c] - far[c]);
    distance += (mixed[c] - far[c]) * (mixed[c] - far[c]);
  }
  if (contrast < 64 || along <= 0 || 5 * along > 4 * contrast) return 0;
  const double beside = distance * contrast - along * along;
  return 16 * beside > contrast * (432 + contrast) ? 0 : along / contrast;
}

int Sign(int value) { return (value > 0) - (value < 0); }

// What is left of a picture's extended rectangle after cutting lines off.
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
        centre_(rect.left + rect.width + rect.right, rect.top + rect.height + rect.bottom) {
    for (int y = 0; y < centre_.height; ++y) {
      for (int x = 0; x < centre_.width; ++x) {
        const size_t from = layer.At(std::clamp(x_ + x, 0, layer.width - 1),
                                     std::clamp(y_ + y, 0, layer.height - 1));
        centre_.colours[centre_.At(x, y)] = layer.colours[from];
        centre_.disparities[centre_.At(x, y)] = layer.disparities[from];
      }
    }
    if (lens_.n > 0 && lens_.layer == 0 && field_.size() > 1) Unmix(layer);
    if (lens_.cells) centre_ = SpreadAlong(SpreadAlong(centre_, false, lens_), true, lens_);
  }

  // Adds view (i, j) of the whole rectangle to `sum`.
  void Add(int i, int j, double weight, Picture* sum) {
    if (lens_.n == 0) return AddInner(centre_, {0, 0, 0, 0}, weight, sum);
    if (lens_.cells) return AddAcross(true, i, j, weight, sum);
    if (i == 0 && j == 0) return AddInner(centre_, {0, 0, 0, 0}, weight, sum);
    if (std::abs(i) == std::abs(j)) return AddInner(Diagonal(i, j), {0, 0, 0, 0}, weight, sum);
    AddAcross(std::abs(i) > std::abs(j), i, j, weight, sum);
  }

 private:
  // The near part of sharp pixels beside a more defocused surface gives way to what the captured
  // view that looks behind that surface shows of theirs. The outermost pixels reach nothing.
  void Unmix(const Picture& picture) {
    const auto at = [&](int x, int y) {
      return picture.At(std::clamp(x_ + x, 0, picture.width - 1),
                        std::clamp(y_ + y, 0, picture.height - 1));
    };
    for (int y = 1; y + 1 < centre_.height; ++y) {
      for (int x = 1; x + 1 < centre_.width; ++x) {
        const Colour mixed = picture.colours[at(x, y)];
        Colour sum = {0, 0, 0};
        double shares = 0;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const int disparity = picture.disparities[at(x, y)];
          const int near = picture.disparities[at(x + dx, y + dy)];
          if (near - disparity <= kSurfaceStep) continue;
          const double strength = Strength(near, disparity);
          if (strength <= 0) continue;
          const double distance = field_.size() == 17 ? 0.5 : 1;
          Colour far = ReadPicture(field_, int(-dx * 2 * distance), int(-dy * 2 * distance),
                                   x + x_ + dx * distance * disparity / 64.0,
                                   y + y_ + dy * distance * disparity / 64.0);
          // Whole levels, as captured colours are; halves towards the pixel.
          for (size_t c = 0; c < 3; ++c) {
            far[c] = mixed[c] > far[c] ? std::floor(far[c] + 0.5) : std::ceil(far[c] - 0.5);
          }
          const int beyond = picture.disparities[at(x + 2 * dx, y + 2 * dy)];
          const int pure = std::abs(beyond - near) <= kSurfaceStep ? 2 : 1;
          const double share =
              ShareOf(picture.colours[at(x + pure * dx, y + pure * dy)], far, mixed);
          const double amount = std::min(1.0, 2 * share) * strength;
          for (size_t c = 0; c < 3; ++c) sum[c] += share * amount * (far[c] - mixed[c]);
          shares += share;
        }
        if (shares == 0) continue;
        for (size_t c = 0; c < 3; ++c) {
          centre_.colours[centre_.At(x, y)][c] = mixed[c] + sum[c] / shares;
        }
      }
    }
  }

  // From 0 to 1 as the near surface's blur exceeds the far one's by a pixel, and back to 0 as the
  // latter goes from 2 to 3.
  double Strength(int near, int far) const {
    const double r_near = std::abs(lens_.Shift(lens_.n, near)) / 256.0;
    const double r_far = std::abs(lens_.Shift(lens_.n, far)) / 256.0;
    return std::min({1.0, r_near - r_far, 3 - r_far});
  }

  Picture Diagonal(int i, int j) {
    return RenderAlong(centre_, Sign(i), Sign(j), lens_, std::abs(i),
                       [&](int x, int y, int disparity, const Colour& colour) {
                         return FromCaptured(i, j, x + x_, y + y_, disparity, colour);
                       });
  }

  // Type A: view `i` along rows (columns), once.
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

  // Type C: across the lines of a type A view, of which only those count that its outermost view
  // can reach from: runs of one shift start there.
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

  // What the captured view in the direction of view (i, j) sees of a surface that this view shows
  // at picture position (x, y).
  Colour FromCaptured(int i, int j, int x, int y, int disparity, const Colour& behind) const {
    if (field_.size() == 1) return behind;
    const int u = Sign(i), v = Sign(j);
    const bool half = field_.size() == 17 && lens_.Half(std::max(std::abs(i), std::abs(j)));
    const int distance = half ? 1 : 2;  // halves of a unit
    const auto moved = [&](int view, bool captured) {
      const int shift = view == 0 ? 0 : lens_.Shift(std::abs(view), disparity);
      const auto far = Rounded(int64_t{4} * disparity * distance, 1 + lens_.layer);
      return Sign(view) * (shift - (captured ? int(far) : 0)) / 256.0;
    };
    const double x_far = x + moved(i, true), y_far = y + moved(j, true);
    // Cells' views are all rendered along rows first: those nearer to the other axis see what is
    // behind as the view there does.
    if (lens_.cells && u != 0 && std::abs(i) < std::abs(j)) {
      return Read(field_, lens_.layer, 0, v * distance, x + moved(i, false), y_far);
    }
    if (u == 0 || v == 0 || field_.size() != 5) {
      return Read(field_, lens_.layer, u * distance, v * distance, x_far, y_far);
    }
    // The diagonal view was not captured: the side views, by agreement with the background.
    const Colour a = Read(field_, lens_.layer, 2 * u, 0, x_far, y + moved(j, false));
    const Colour b = Read(field_, lens_.layer, 0, 2 * v, x + moved(i, false), y_far);
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
  int x_, y_;  // of the extended rectangle in the layer
  Picture centre_;
  std::map<std::pair<bool, int>, Picture> along_;
};

}  // namespace

Picture RefocusRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                         const Rectangle& rectangle) {
  double total = 0;
  for (int j = -lens.n; j <= lens.n; ++j) {
    for (int i = -lens.n; i <= lens.n; ++i) {
      if (lens.Contains(i, j)) total += lens.Density(i, j);
    }
  }
  Views views(field, centre, lens, rectangle);
  Picture sum(rectangle.width, rectangle.height);
  for (int j = -lens.n; j <= lens.n; ++j) {
    for (int i = -lens.n; i <= lens.n; ++i) {
      if (lens.Contains(i, j)) views.Add(i, j, lens.Density(i, j) / total, &sum);
    }
  }
  return sum;
}

}  // namespace reference
