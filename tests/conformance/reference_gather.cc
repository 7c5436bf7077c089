// SPDX-License-Identifier: Apache-2.0
// Gathering in the reference: flat cells of one surface are blurred from the centre view by the
// ideal PSF (4). In cells on a slope, each pixel is blurred by the PSF of its own radius.
#include <algorithm>
#include <cmath>

#include "tests/conformance/reference.h"
#include "tests/conformance/reference_blur.h"

namespace reference {
namespace {

constexpr int kCell = 8;
constexpr double kLargestKernel = 12;  // Largest blur radius of a cell, in pixels of the layer.

struct Interval {
  double low, high;
};

// Returns the radius of a stored PSF in pixels: `round` is std::floor for the largest radius of at
// most `radius`, in 1/kOne pixels, and std::ceil for the smallest radius of at least `radius`.
double OnLadder(int radius, double (*round)(double)) {
  return round(radius / LadderUnit(radius)) * LadderUnit(radius) / kOne;
}

// Returns the mean square of one coordinate in the opening, weighted by light, relative to the
// radius of the lens.
double MeanSquare(const ApertureShape& opening) {
  if (opening.shape == STARFOCUS_SHAPE_RING) return (1 + opening.inner * opening.inner) / 4;
  if (opening.shape != STARFOCUS_SHAPE_FALL_OFF) return 1.0 / 4;
  const double c = opening.cot2, light = c / (1 + c);
  return c * c * (std::log((1 + c) / c) + light - 1) / light / 2;
}

class Gather {
 public:
  Gather(const LightField& field, const Picture& of_layer, const Block& block, const Lens& lens,
         double r_max, int frame_x, int frame_y, Picture* frame)
      : field_(field),
        picture_(field.at({0, 0})),
        of_layer_(of_layer),
        block_(block),
        lens_(lens),
        step_(std::llround(lens.radius * (1 << 24))),
        largest_(NearestRadius(int(std::min(r_max, kLargestKernel) * kOne) + 1)),
        frame_x_(frame_x),
        frame_y_(frame_y),
        frame_(*frame) {}

  void All() {
    for (const GatheredCell& cell : block_.gathered) cell.on_slope ? OnSlope(cell) : Flat(cell);
  }

 private:
  double Scale() const { return 1 << block_.layer; }

  // Computes the lowest and the highest closed disparity of a cell (Lens::Closed). Beyond the
  // picture, the outermost pixels and the outermost cells are repeated.
  void DisparitiesOf(int column, int row, int* low, int* high) const {
    column = std::clamp(column, 0, (picture_.width - 1) / kCell);
    row = std::clamp(row, 0, (picture_.height - 1) / kCell);
    *low = INT32_MAX;
    *high = INT32_MIN;
    ForEachPixel(kCell, kCell, [&](int x, int y) {
      const size_t at = picture_.At(std::min(kCell * column + x, picture_.width - 1),
                                    std::min(kCell * row + y, picture_.height - 1));
      const int disparity = lens_.Closed(picture_.disparities[at]);
      *low = std::min(*low, disparity);
      *high = std::max(*high, disparity);
    });
  }

  // Returns the signed radius at the upper left corner of a cell, in 1/1024 pixels of the picture.
  double Corner(int column, int row) const {
    int64_t distance = -8 * int64_t{lens_.far};
    for (int k = 0; k < 4; ++k) {
      int low, high;
      DisparitiesOf(column - 1 + (k & 1), row - 1 + (k >> 1), &low, &high);
      distance += low + high;
    }
    return std::floor(double(step_) * double(distance) / double(1 << 23));
  }

  struct Corners {
    double radii[4];
  };
  Corners CornersOf(const GatheredCell& cell) const {
    const int column = cell.x / kCell, row = cell.y / kCell;
    return {{Corner(column, row), Corner(column + 1, row), Corner(column, row + 1),
             Corner(column + 1, row + 1)}};
  }

  // Returns the signed radius of a pixel of the layer, in pixels of the layer.
  double RadiusAt(const GatheredCell& cell, const Corners& corners, int x, int y) const {
    const double across = ((x + 0.5) * Scale() - cell.x) / kCell;
    const double down = ((y + 0.5) * Scale() - cell.y) / kCell;
    const double* r = corners.radii;
    return ((r[0] * (1 - across) + r[1] * across) * (1 - down) +
            (r[2] * (1 - across) + r[3] * across) * down) /
           Scale() / 1024;
  }

  // Returns the range of the absolute blur radii of the cell's pixels, rounded to 1/1024 pixel as
  // in the engine.
  Interval IntervalOf(const GatheredCell& cell) const {
    const Corners corners = CornersOf(cell);
    double low = 1e9, high = -1e9;
    for (int k = 0; k < 4; ++k) {
      const double radius = RadiusAt(cell, corners, cell.at_x + (k & 1) * (cell.at_width - 1),
                                     cell.at_y + (k >> 1) * (cell.at_height - 1));
      const double rounded = std::floor(radius * 1024 + 0.5) / 1024;
      low = std::min(low, rounded);
      high = std::max(high, rounded);
    }
    const double nearest = low < 0 && high > 0 ? 0 : std::min(std::fabs(low), std::fabs(high));
    return {nearest, std::max(std::fabs(low), std::fabs(high))};
  }

