// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/hair_cells.h"

#include <algorithm>
#include <initializer_list>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// Returns cell (x, y) of a level. For coordinates outside the level, returns the nearest cell of
// the level.
const ColourMean& Inside(const ColourLevel& level, int32_t x, int32_t y) {
  return level.At(Clamp(x, 0, level.columns - 1), Clamp(y, 0, level.rows - 1));
}

void PullLevel(const ColourLevel& from, const ColourLevel& to) {
  for (int32_t y = 0; y < to.rows; ++y) {
    for (int32_t x = 0; x < to.columns; ++x) {
      ColourSum sum;
      for (int32_t row = 2 * y; row < Min(2 * y + 2, from.rows); ++row) {
        for (int32_t column = 2 * x; column < Min(2 * x + 2, from.columns); ++column) {
          const ColourMean& mean = from.At(column, row);
          sum.Add(mean.rgb, mean.weight);
        }
      }
      to.At(x, y) = sum.Mean();
    }
  }
}

// Fills in the unknown part of a cell's colour by bilinear interpolation of the level above.
void PushCell(const ColourLevel& above, int32_t x, int32_t y, ColourMean* cell) {
  const int32_t column = x >> 1, row = y >> 1;
  const int32_t beside = column + ((x & 1) != 0 ? 1 : -1), next = row + ((y & 1) != 0 ? 1 : -1);
  const ColourMean &a = above.At(column, row), &b = Inside(above, beside, row);
  const ColourMean &c = Inside(above, column, next), &d = Inside(above, beside, next);
  const int32_t known = cell->weight;
  for (int k = 0; k < 3; ++k) {
    const int32_t around = (9 * a.rgb[k] + 3 * b.rgb[k] + 3 * c.rgb[k] + d.rgb[k] + 8) >> 4;
    const int32_t mixed = known * cell->rgb[k] + (kFullyKnown - known) * around;
    cell->rgb[k] = static_cast<uint16_t>((mixed + kFullyKnown / 2) >> kKnownBits);
  }
}

// Bilinear weights of the previous cell, the pixel's own cell and the next cell, for each position
// of a pixel in its cell; in eighths.
constexpr int32_t kEighths[kHairCell][3] = {{3, 5, 0}, {1, 7, 0}, {0, 7, 1}, {0, 5, 3}};

// An edge is a difference of disparity of more than kEdgeStep between two surfaces
// (kDisparityBits).
constexpr int32_t kEdgeStep = 5 << kDisparityBits;
// Radii in cells. A cell with kIsFar has no near pixels within kBeside. A cell with kIsInside has
// far pixels within kMostInside but not within kBeside.
constexpr int32_t kBeside = 1, kMostInside = 4;
// A cell has hair if more than a fifth of the near pixels within 12 cells look like background.
constexpr int32_t kHairReach = 12, kHairShare = 5;

// Number of columns that JoinColumns combines at a time.
constexpr int32_t kJoinedColumns = 16;

// Replaces each value of a row with the combination, by the function `join`, of all values at most
// `reach` positions away. The compiler vectorises the inner loop.
template <class T, class Join>
void JoinRow(int32_t count, int32_t reach, const Join& join, T* values, int32_t* line) {
  for (int32_t k = 0; k < count; ++k) line[k] = values[k];
  for (int32_t shift = -reach; shift <= reach; ++shift) {
    if (shift == 0) continue;
    const int32_t end = Min(count, count - shift);
    for (int32_t k = Max(0, -shift); k < end; ++k) {
      values[k] = static_cast<T>(join(values[k], line[k + shift]));
    }
  }
}

// Replaces each value of `width` columns with the combination of all values of its column at most
// `reach` rows away. `width` is at most kJoinedColumns.
template <class T, class Join>
void JoinColumns(const HairCells& cells, int32_t width, int32_t reach, const Join& join,
                 T* values) {
  for (int32_t y = 0; y < cells.rows; ++y) {
    int32_t* line = cells.line + ptrdiff_t{y} * kJoinedColumns;
    for (int32_t x = 0; x < kJoinedColumns; ++x) line[x] = x < width ? values[cells.At(x, y)] : 0;
  }
  for (int32_t y = 0; y < cells.rows; ++y) {
    const int32_t first = Max(y - reach, 0), last = Min(y + reach, cells.rows - 1);
    int32_t joined[kJoinedColumns];
    std::copy_n(cells.line + ptrdiff_t{first} * kJoinedColumns, kJoinedColumns, joined);
    for (int32_t from = first + 1; from <= last; ++from) {
      const int32_t* line = cells.line + ptrdiff_t{from} * kJoinedColumns;
      for (int32_t x = 0; x < kJoinedColumns; ++x) joined[x] = join(joined[x], line[x]);
    }
    for (int32_t x = 0; x < width; ++x) values[cells.At(x, y)] = static_cast<T>(joined[x]);
  }
}

