// SPDX-License-Identifier: Apache-2.0

#include "examples/scene/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "examples/scene/noise.h"
#include "platform/deep_image.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
// A point of the lens, or a rotation by the angle of that point.
struct LensPoint {
  double x, y;
};

namespace {

constexpr int kTile = 16;
constexpr int kFineGrid = 8;       // Samples along each side of a pixel near strands.
constexpr int kCoverageGrid = 16;  // Samples along each side of a pixel of the coverage.
// cos and sin of the golden angle and of 1/256 of a turn. Multiplying a direction by these
// constants generates sequences of directions without library functions.
constexpr double kGoldenCos = -0.7373688780783197, kGoldenSin = 0.6754902942615238;
constexpr double kStepCos = 0.9996988186962042, kStepSin = 0.024541228522912288;
// Steps of the R2 low-discrepancy sequence.
constexpr double kR2X = 0.7548776662466927, kR2Y = 0.5698402909980532;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

LensPoint Turn(LensPoint p, LensPoint by) {
  return {p.x * by.x - p.y * by.y, p.x * by.y + p.y * by.x};
}

// Returns points on the unit disc in a sunflower pattern. About `samples` of the points pass the
// opening. The radii follow the inverse of the distribution of the squared radius s. With the
// fall-off (3), the density of s is proportional to 1 / (s + cot^2(theta))^2.
std::vector<LensPoint> LensPoints(const SceneOpening& opening, int samples) {
  std::vector<LensPoint> points;
  LensPoint direction = {1, 0};
  const double fall_off = opening.fall_off();
  const int count = static_cast<int>(samples / opening.LeastShare());
  for (int k = 0; k < count; ++k) {
    const double share = (k + 0.5) / count;
    double square = share;
    if (fall_off > 0) {
      const double at0 = 1 / fall_off, at1 = 1 / (1 + fall_off);
      square = 1 / (at0 - share * (at0 - at1)) - fall_off;
    }
    const double radius = std::sqrt(square);
    points.push_back({direction.x * radius, direction.y * radius});
    direction = Turn(direction, {kGoldenCos, kGoldenSin});
  }
  return points;
}

std::vector<LensPoint> Turns() {
  std::vector<LensPoint> turns = {{1, 0}};
  while (turns.size() < 256) turns.push_back(Turn(turns.back(), {kStepCos, kStepSin}));
  return turns;
}

uint8_t ToByte(double value) { return static_cast<uint8_t>(Clamp01(value / 255) * 255 + 0.5); }

// Returns sample k of a sheared grid of grid * grid samples over a pixel. All samples have
// different coordinates along each axis, within half a pixel of 0.
Point BoxSample(int k, int grid) {
  const double i = k % grid, j = k / grid, n = grid;
  return {(i + (j + 0.5) / n) / n - 0.5, (j + (n - i - 0.5) / n) / n - 0.5};
}

// Computes the smallest and the largest product of a value in [a, b] and a value in [c, d].
void ProductRange(double a, double b, double c, double d, double* low, double* high) {
  *low = std::min({a * c, a * d, b * c, b * d});
  *high = std::max({a * c, a * d, b * c, b * d});
}

// Returns the bounds of a surface relative to the picture positions of the camera's centre view.
Bounds SeenBounds(Bounds box, const Camera& camera) {
  double low, high;
  ProductRange(box.d0, box.d1, camera.u, camera.u, &low, &high);
  box.x0 -= camera.x + high;
  box.x1 -= camera.x + low;
  ProductRange(box.d0, box.d1, camera.v, camera.v, &low, &high);
  box.y0 -= camera.y + high;
  box.y1 -= camera.y + low;
  return box;
}

}  // namespace

struct RayTracer::Lens {
  double u = 0, v = 0;                   // Centre of the lens.
  double aperture = 0;                   // Radius of the lens; 0 for a pinhole.
  SceneFocus focus = {0, 0};             // In canvas units.
  std::vector<LensPoint> points, turns;  // Empty for a pinhole.
  const SceneOpening* opening = nullptr;

