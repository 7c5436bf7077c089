#include "tests/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>

namespace reference {
namespace {

using Colour = std::array<double, 3>;

// Two neighbours belong to one surface when their disparities (1/64) differ by at most this.
constexpr int kSurfaceStep = 96;
// A wider gap is no stretched surface, in pixels.
constexpr int kWidestStretch = 4;

// Floor of value / 2^bits, plus a half: rounding half up.
int64_t Rounded(int64_t value, int bits) {
  const int64_t unit = int64_t{1} << bits, sum = value + unit / 2;
  return sum >= 0 ? sum / unit : -((-sum + unit - 1) / unit);
}

int RoundedTo64(double value) { return static_cast<int>(std::floor(value * 64 + 0.5)); }

// A view, rendered or captured, with its disparity (1/64) where it has one.
struct Picture {
  int width = 0, height = 0;
  std::vector<Colour> colours;
  std::vector<int> disparities;

  Picture(int w, int h)
      : width(w), height(h), colours(size_t(w) * size_t(h)), disparities(size_t(w) * size_t(h)) {}

  size_t At(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
  bool Inside(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
};

// The captured views by position in halves of a unit.
using LightField = std::map<std::pair<int, int>, Picture>;

LightField Load(const test::Scene& scene) {
  LightField field;
  for (int view = 0; view < scene.views(); ++view) {
    double u = 0, v = 0;
    sf_view_position(view, &u, &v);
    Picture picture(scene.width, scene.height);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const uint8_t* rgb = scene.Pixel(view, x, y);
        picture.colours[picture.At(x, y)] = {double(rgb[0]), double(rgb[1]), double(rgb[2])};
        picture.disparities[picture.At(x, y)] = RoundedTo64(scene.Disparity(x, y));
      }
    }
    field.emplace(std::make_pair(int(2 * u), int(2 * v)), std::move(picture));
  }
  return field;
}

// Interpolated linearly; beyond the picture its edge goes on.
Colour Read(const LightField& field, int u2, int v2, double x, double y) {
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

// The lens: N views along its radius, and how far pixels move in them.
struct Lens {
  int n = 0;
  double radius = 0;  // u_t
  double theta = 0;
  int focus = 0;     // d_t, 1/64
  int64_t step = 0;  // u_t, 2^-24
  int border = 0;    // pixels from which a block can be reached

  // u of view k, 2^-24.
  int64_t Move(int k) const { return (2 * k * step + n) / (2 * n); }
  // Pixels that a disparity (1/64) moves by in view k, 1/256.
  int Shift(int k, int disparity) const {
    return int(Rounded(Move(k) * (disparity - focus), 24 + 6 - 8));
  }
  // Width of the aperture cell on the picture, r / N, at most a pixel.
  double Cell(int disparity) const {
    return std::min(1.0, radius / n * std::abs(disparity - focus) / 64.0);
  }
  // Within a run, disparities (1/64) range over a quarter pixel of displacement at the aperture's
  // rim, and never across the edge of a surface.
  int Spread() const { return int(std::min<int64_t>(kSurfaceStep, (int64_t{16} << 24) / step)); }
  // Views at most half a unit from the centre have a captured view at that distance.
  bool Half(int k) const { return 2 * k * radius <= n; }
  bool Contains(int i, int j) const { return i * i + j * j <= n * n; }
  double Density(int i, int j) const {
    return n == 0 ? 1 : ApertureDensity(double(i) / n, double(j) / n, theta);
  }
};

Lens MakeLens(const test::Scene& scene, const sf_params& params, double theta) {
  Lens lens;
  const double r_max = params.aperture * std::max(std::fabs(scene.disparity_min - params.focus),
                                                  std::fabs(scene.disparity_max - params.focus));
  lens.n = ViewsAlongRadius(r_max, params.mode);
  lens.radius = params.aperture;
  lens.theta = theta;
  lens.focus = RoundedTo64(params.focus);
  lens.step = std::max<int64_t>(1, int64_t(params.aperture * (1 << 24)));
  lens.border = int(std::ceil(r_max)) + 2;
  return lens;
}

// --- One line: the pixels that a view of direction +1 along it shows. ---

// Where a rendered pixel comes from: line pixel `source`, blended with its neighbour; or, in a
// hole, the visible surface of line pixel `source` goes on behind what hides it.
struct Owner {
  bool hole = true;
  int source = 0;
  int neighbour = 0;
  double neighbour_weight = 0;
};

struct LineRun {
  int begin, end;
  int disparity;  // the middle of its range
};

// From the end of the line that near surfaces move away from; a run is as long as its disparities
// allow.
std::vector<LineRun> Runs(const std::vector<int>& disparity, int spread) {
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
    visible_ = length - 1;
    for (const LineRun& run : runs) {
      const int whole = Whole(run);
      if (run.begin - whole >= filled_) continue;  // hidden
      if (run.end - whole < filled_) CloseGap(run, whole);
      for (int p = run.begin - whole; p < filled_; ++p) SetSurface(p, run, whole);
      filled_ = run.begin - whole;
      visible_ = run.begin;
    }
    SetHole(0, visible_);
    return owners_;
  }

 private:
  int Whole(const LineRun& run) const { return int(Rounded(lens_.Shift(k_, run.disparity), 8)); }
  bool Inside(int p) const { return p >= 0 && p < int(owners_.size()); }
  int Disparity(int q) const { return disparity_[size_t(q)]; }

  // The pixels between the run's end and what is filled: the run's surface, stretched, unless that
  // ends there or is the nearer one: then what is behind the nearer of the two goes on.
  void CloseGap(const LineRun& run, int whole) {
    const int q = run.end - 1;
    const int gap = filled_ - (run.end - whole);
    const bool nearer = Disparity(q) - Disparity(visible_) > kSurfaceStep;
    const bool inside = filled_ + whole <= int(disparity_.size());
    if (!nearer && gap <= kWidestStretch && inside) return;
    SetHole(run.end - whole, Disparity(q) < Disparity(visible_) ? q : visible_);
  }

  // Rendered pixels from `begin` to what is filled.
  void SetHole(int begin, int source) {
    for (int p = begin; p < filled_; ++p) {
      if (Inside(p)) owners_[size_t(p)] = {true, source, source, 0};
    }
    filled_ = std::min(filled_, begin);
  }

  // The source lies t away from the rendered pixel's centre; its cell of width L gives the
  // neighbour on that side clamp((|t| - 1/2) / L + 1/2, 0, 1). None across the edge of a surface.
  void SetSurface(int p, const LineRun& run, int whole) {
    if (!Inside(p)) return;
    Owner owner = {false, p + whole, p + whole, 0};
    const double t = lens_.Shift(k_, run.disparity) / 256.0 - whole;
    const double cell = lens_.Cell(run.disparity);
    const int neighbour = owner.source + (t > 0 ? 1 : -1);
    if (cell > 0 && Inside(neighbour) &&
        std::abs(Disparity(owner.source) - Disparity(neighbour)) <= kSurfaceStep) {
      owner.neighbour = neighbour;
      owner.neighbour_weight = std::clamp((std::fabs(t) - 0.5) / cell + 0.5, 0.0, 1.0);
    }
    owners_[size_t(p)] = owner;
  }

  const std::vector<int>& disparity_;
  const Lens& lens_;
  int k_;
  std::vector<Owner> owners_;
  int filled_ = 0;   // lowest rendered pixel shown so far
  int visible_ = 0;  // the line pixel it shows
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
        const size_t source = line[size_t(owner.source)];
        to.disparities[line[p]] = from.disparities[source];
        Colour& colour = to.colours[line[p]];
        if (owner.hole) {
          colour = hole(x0 + int(p) * u, y0 + int(p) * v, from.disparities[source],
                        from.colours[source]);
          continue;
        }
        const Colour &a = from.colours[source], &b = from.colours[line[size_t(owner.neighbour)]];
        for (size_t c = 0; c < 3; ++c) colour[c] = a[c] + owner.neighbour_weight * (b[c] - a[c]);
      }
    }
  }
  return to;
}