// Replaces the value of each cell with the reduction by `join` over a square of cells with radius
// `reach`.
template <class T, class Join>
void JoinAround(const HairCells& cells, int32_t reach, const Join& join, T* values) {
  for (int32_t y = 0; y < cells.rows; ++y) {
    JoinRow(cells.columns, reach, join, values + cells.At(0, y), cells.line);
  }
  for (int32_t x = 0; x < cells.columns; x += kJoinedColumns) {
    JoinColumns(cells, Min(kJoinedColumns, cells.columns - x), reach, join, values + x);
  }
}

bool HasNear(const HairCells& cells, size_t at) { return cells.IsNear(at, cells.nearest[at]); }
bool HasFar(const HairCells& cells, size_t at) {
  return (cells.marks[at] & HairCells::kHasEdge) != 0 && !cells.IsNear(at, cells.farthest[at]);
}

// Returns true if the predicate `is` holds for any cell within `reach` of cell (column, row).
template <class Is>
bool AnyWithin(const HairCells& cells, int32_t column, int32_t row, int32_t reach, const Is& is) {
  const int32_t right = Min(column + reach, cells.columns - 1);
  const int32_t bottom = Min(row + reach, cells.rows - 1);
  for (int32_t y = Max(row - reach, 0); y <= bottom; ++y) {
    for (int32_t x = Max(column - reach, 0); x <= right; ++x) {
      if (is(cells, cells.At(x, y))) return true;
    }
  }
  return false;
}

uint8_t MarkOf(const HairCells& cells, int32_t x, int32_t y) {
  if (!AnyWithin(cells, x, y, kBeside, HasNear)) return HairCells::kIsFar;
  if (!HasNear(cells, cells.At(x, y)) || AnyWithin(cells, x, y, kBeside, HasFar)) return 0;
  return AnyWithin(cells, x, y, kMostInside, HasFar) ? HairCells::kIsInside : uint8_t{0};
}

}  // namespace

ColourMean ColourSum::Mean() const {
  ColourMean mean = {};
  if (weight_ == 0) return mean;
  for (int c = 0; c < 3; ++c) {
    mean.rgb[c] = static_cast<uint16_t>((sums_[c] + weight_ / 2) / weight_);
  }
  mean.weight = static_cast<uint16_t>(Min(static_cast<int32_t>(weight_), kFullyKnown));
  return mean;
}

ColourPyramid TakeColourPyramid(int32_t width, int32_t height, Arena* arena) {
  ColourPyramid pyramid = {};
  int32_t columns = (width + kHairCell - 1) / kHairCell;
  int32_t rows = (height + kHairCell - 1) / kHairCell;
  for (bool is_last = false; !is_last; ++pyramid.count) {
    auto* means = arena->Take<ColourMean>(static_cast<size_t>(columns), static_cast<size_t>(rows));
    pyramid.levels[pyramid.count] = {columns, rows, means};
    is_last = columns == 1 && rows == 1;
    columns = (columns + 1) / 2;
    rows = (rows + 1) / 2;
  }
  return pyramid;
}

bool CarryOnColours(const ColourPyramid& pyramid) {
  const int32_t last = pyramid.count - 1;
  for (int32_t k = 0; k < last; ++k) PullLevel(pyramid.levels[k], pyramid.levels[k + 1]);
  for (int32_t k = last - 1; k >= 0; --k) {
    const ColourLevel& level = pyramid.levels[k];
    for (int32_t y = 0; y < level.rows; ++y) {
      for (int32_t x = 0; x < level.columns; ++x) {
        PushCell(pyramid.levels[k + 1], x, y, &level.At(x, y));
      }
    }
  }
  return pyramid.levels[last].At(0, 0).weight != 0;
}