  // Returns the distance of a disparity from the range in focus, negative behind the range.
  double Distance(double d) const { return d - std::clamp(d, focus.far, focus.near); }
};

RayTracer::RayTracer(const Scene& scene, int width, int height, starfocus_transfer transfer,
                     ThreadRunner* runner)
    : scene_(scene),
      width_(width),
      height_(height),
      scale_(std::min(width / kCanvasWidth, height / kCanvasHeight)),
      curve_(transfer),
      runner_(runner) {
  const double reach = std::max(width, height) / scale_;
  for (const Surface& surface : scene.surfaces) {
    bounds_.push_back(SeenBounds(SurfaceBounds(surface, reach), scene.camera));
  }
}

void RayTracer::ToPixel(double x, double y, int* pixel_x, int* pixel_y) const {
  const Camera& camera = scene_.camera;
  std::optional<double> nearest;
  Hit hit;
  for (const Surface& surface : scene_.surfaces) {
    if (Intersect(surface, {x, y, 0, 0}, &hit)) nearest = std::max(hit.d, nearest.value_or(hit.d));
  }
  const double d = nearest.value_or(0);
  const double px = (x - camera.x - camera.u * d) * scale_ + 0.5 * (width_ - 1);
  const double py = (y - camera.y - camera.v * d) * scale_ + 0.5 * (height_ - 1);
  *pixel_x = std::clamp(static_cast<int>(std::floor(px + 0.5)), 0, width_ - 1);
  *pixel_y = std::clamp(static_cast<int>(std::floor(py + 0.5)), 0, height_ - 1);
}