// --- A block: its extended rectangle, and all views rendered from it. ---

double Difference(const Colour& a, const Colour& b) {
  return std::fabs(a[0] - b[0]) + std::fabs(a[1] - b[1]) + std::fabs(a[2] - b[2]);
}

class Block {
 public:
  // The extended rectangle starts at (x, y) of the picture; beyond the picture its edge goes on.
  Block(const LightField& field, const Lens& lens, int x, int y, int width, int height)
      : field_(field), lens_(lens), x_(x), y_(y), centre_(width, height) {
    const Picture& picture = field.at({0, 0});
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const size_t from = picture.At(std::clamp(x + column, 0, picture.width - 1),
                                       std::clamp(y + row, 0, picture.height - 1));
        centre_.colours[centre_.At(column, row)] = picture.colours[from];
        centre_.disparities[centre_.At(column, row)] = picture.disparities[from];
      }
    }
  }

  const Picture& View(int i, int j) {
    if (i == 0 && j == 0) return centre_;
    if (i == 0 || j == 0 || std::abs(i) == std::abs(j)) return FromCentre(i, j);
    return FromTypeA(i, j);
  }

 private:
  static int Sign(int value) { return (value > 0) - (value < 0); }

  // Types A (one of i, j is 0) and B (both are equally large).
  const Picture& FromCentre(int i, int j) {
    const auto known = views_.find({i, j});
    if (known != views_.end()) return known->second;
    const int u = Sign(i), v = Sign(j), k = std::max(std::abs(i), std::abs(j));
    const auto hole = [&](int x, int y, int disparity, const Colour& colour) {
      return FromCaptured(i, j, x + x_, y + y_, disparity, colour);
    };
    return views_.emplace(std::make_pair(i, j), RenderAlong(centre_, u, v, lens_, k, hole))
        .first->second;
  }

  // Type C: type A scanned across.
  const Picture& FromTypeA(int i, int j) {
    const bool wide = std::abs(i) > std::abs(j);
    const int far = std::max(std::abs(i), std::abs(j)), k = std::min(std::abs(i), std::abs(j));
    const Picture& type_a = wide ? FromCentre(i, 0) : FromCentre(0, j);
    const int u = wide ? 0 : Sign(i), v = wide ? Sign(j) : 0;
    // Only the rows (columns) that the last view of this type A view can reach from: runs of one
    // shift start there.
    int last = far - 1;
    while (last > 0 && !lens_.Contains(far, last)) --last;
    const int reach = std::min(lens_.border, (lens_.border * last + lens_.n - 1) / lens_.n + 1);
    const int cut = lens_.border - reach;
    Picture part(type_a.width - 2 * std::abs(u) * cut, type_a.height - 2 * std::abs(v) * cut);
    const int left = std::abs(u) * cut, top = std::abs(v) * cut;
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) {
        part.colours[part.At(x, y)] = type_a.colours[type_a.At(x + left, y + top)];
        part.disparities[part.At(x, y)] = type_a.disparities[type_a.At(x + left, y + top)];
      }
    }
    const Picture rendered =
        RenderAlong(part, u, v, lens_, k, [&](int x, int y, int disparity, const Colour& behind) {
          return FromCaptured(i, j, x + left + x_, y + top + y_, disparity, behind);
        });
    type_c_ = type_a;
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) {
        type_c_.colours[type_c_.At(x + left, y + top)] = rendered.colours[rendered.At(x, y)];
      }
    }
    return type_c_;
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
      return Sign(view) * (shift - (captured ? disparity * 4 * distance / 2 : 0)) / 256.0;
    };
    const double x_far = x + moved(i, true), y_far = y + moved(j, true);
    if (u == 0 || v == 0 || field_.size() != 5) {
      return Read(field_, u * distance, v * distance, x_far, y_far);
    }
    // The diagonal view was not captured: the side views, by agreement with the background.
    const Colour a = Read(field_, 2 * u, 0, x_far, y + moved(j, false));
    const Colour b = Read(field_, 0, 2 * v, x + moved(i, false), y_far);
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
  int x_, y_;
  Picture centre_;
  std::map<std::pair<int, int>, Picture> views_;  // types A and B
  Picture type_c_{0, 0};                          // the last one asked for
};

}  // namespace

