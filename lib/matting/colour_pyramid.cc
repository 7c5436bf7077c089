// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/colour_pyramid.h"

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
constexpr int32_t kEighths[kColourCell][3] = {{3, 5, 0}, {1, 7, 0}, {0, 7, 1}, {0, 5, 3}};

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
  int32_t columns = (width + kColourCell - 1) / kColourCell;
  int32_t rows = (height + kColourCell - 1) / kColourCell;
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
  for (int32_t y = 0; y < kColourCell; ++y) {
    for (int c = 0; c < 3; ++c) {
      int32_t across[3];  // weighted sums, in units of 1/8
      for (int32_t x = 0; x < 3; ++x) {
        across[x] = 0;
        for (int k = 0; k < 3; ++k) across[x] += kEighths[y][k] * around[k][x]->rgb[c];
      }
      for (int32_t x = 0; x < kColourCell; ++x) {
        int32_t sum = 32;
        for (int k = 0; k < 3; ++k) sum += kEighths[x][k] * across[k];
        colours->rgb[y][x][c] = sum >> 6;
      }
    }
  }
}

}  // namespace starfocus