std::vector<size_t> RayTracer::Candidates(const Lens& lens, int x0, int y0) const {
  const double left = (x0 - 0.5 * width_) / scale_, top = (y0 - 0.5 * height_) / scale_;
  const double side = kTile / scale_;
  std::vector<size_t> found;
  for (size_t i = 0; i < bounds_.size(); ++i) {
    const Bounds& box = bounds_[i];
    const double near = lens.Distance(box.d1), far = lens.Distance(box.d0);
    double low_x, high_x, low_y, high_y;
    ProductRange(far, near, lens.u - lens.aperture, lens.u + lens.aperture, &low_x, &high_x);
    ProductRange(far, near, lens.v - lens.aperture, lens.v + lens.aperture, &low_y, &high_y);
    if (left + low_x <= box.x1 && left + side + high_x >= box.x0 && top + low_y <= box.y1 &&
        top + side + high_y >= box.y0) {
      found.push_back(i);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [this](size_t p, size_t q) { return bounds_[p].d1 > bounds_[q].d1; });
  return found;
}

const Surface* RayTracer::Trace(const std::vector<size_t>& candidates, const Ray& ray, double most,
                                Hit* hit) const {
  const Camera& camera = scene_.camera;
  const Ray seen = {ray.ox + camera.x, ray.oy + camera.y, ray.u + camera.u, ray.v + camera.v};
  const Surface* found = nullptr;
  hit->d = -kInfinity;
  for (size_t i : candidates) {
    if (bounds_[i].d1 <= hit->d) break;
    Hit other;
    if (Intersect(scene_.surfaces[i], seen, &other) && other.d > hit->d && other.d <= most) {
      *hit = other;
      found = &scene_.surfaces[i];
    }
  }
  return found;
}

template <class Kind>
bool RayTracer::Any(const std::vector<size_t>& candidates, const Kind& kind) const {
  return std::any_of(candidates.begin(), candidates.end(),
                     [&](size_t i) { return kind(scene_.surfaces[i]); });
}

Ray RayTracer::CentreRay(double x, double y) const {
  return {(x - 0.5 * (width_ - 1)) / scale_, (y - 0.5 * (height_ - 1)) / scale_, 0, 0};
}

const Surface* RayTracer::TraceLens(const Lens& lens, const std::vector<size_t>& candidates,
                                    Point p, Point q, Hit* hit) const {
  const auto [far, near] = lens.focus;
  const auto through = [&](double focus) {
    return Ray{p.x - q.x * focus, p.y - q.y * focus, q.x, q.y};
  };
  const Surface* found = Trace(candidates, through(near), kInfinity, hit);
  if (far == near || (found != nullptr && hit->d >= near)) return found;
  found = Trace(candidates, {p.x, p.y, 0, 0}, near, hit);
  if (found != nullptr && hit->d >= far) return found;
  return Trace(candidates, through(far), far, hit);
}

Color RayTracer::RayColor(const Lens& lens, const std::vector<size_t>& candidates, double x,
                          double y, double u, double v) const {
  const double canvas_x = (x - 0.5 * (width_ - 1)) / scale_;
  const double canvas_y = (y - 0.5 * (height_ - 1)) / scale_;
  Hit hit;
  const Surface* surface = TraceLens(lens, candidates, {canvas_x, canvas_y}, {u, v}, &hit);
  return surface == nullptr ? Color() : curve_.Decode(surface->paint(*surface, hit));
}

Color RayTracer::ViewPixel(const Lens& lens, const std::vector<size_t>& candidates, int x, int y,
                           int grid) const {
  Color sum;
  for (int k = 0; k < grid * grid; ++k) {
    const Point offset = BoxSample(k, grid);
    sum = sum + RayColor(lens, candidates, x + offset.x, y + offset.y, lens.u, lens.v);
  }
  return sum * (1.0 / (grid * grid));
}

Color RayTracer::LensPixel(const Lens& lens, const std::vector<size_t>& candidates, int x,
                           int y) const {
  const LensPoint turn = lens.turns[Hash(x, y, 1) % lens.turns.size()];
  double dx = HashUnit(x, y, 2), dy = HashUnit(x, y, 3);
  const double half = 0.5 * std::sqrt(double(width_) * width_ + double(height_) * height_);
  const double from_x = (x - 0.5 * (width_ - 1)) / half, from_y = (y - 0.5 * (height_ - 1)) / half;
  int count = 0;
  Color sum;
  for (const LensPoint& point : lens.points) {
    const LensPoint q = Turn(point, turn);
    if (!lens.opening->Passes(q.x, q.y, from_x, from_y)) continue;
    ++count;
    sum = sum + RayColor(lens, candidates, x + dx - 0.5, y + dy - 0.5, q.x * lens.aperture,
                         q.y * lens.aperture);
    dx += kR2X;
    dy += kR2Y;
    if (dx >= 1) dx -= 1;
    if (dy >= 1) dy -= 1;
  }
  return sum * (1.0 / count);
}

void RayTracer::RenderTile(const Lens& lens, int x0, int y0, SceneLight* picture) const {
  const std::vector<size_t> candidates = Candidates(lens, x0, y0);
  const auto is_fine = [](const Surface& surface) { return surface.strands != nullptr; };
  const int grid = Any(candidates, is_fine) ? kFineGrid : scene_.view_grid;
  for (int y = y0; y < std::min(y0 + kTile, height_); ++y) {
    for (int x = x0; x < std::min(x0 + kTile, width_); ++x) {
      picture->pixels[size_t(y) * size_t(width_) + size_t(x)] =
          lens.aperture > 0 ? LensPixel(lens, candidates, x, y)
                            : ViewPixel(lens, candidates, x, y, grid);
    }
  }
}

template <class Body>
void RayTracer::ForBands(Progress* progress, int steps, const Body& body) const {
  struct Band {
    const Body* body;
    Progress* progress;
    int height, steps;
  } band = {&body, progress, height_, steps};
  const auto job = [](void* data, int32_t index, int32_t) {
    const Band& self = *static_cast<const Band*>(data);
    (*self.body)(index * kTile);
    if (self.progress != nullptr) {
      self.progress->Step(self.steps * std::min(kTile, self.height - index * kTile));
    }
  };
  ThreadRunner::Run(runner_, job, &band, (height_ + kTile - 1) / kTile);
}

template <class Body>
void RayTracer::ForCentrePixels(Progress* progress, int steps, const Body& body) const {
  ForBands(progress, steps, [&](int y0) {
    for (int x0 = 0; x0 < width_; x0 += kTile) {
      const std::vector<size_t> candidates = Candidates(Lens(), x0, y0);
      for (int y = y0; y < std::min(y0 + kTile, height_); ++y) {
        for (int x = x0; x < std::min(x0 + kTile, width_); ++x) body(candidates, x, y);
      }
    }
  });
}

SceneLight RayTracer::Render(const Lens& lens, Progress* progress) const {
  SceneLight picture = {width_, height_, std::vector<Color>(size_t(width_) * size_t(height_))};
  ForBands(progress, lens.aperture > 0 ? kTruthCost : 1, [&](int y) {
    for (int x = 0; x < width_; x += kTile) RenderTile(lens, x, y, &picture);
  });
  return picture;
}

Image RayTracer::Encoded(const SceneLight& picture) const {
  Image image(picture.width, picture.height);
  uint8_t* to = image.pixels.data();
  for (const Color& light : picture.pixels) {
    const Color color = curve_.Encode(light);
    for (const double code : {color.r, color.g, color.b}) *to++ = ToByte(code);
  }
  return image;
}

DeepImage RayTracer::Halves(const SceneLight& picture) const {
  DeepImage image(picture.width, picture.height, 3);
  image.is_half = true;
  image.transfer = STARFOCUS_TRANSFER_NONE;
  uint16_t* to = image.samples.data();
  for (const Color& light : picture.pixels) {
    for (const double value : {light.r, light.g, light.b}) {
      *to++ = HalfOfFloat(static_cast<float>(value / 255));
    }
  }
  return image;
}

SceneLight RayTracer::ViewLight(double u, double v, Progress* progress) const {
  Lens lens;
  lens.u = u;
  lens.v = v;
  return Render(lens, progress);
}

SceneLight RayTracer::TruthLight(const SceneFocus& focus, double aperture,
                                 const SceneOpening& opening, int samples,
                                 Progress* progress) const {
  Lens lens;
  lens.focus = {focus.far / scale_, focus.near / scale_};
  lens.aperture = aperture;
  lens.opening = &opening;
  lens.points = LensPoints(opening, samples);
  lens.turns = Turns();
  return Render(lens, progress);
}

FloatMap RayTracer::Disparity() const {
  FloatMap map;
  map.width = width_;
  map.height = height_;
  map.values.resize(size_t(width_) * size_t(height_));
  ForCentrePixels(nullptr, 0, [&](const std::vector<size_t>& candidates, int x, int y) {
    Hit hit;
    Trace(candidates, CentreRay(x, y), kInfinity, &hit);
    map.values[size_t(y) * size_t(width_) + size_t(x)] = static_cast<float>(hit.d * scale_);
  });
  return map;
}

uint8_t RayTracer::CoverageOf(const std::vector<size_t>& candidates, int x, int y) const {
  constexpr int kSamples = kCoverageGrid * kCoverageGrid;
  int covered = 0;
  for (int k = 0; k < kSamples; ++k) {
    const Point offset = BoxSample(k, kCoverageGrid);
    Hit hit;
    const Surface* surface =
        Trace(candidates, CentreRay(x + offset.x, y + offset.y), kInfinity, &hit);
    if (surface != nullptr && surface->foreground) ++covered;
  }
  return static_cast<uint8_t>((255 * covered + kSamples / 2) / kSamples);
}

std::vector<uint8_t> RayTracer::Coverage(Progress* progress) const {
  std::vector<uint8_t> coverage(size_t(width_) * size_t(height_));
  const auto is_near = [](const Surface& surface) { return surface.foreground; };
  ForCentrePixels(progress, kCoverageCost,
                  [&](const std::vector<size_t>& candidates, int x, int y) {
                    if (!Any(candidates, is_near)) return;
                    coverage[size_t(y) * size_t(width_) + size_t(x)] = CoverageOf(candidates, x, y);
                  });
  return coverage;
}

namespace {

// Returns value^2.4. Uses only arithmetic that IEEE 754 defines exactly, because std::pow differs
// between libraries.
double Power(double value) {
  const double square = value * value;
  double root = std::max(1.0, square);
  for (int step = 0; step < 100; ++step) {
    const double fourth = root * root * root * root;
    root -= (fourth * root - square) / (5 * fourth);
  }
  return square * root;
}

}  // namespace

LightCurve::LightCurve(starfocus_transfer transfer) {
  if (transfer == STARFOCUS_TRANSFER_NONE) return;
  for (int k = 0; k <= kMostCode * kSteps; ++k) {
    const double value = k / (255.0 * kSteps);
    light_.push_back(255 * (value <= 0.04045 ? value / 12.92 : Power((value + 0.055) / 1.055)));
  }
}

double LightCurve::LightOf(double code) const {
  if (light_.empty()) return code;
  const double place = std::clamp(code, 0.0, kMostCode - 1.0) * kSteps;
  const auto step = static_cast<size_t>(place);
  return light_[step] + (light_[step + 1] - light_[step]) * (place - static_cast<double>(step));
}

double LightCurve::CodeOf(double light) const {
  if (light_.empty() || light <= 0) return light;
  const auto above = std::upper_bound(light_.begin(), light_.end() - 1, light);
  const auto step = static_cast<double>(above - light_.begin() - 1);
  return (step + (light - above[-1]) / (above[0] - above[-1])) / kSteps;
}

Color LightCurve::Decode(const Color& codes) const {
  return {LightOf(codes.r), LightOf(codes.g), LightOf(codes.b)};
}

Color LightCurve::Encode(const Color& light) const {
  return {CodeOf(light.r), CodeOf(light.g), CodeOf(light.b)};
}

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTheta = 0.26 * kPi;
constexpr double kCotSquared = 0.8818383898322281;  // cot^2 of kTheta, equal on all machines

double Square(double x) { return x * x; }

}  // namespace