void InterpolateCell(const ColourPyramid& pyramid, int32_t column, int32_t row,
                     CellColours* colours) {
  const ColourLevel& level = pyramid.levels[0];
  const ColourMean* around[3][3];
  for (int32_t y = 0; y < 3; ++y) {
    for (int32_t x = 0; x < 3; ++x) around[y][x] = &Inside(level, column + x - 1, row + y - 1);
  }
  for (int32_t y = 0; y < kHairCell; ++y) {
    for (int c = 0; c < 3; ++c) {
      int32_t across[3];  // weighted sums, in units of 1/8
      for (int32_t x = 0; x < 3; ++x) {
        across[x] = 0;
        for (int k = 0; k < 3; ++k) across[x] += kEighths[y][k] * around[k][x]->rgb[c];
      }
      for (int32_t x = 0; x < kHairCell; ++x) {
        int32_t sum = 32;
        for (int k = 0; k < 3; ++k) sum += kEighths[x][k] * across[k];
        colours->rgb[y][x][c] = sum >> 6;
      }
    }
  }
}

HairCells TakeHairCells(int32_t width, int32_t height, Arena* arena) {
  HairCells cells = {};
  cells.columns = (width + kHairCell - 1) / kHairCell;
  cells.rows = (height + kHairCell - 1) / kHairCell;
  const auto columns = static_cast<size_t>(cells.columns), rows = static_cast<size_t>(cells.rows);
  for (int16_t** plane : {&cells.low, &cells.high, &cells.farthest, &cells.nearest}) {
    *plane = arena->Take<int16_t>(columns, rows);
  }
  cells.marks = arena->Take<uint8_t>(columns, rows);
  const size_t block = rows * kJoinedColumns;
  cells.line = arena->Take<int32_t>(columns > block ? columns : block);
  return cells;
}

void MeasureHairCell(const ColourMap& map, int32_t column, int32_t row, const HairCells& cells) {
  const Rect cell = HairCellAt(map.setup, column, row);
  int16_t low = INT16_MAX, high = INT16_MIN;
  for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
    const int16_t* disparities = map.disparity + map.setup.At(cell.x, y);
    for (int32_t x = 0; x < cell.width; ++x) {
      low = std::min(low, disparities[x]);
      high = std::max(high, disparities[x]);
    }
  }
  const size_t at = cells.At(column, row);
  cells.low[at] = cells.farthest[at] = low;
  cells.high[at] = cells.nearest[at] = high;
}

bool MarkEdges(const HairCells& cells) {
  JoinAround(cells, kSurfaceReach, Min, cells.low);
  JoinAround(cells, kSurfaceReach, Max, cells.high);
  const size_t count = static_cast<size_t>(cells.columns) * static_cast<size_t>(cells.rows);
  bool any = false;
  for (size_t at = 0; at < count; ++at) {
    const bool edge = cells.high[at] - cells.low[at] > kEdgeStep;
    cells.marks[at] = edge ? HairCells::kHasEdge : uint8_t{0};
    any = any || edge;
  }
  if (!any) return false;
  for (int32_t y = 0; y < cells.rows; ++y) {
    for (int32_t x = 0; x < cells.columns; ++x) {
      uint8_t& mark = cells.marks[cells.At(x, y)];
      if (mark != 0) mark = static_cast<uint8_t>(mark | MarkOf(cells, x, y));
    }
  }
  return true;
}

bool MarkHair(const HairCells& cells, int32_t* near, int32_t* far) {
  const auto add = [](int32_t a, int32_t b) { return a + b; };
  JoinAround(cells, kHairReach, add, near);
  JoinAround(cells, kHairReach, add, far);
  const size_t count = static_cast<size_t>(cells.columns) * static_cast<size_t>(cells.rows);
  bool any = false;
  for (size_t at = 0; at < count; ++at) {
    uint8_t& marks = cells.marks[at];
    if (marks == 0 || kHairShare * far[at] <= 256 * near[at]) continue;
    marks = static_cast<uint8_t>(marks | HairCells::kHasHair);
    any = true;
  }
  return any;
}

bool HasHair(const HairCells& cells, const Rect& rect) {
  const int32_t right = (rect.x + rect.width - 1) / kHairCell;
  const int32_t bottom = (rect.y + rect.height - 1) / kHairCell;
  for (int32_t y = rect.y / kHairCell; y <= bottom; ++y) {
    for (int32_t x = rect.x / kHairCell; x <= right; ++x) {
      if ((cells.marks[cells.At(x, y)] & HairCells::kHasHair) != 0) return true;
    }
  }
  return false;
}

}  // namespace starfocus