double ApertureDensity(double u, double v, double theta) {
  const double cot2 = 1 / (std::tan(theta) * std::tan(theta));
  const double denominator = u * u + v * v + cot2;
  return cot2 * cot2 / (denominator * denominator);
}

int ViewsAlongRadius(double r_max, int mode) {
  if (mode == SF_MODE_BENCHMARK) return 2 * int(std::ceil(r_max));
  if (r_max < 4) return int(std::ceil(r_max));
  return std::max(4, int(std::ceil(0.787 * r_max)));
}

Result Refocus(const test::Scene& scene, const sf_params& params, double theta, int block) {
  const LightField field = Load(scene);
  const Lens lens = MakeLens(scene, params, theta);
  Result result;
  result.n = lens.n;
  result.rgb.assign(3 * size_t(scene.width) * size_t(scene.height), 0);
  double total = 0;
  for (int j = -lens.n; j <= lens.n; ++j) {
    for (int i = -lens.n; i <= lens.n; ++i) {
      if (!lens.Contains(i, j)) continue;
      total += lens.Density(i, j);
      ++result.views;
    }
  }
  const int extended = block + 2 * lens.border;
  for (int y0 = 0; y0 < scene.height; y0 += block) {
    for (int x0 = 0; x0 < scene.width; x0 += block) {
      const int width = std::min(block, scene.width - x0);
      const int height = std::min(block, scene.height - y0);
      Block rectangle(field, lens, x0 - lens.border, y0 - lens.border, extended - block + width,
                      extended - block + height);
      for (int j = -lens.n; j <= lens.n; ++j) {
        for (int i = -lens.n; i <= lens.n; ++i) {
          if (!lens.Contains(i, j)) continue;
          const double weight = lens.Density(i, j) / total;
          const Picture& view = rectangle.View(i, j);
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
              const Colour& colour = view.colours[view.At(x + lens.border, y + lens.border)];
              double* out =
                  &result.rgb[3 * (size_t(y0 + y) * size_t(scene.width) + size_t(x0 + x))];
              for (size_t c = 0; c < 3; ++c) out[c] += weight * colour[c];
            }
          }
        }
      }
    }
  }
  return result;
}

}  // namespace reference