  // Filters a part of the layer with a PSF. `extended` has `border` more pixels on each side.
  Picture Filtered(const Picture& extended, int border, int width, int height,
                   const Psf& kernel) const {
    Picture to(width, height);
    ForEachPixel(width, height, [&](int x, int y) {
      Colour& sum = to.colours[to.At(x, y)];
      ForEachAround(kernel.size, [&](int n, int m) {
        const size_t at = extended.At(x + n + border, y + m + border);
        for (size_t c = 0; c < 3; ++c) sum[c] += kernel.At(n, m) * extended.colours[at][c];
      });
    });
    return to;
  }

  // Returns the pixels of a cell and of a border of `border` pixels of the layer.
  Picture Around(const GatheredCell& cell, int border) const {
    const Rectangle rectangle = {cell.at_x, cell.at_y, cell.at_width, cell.at_height,
                                 border,    border,    border,        border};
    return ExtendedRectangle(field_, of_layer_, block_.layer, rectangle);
  }

  Colour& Out(int x, int y) { return frame_.colours[frame_.At(x - frame_x_, y - frame_y_)]; }

  void Flat(const GatheredCell& cell) {
    int low, high;
    DisparitiesOf(cell.x / kCell, cell.y / kCell, &low, &high);
    const int distance = std::abs((low + high) / 2 - lens_.far);
    const int radius = int(std::floor(lens_.radius * distance)) >> block_.layer;
    const double nearest = NearestRadius(radius);
    const Psf kernel = PsfOf(nearest, lens_.opening);
    const Picture filtered =
        Filtered(Around(cell, kernel.size), kernel.size, cell.at_width, cell.at_height, kernel);
    ForEachPixel(cell.at_width, cell.at_height, [&](int x, int y) {
      Out(cell.at_x + x, cell.at_y + y) = filtered.colours[filtered.At(x, y)];
    });
  }

  // Returns the position of radius^2 in the range from between.low^2 to between.high^2, as a number
  // from 0 to 1.
  static double ShareOf(double radius, const Interval& between) {
    const double range = between.high * between.high - between.low * between.low;
    if (range == 0) return 0;
    return std::clamp((radius * radius - between.low * between.low) / range, 0.0, 1.0);
  }

  // Mixes the results of two PSFs by the radius of each pixel, and moves the mixture along the
  // gradient of the radius.
  void OnSlope(const GatheredCell& cell) {
    const Interval range = IntervalOf(cell);
    const Interval between = {
        std::min(OnLadder(int(std::floor(range.low * kOne)), std::floor), largest_),
        std::min(OnLadder(int(std::ceil(range.high * kOne)), std::ceil), largest_)};
    const Psf less = PsfOf(between.low, lens_.opening);
    const Psf more = PsfOf(between.high, lens_.opening);
    const int border = more.size;
    const Picture extended = Around(cell, border);
    Picture mixed = Filtered(extended, border, cell.at_width, cell.at_height, less);
    const Picture wider = Filtered(extended, border, cell.at_width, cell.at_height, more);
    const Corners corners = CornersOf(cell);
    ForEachPixel(cell.at_width, cell.at_height, [&](int x, int y) {
      const double share = ShareOf(RadiusAt(cell, corners, cell.at_x + x, cell.at_y + y), between);
      const size_t at = mixed.At(x, y);
      mixed.colours[at] = mixed.colours[at] + share * (wider.colours[at] - mixed.colours[at]);
    });
    Move(cell, corners, mixed);
  }

  // Returns the colour difference between the two neighbours of a pixel in the direction (dx, dy).
  // At the rim of the cell, returns twice the difference between the pixel and the inner neighbour.
  static double Difference(const Picture& of, int x, int y, int dx, int dy, size_t c) {
    const auto at = [&](int side) {
      const int px = x + side * dx, py = y + side * dy;
      return of.Inside(px, py) ? of.colours[of.At(px, py)][c] : NAN;
    };
    const double here = of.colours[of.At(x, y)][c], before = at(-1), after = at(1);
    if (std::isnan(before) && std::isnan(after)) return 0;
    if (std::isnan(before)) return 2 * (after - here);
    if (std::isnan(after)) return 2 * (here - before);
    return after - before;
  }

  void Move(const GatheredCell& cell, const Corners& corners, const Picture& mixed) {
    const double* r = corners.radii;
    const double radius = (r[0] + r[1] + r[2] + r[3]) / 4 / 1024 / Scale();
    const double unit = MeanSquare(lens_.opening) * radius / 1024 / (2 * kCell) / 2;
    const double across = unit * (r[1] + r[3] - r[0] - r[2]);
    const double down = unit * (r[2] + r[3] - r[0] - r[1]);
    ForEachPixel(cell.at_width, cell.at_height, [&](int x, int y) {
      for (size_t c = 0; c < 3; ++c) {
        const double value = mixed.colours[mixed.At(x, y)][c] +
                             across * Difference(mixed, x, y, 1, 0, c) +
                             down * Difference(mixed, x, y, 0, 1, c);
        Out(cell.at_x + x, cell.at_y + y)[c] = std::clamp(value, 0.0, 255.0);
      }
    });
  }

  const LightField& field_;
  const Picture& picture_;
  const Picture& of_layer_;
  const Block& block_;
  const Lens& lens_;
  const int64_t step_;
  const double largest_;  // Largest radius for which there is a PSF.
  const int frame_x_, frame_y_;
  Picture& frame_;
};

}  // namespace

void GatherCells(const LightField& field, const Picture& of_layer, const Block& block,
                 const Lens& lens, double r_max, int frame_x, int frame_y, Picture* frame) {
  Gather(field, of_layer, block, lens, r_max, frame_x, frame_y, frame).All();
}

}  // namespace reference