SceneOpening::SceneOpening(const starfocus::Params& lens)
    : shape_(static_cast<starfocus_shape>(lens.shape)),
      inner_(lens.ring_inner),
      cats_eye_(lens.cats_eye),
      curvature_(lens.curvature),
      half_(kPi / lens.blades) {
  if (shape_ == STARFOCUS_SHAPE_FALL_OFF) {
    fall_off_ = lens.theta == kTheta ? kCotSquared : 1 / Square(std::tan(lens.theta));
  }
  for (int k = 0; k < lens.blades; ++k) {
    const double angle = lens.rotation * kPi / 180 + (2 * k + 1) * half_;
    edges_.push_back({std::sin(angle), -std::cos(angle)});
  }
}

double SceneOpening::LeastShare() const {
  // Two unit discs at distance s overlap in at least 1 - 2 s / pi of their area.
  const double both = 1 - 2 / kPi * cats_eye_;
  if (shape_ == STARFOCUS_SHAPE_RING) return both * (1 - inner_ * inner_);
  return shape_ == STARFOCUS_SHAPE_POLYGON ? both * std::sin(2 * half_) / (2 * half_) : both;
}

bool SceneOpening::Passes(double u, double v, double x, double y) const {
  if (cats_eye_ > 0 && Square(u + cats_eye_ * x) + Square(v + cats_eye_ * y) > 1) return false;
  if (shape_ == STARFOCUS_SHAPE_RING) return u * u + v * v >= inner_ * inner_;
  if (shape_ != STARFOCUS_SHAPE_POLYGON) return true;
  for (const Edge& edge : edges_) {
    if (curvature_ == 0) {
      if (u * edge.x + v * edge.y > std::cos(half_)) return false;
      continue;
    }
    // The edge is an arc of the circle with radius 1 / `curvature_` through the two corners of the
    // edge.
    const double radius = 1 / curvature_;
    const double centre = std::cos(half_) - std::sqrt(radius * radius - Square(std::sin(half_)));
    if (Square(u - centre * edge.x) + Square(v - centre * edge.y) > radius * radius) return false;
  }
  return true;
}

}  // namespace starfocus
