// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/reference_far.h"

#include <limits>

#include "tests/conformance/reference_edges.h"

namespace reference {
namespace {

constexpr int kLastLevel = 4;

// Returns the disparity of the farthest surface with known light in any of the cells, or infinity.
double Farthest(const std::vector<FarLight>& cells) {
  double farthest = std::numeric_limits<double>::infinity();
  for (const FarLight& cell : cells) {
    if (cell.known > 0) farthest = std::min(farthest, cell.disparity);
  }
  return farthest;
}

// Returns the weighted mean of the light of the cells that show the surface at `disparity`. The
// weight of a cell is the product of its element of `parts` and FarLight::known. FarLight::known of
// the result is the sum of the weights of all averaged cells.
FarLight MeanOf(const std::vector<FarLight>& cells, const std::vector<double>& parts,
                double disparity) {
  FarLight mean;
  for (size_t k = 0; k < cells.size(); ++k) {
    if (cells[k].known == 0 || std::fabs(cells[k].disparity - disparity) > kThinEdge) continue;
    const double weight = parts[k] * cells[k].known;
    for (size_t c = 0; c < 3; ++c) mean.light[c] += weight * cells[k].light[c];
    mean.disparity += weight * cells[k].disparity;
    mean.known += weight;
  }
  if (mean.known == 0) return mean;
  for (double& light : mean.light) light /= mean.known;
  mean.disparity /= mean.known;
  return mean;
}

}  // namespace

FarPyramid::FarPyramid(int columns, int rows) {
  for (int level = 0; level <= kLastLevel; ++level) {
    const int side = kTile >> level, width = (columns + 2) * side, height = (rows + 2) * side;
    levels_.push_back({side, width, height, std::vector<FarLight>(size_t(width) * size_t(height))});
  }
}

FarLight& FarPyramid::At(int level, int x, int y) {
  Level& plane = levels_[size_t(level)];
  return plane.cells[size_t(y + plane.margin) * size_t(plane.width) + size_t(x + plane.margin)];
}

FarLight FarPyramid::Get(const std::vector<Level>& levels, int level, int x, int y) const {
  const Level& plane = levels[size_t(level)];
  const int column = x + plane.margin, row = y + plane.margin;
  if (column < 0 || column >= plane.width || row < 0 || row >= plane.height) return {};
  return plane.cells[size_t(row) * size_t(plane.width) + size_t(column)];
}

// Returns the filled cells of the next coarser level that surround a cell. The first returned cell
// contains the given cell.
std::vector<FarLight> FarPyramid::Above(int level, int x, int y) const {
  const int column = int(std::floor(x / 2.0)), row = int(std::floor(y / 2.0));
  const int beside = x == 2 * column ? column - 1 : column + 1;
  const int next = y == 2 * row ? row - 1 : row + 1;
  return {Get(filled_, level + 1, column, row), Get(filled_, level + 1, beside, row),
          Get(filled_, level + 1, column, next), Get(filled_, level + 1, beside, next)};
}

FarLight FarPyramid::Pushed(int level, int x, int y, FarLight cell, double disparity) const {
  if (cell.known >= 1) return cell;
  const FarLight mean = MeanOf(Above(level, x, y), {9, 3, 3, 1}, disparity);
  if (mean.known == 0) return cell;
  for (size_t c = 0; c < 3; ++c) {
    cell.light[c] = mean.light[c] + (cell.light[c] - mean.light[c]) * cell.known;
  }
  if (cell.known == 0) cell.disparity = mean.disparity;
  cell.known = 1;
  return cell;
}

void FarPyramid::Fill() {
  for (int level = 1; level <= kLastLevel; ++level) {
    const Level& plane = levels_[size_t(level)];
    for (int y = -plane.margin; y < plane.height - plane.margin; ++y) {
      for (int x = -plane.margin; x < plane.width - plane.margin; ++x) {
        const std::vector<FarLight> below = {
            At(level - 1, 2 * x, 2 * y), At(level - 1, 2 * x + 1, 2 * y),
            At(level - 1, 2 * x, 2 * y + 1), At(level - 1, 2 * x + 1, 2 * y + 1)};
        FarLight& cell = At(level, x, y) = MeanOf(below, {1, 1, 1, 1}, Farthest(below));
        cell.known = std::min(cell.known, 1.0);
      }
    }
  }
  filled_ = levels_;
  for (int level = kLastLevel - 1; level > 0; --level) {
    Level& plane = filled_[size_t(level)];
    for (size_t n = 0; n < plane.cells.size(); ++n) {
      const int x = int(n) % plane.width - plane.margin, y = int(n) / plane.width - plane.margin;
      FarLight& cell = plane.cells[n];
      const double disparity = cell.known > 0 ? cell.disparity : Farthest(Above(level, x, y));
      cell = Pushed(level, x, y, cell, disparity);
    }
  }
}

FarLight FarPyramid::Filled(int x, int y) const {
  const FarLight cell = Get(levels_, 0, x, y);
  return Pushed(0, x, y, cell, cell.disparity);
}

}  // namespace reference
