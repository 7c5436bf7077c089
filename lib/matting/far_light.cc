// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/far_light.h"

namespace starfocus {
namespace {

// Weighted sums of the light and the disparities of several cells that show one surface.
struct FarSum {
  int64_t rgb[3] = {0, 0, 0}, disparity = 0;
  int32_t weight = 0;

  void Add(const FarCell& cell, int32_t part) {
    for (int c = 0; c < 3; ++c) rgb[c] += int64_t{part} * cell.rgb[c];
    disparity += int64_t{part} * cell.disparity;
    weight += part;
  }
  static int16_t Mean(int64_t sum, int32_t weight) {
    return static_cast<int16_t>((sum + (sum < 0 ? -(weight / 2) : weight / 2)) / weight);
  }
  FarCell Mean(int32_t known) const {
    if (weight == 0) return {};
    return {{Mean(rgb[0], weight), Mean(rgb[1], weight), Mean(rgb[2], weight)},
            static_cast<int16_t>(known),
            Mean(disparity, weight)};
  }
};

using FourCells = const FarCell* [4];

// Returns the disparity of the farthest cell with a nonzero weight; INT16_MAX if all weights are 0.
int32_t FarthestOf(const FourCells& cells) {
  int32_t farthest = INT16_MAX;
  for (const FarCell* cell : cells) {
    if (cell->weight > 0) farthest = Min(farthest, cell->disparity);
  }
  return farthest;
}

// Returns the weighted sum of the cells whose disparity differs from `disparity` by at most
// kThinStep. Each cell is weighted by its element of `parts` and by its confidence.
FarSum SumOf(const FourCells& cells, const int32_t (&parts)[4], int32_t disparity) {
  FarSum sum;
  for (int k = 0; k < 4; ++k) {
    if (cells[k]->weight == 0 || Abs(cells[k]->disparity - disparity) > kThinStep) continue;
    sum.Add(*cells[k], parts[k] * cells[k]->weight);
  }
  return sum;
}

FarCell Pull(const FourCells& children) {
  const FarSum sum = SumOf(children, {1, 1, 1, 1}, FarthestOf(children));
  return sum.Mean(Min(sum.weight, kKnown));
}

// Fills in the unknown part of a cell's light with the mean light of cells in `above`. Only cells
// that show the surface at `disparity` are included.
void PushCell(const FourCells& above, int32_t disparity, FarCell* cell) {
  if (cell->weight >= kKnown) return;
  const FarSum sum = SumOf(above, {9, 3, 3, 1}, disparity);
  if (sum.weight == 0) return;
  const FarCell mean = sum.Mean(kKnown);
  for (int c = 0; c < 3; ++c) {
    const int32_t more = (cell->rgb[c] - mean.rgb[c]) * cell->weight;
    cell->rgb[c] = static_cast<int16_t>(mean.rgb[c] + RoundShift(more, kFarKnownBits));
  }
  if (cell->weight == 0) cell->disparity = mean.disparity;
  cell->weight = kKnown;
}

// Cells of one level of a tile, surrounded by a border one cell wide.
struct LevelCells {
  static constexpr int32_t kMost = kCoverageTile + 2;
  FarCell cells[kMost * kMost];
  int32_t side = 0;

  FarCell& At(int32_t x, int32_t y) { return cells[(y + 1) * kMost + x + 1]; }
};

FarCell LoadCell(const CoverageMap& map, int level, int32_t x, int32_t y) {
  const int bits = 4 - level;
  const int32_t columns = map.columns << bits, rows = map.Rows() << bits;
  if (x < 0 || y < 0 || x >= columns || y >= rows) return {};
  if (!map.IsStarted(x >> bits, y >> bits)) return {};
  return map.far[level][map.CellAt(x, y, level)];
}

// Finds the four cells of the level above that are nearest to cell (x, y), ordered from the nearest
// to the farthest.
template <class Cells>
void Above(Cells* cells, int32_t x, int32_t y, FourCells* above) {
  const int32_t column = x >> 1, row = y >> 1;
  const int32_t beside = column + ((x & 1) != 0 ? 1 : -1), next = row + ((y & 1) != 0 ? 1 : -1);
  (*above)[0] = &cells->At(column, row);
  (*above)[1] = &cells->At(beside, row);
  (*above)[2] = &cells->At(column, next);
  (*above)[3] = &cells->At(beside, next);
}

}  // namespace

void PullTile(int32_t column, int32_t row, const CoverageMap& map) {
  for (int level = 1; level < kFarLevels; ++level) {
    const int32_t side = kCoverageTile >> level;
    for (int32_t y = row * side; y < (row + 1) * side; ++y) {
      for (int32_t x = column * side; x < (column + 1) * side; ++x) {
        const FarCell* const below = map.far[level - 1];
        const FourCells children = {below + map.CellAt(2 * x, 2 * y, level - 1),
                                    below + map.CellAt(2 * x + 1, 2 * y, level - 1),
                                    below + map.CellAt(2 * x, 2 * y + 1, level - 1),
                                    below + map.CellAt(2 * x + 1, 2 * y + 1, level - 1)};
        map.far[level][map.CellAt(x, y, level)] = Pull(children);
      }
    }
  }
}

void PushTile(int32_t column, int32_t row, const CoverageMap& map, FarTile* far) {
  LevelCells levels[2];
  for (int level = kFarLevels - 1; level > 0; --level) {
    LevelCells& cells = levels[level & 1];
    const int32_t side = kCoverageTile >> level;
    for (int32_t y = -1; y <= side; ++y) {
      for (int32_t x = -1; x <= side; ++x) {
        FarCell& cell = cells.At(x, y) = LoadCell(map, level, column * side + x, row * side + y);
        if (level == kFarLevels - 1) continue;
        FourCells above;
        Above(&levels[(level + 1) & 1], x, y, &above);
        PushCell(above, cell.weight > 0 ? cell.disparity : FarthestOf(above), &cell);
      }
    }
  }
  for (int32_t y = 0; y < kCoverageTile; ++y) {
    for (int32_t x = 0; x < kCoverageTile; ++x) {
      FarCell& cell = far->cells[y * kCoverageTile + x] =
          map.FarAt(column * kCoverageTile + x, row * kCoverageTile + y);
      const int16_t disparity = cell.disparity;
      FourCells above;
      Above(&levels[1], x, y, &above);
      PushCell(above, disparity, &cell);
      cell.disparity = disparity;
    }
  }
}

}  // namespace starfocus
