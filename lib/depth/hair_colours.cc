// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/hair_colours.h"

#include "lib/base/fixed.h"
#include "lib/depth/hair_job.h"

namespace starfocus {
namespace {

// Writes the mean colour of a cell to the lowest level of `pyramid`. The weight of a pixel is
// weight(pixel).
template <class Weight>
void Pull(const HairJob& job, int32_t column, int32_t row, const Weight& weight,
          const ColourPyramid& pyramid) {
  ColourSum sum;
  ForPixels(job, column, row, [&](const CellPixel& pixel) { sum.Add(pixel.rgb, weight(pixel)); });
  pyramid.levels[0].At(column, row) = sum.Mean();
}

// Returns the squared contrast of a near pixel to the background, or 0 for a far pixel.
int32_t ContrastOf(const CellPixel& pixel, const CellColours& far) {
  if (!pixel.is_near) return 0;
  int32_t sum = 0;
  for (int c = 0; c < 3; ++c) {
    const int32_t difference = pixel.rgb[c] - far.rgb[pixel.row][pixel.column][c];
    sum += difference * difference;
  }
  return sum;
}

// Returns the largest squared contrast to the background in a cell and its eight neighbours.
int32_t ContrastAround(const HairJob& job, int32_t column, int32_t row) {
  const HairCells& cells = job.cells;
  int32_t most = 0;
  for (int32_t y = Max(row - 1, 0); y <= Min(row + 1, cells.rows - 1); ++y) {
    for (int32_t x = Max(column - 1, 0); x <= Min(column + 1, cells.columns - 1); ++x) {
      most = Max(most, job.memory.contrast[cells.At(x, y)]);
    }
  }
  return most;
}

}  // namespace

void PullFar(const void* data, int32_t index, int32_t) {
  const HairJob& job = HairJobOf(data);
  ForMarked(job, index, [&](int32_t column, int32_t row, uint8_t marks) {
    const bool far = (marks & HairCells::kIsFar) != 0;
    if (!far) job.memory.far.levels[0].At(column, row) = {};
    if (far)
      Pull(
          job, column, row, [](const CellPixel&) { return kFullyKnown; }, job.memory.far);
  });
}

void MeasureContrast(const void* data, int32_t index, int32_t) {
  const HairJob& job = HairJobOf(data);
  ForMarked(job, index, [&](int32_t column, int32_t row, uint8_t marks) {
    int32_t most = 0;
    if (MayHaveNear(marks)) {
      CellColours far;
      InterpolateCell(job.memory.far, column, row, &far);
      ForPixels(job, column, row,
                [&](const CellPixel& pixel) { most = Max(most, ContrastOf(pixel, far)); });
    }
    job.memory.contrast[job.cells.At(column, row)] = most;
  });
}

void PullNear(const void* data, int32_t index, int32_t) {
  const HairJob& job = HairJobOf(data);
  ForMarked(job, index, [&](int32_t column, int32_t row, uint8_t) {
    if (job.memory.contrast[job.cells.At(column, row)] == 0) {
      job.memory.near.levels[0].At(column, row) = {};
      return;
    }
    const int64_t most = ContrastAround(job, column, row) + int64_t{1};
    CellColours far;
    InterpolateCell(job.memory.far, column, row, &far);
    const auto weight = [&](const CellPixel& pixel) {
      return FourthPower(
          static_cast<uint32_t>(kFullyKnown * int64_t{ContrastOf(pixel, far)} / most));
    };
    Pull(job, column, row, weight, job.memory.near);
  });
}

void PullBoth(const void* data, int32_t index, int32_t) {
  const HairJob& job = HairJobOf(data);
  ForMarked(job, index, [&](int32_t column, int32_t row, uint8_t marks) {
    if (marks == 0) {
      job.memory.far.levels[0].At(column, row) = {};
      job.memory.near.levels[0].At(column, row) = {};
      return;
    }
    const bool has_hair = (marks & HairCells::kHasHair) != 0;
    const auto share = [&](const CellPixel& pixel) {
      if (!has_hair) return pixel.is_near ? uint32_t{kFullyKnown} : 0;
      return ShareOf(job.CoverageAt(pixel.x, pixel.y));
    };
    Pull(
        job, column, row, [&](const CellPixel& pixel) { return FourthPower(share(pixel)); },
        job.memory.near);
    Pull(
        job, column, row,
        [&](const CellPixel& pixel) { return FourthPower(kFullyKnown - share(pixel)); },
        job.memory.far);
  });
}

}  // namespace starfocus
