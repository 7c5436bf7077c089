// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_choices.h"

#include <cstring>
#include <initializer_list>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// kJump is the cost of a step to another surface between two pixels of one colour. If the colours
// of the two pixels differ by kColourEdge, a step costs half of kJump.
constexpr int32_t kJump = 120, kColourEdge = 12;

// Arguments of WeighChoices.
struct ChoiceJob {
  const ColourMap& map;
  const uint8_t* doubt;
  const Rect& region;
  const simd::DepthKernels& kernels;
  const ChoiceMemory& memory;
};

// Inserts a candidate disparity into `choices`, which are sorted by cost. Choices of equal cost
// stay in the order of insertion, so that the nearest disparity is first.
void Insert(int32_t disparity, int32_t cost, Choices* choices) {
  int32_t at = Min(choices->count, kMostChoices - 1);
  const bool full = choices->count == kMostChoices;
  if (full && choices->cost[at] <= cost) return;
  for (; at > 0 && choices->cost[at - 1] > cost; --at) {
    choices->disparity[at] = choices->disparity[at - 1];
    choices->cost[at] = choices->cost[at - 1];
  }
  choices->disparity[at] = static_cast<int16_t>(disparity);
  choices->cost[at] = static_cast<int16_t>(cost);
  choices->count += full ? 0 : 1;
}

// Fills the choices of pixel `lane` of a block with one disparity from each group of disparities
// whose cost is a local minimum. Groups are visited from the nearest to the farthest.
void TakeBest(const ColourCell& cell, size_t lane, Choices* choices) {
  choices->count = 0;
  const uint16_t* keys = cell.least + lane;
  const auto cost_at = [keys](int32_t place) {
    return keys[static_cast<size_t>(place) * simd::kSliceLanes] >> simd::kColourKeyBits;
  };
  int32_t nearer = cost_at(0), cost = cost_at(1);
  for (int32_t place = 1; place + 1 < cell.places; ++place) {
    const int32_t farther = cost_at(place + 1);
    if (cost <= nearer && cost < farther) {
      const int32_t key = keys[static_cast<size_t>(place) * simd::kSliceLanes];
      Insert(cell.highest[place] - (key & (kPixel - 1)), cost, choices);
    }
    nearer = cost;
    cost = farther;
  }
}

// Adds the map's disparity to the choices, unless a choice differs from the map's disparity by at
// most a pixel.
void KeepOwn(int32_t own, int32_t cost, Choices* choices) {
  for (int32_t k = 0; k < choices->count; ++k) {
    if (Abs(choices->disparity[k] - own) <= kPixel) return;
  }
  const int32_t at = choices->count < kMostChoices ? choices->count++ : kMostChoices - 1;
  choices->disparity[at] = static_cast<int16_t>(own);
  choices->cost[at] = static_cast<int16_t>(cost);
}

bool IsDoubtful(const ChoiceJob& job, const Rect& area, int32_t x, int32_t y) {
  return x < area.width && y < area.height &&
         job.doubt[job.map.At(area.x + x, area.y + y)] <= kDoubtReach;
}

// Fills the choices of the doubtful pixels of a block. The block consists of every second pixel in
// both directions, starting at (x, y) in the cell.
void ChooseInBlock(const ChoiceJob& job, const Rect& area, int32_t x, int32_t y) {
  ColourCell* cell = job.memory.cell;
  std::memset(cell->least, 0xFF,
              static_cast<size_t>(cell->places) * simd::kSliceLanes * sizeof *cell->least);
  job.kernels.CompareColours(cell->Window(x, y), ColourCell::kHalf, cell->least);
  for (size_t n = 0; n < simd::kSliceLanes; ++n) {
    const int32_t column = x + 2 * static_cast<int32_t>(n % simd::kColourBlock);
    const int32_t row = y + 2 * static_cast<int32_t>(n / simd::kColourBlock);
    if (!IsDoubtful(job, area, column, row)) continue;
    Choices* choices = job.memory.choices + (area.y + row - job.region.y) * job.region.width +
                       area.x + column - job.region.x;
    TakeBest(*cell, n, choices);
    const size_t own = job.map.At(area.x + column, area.y + row);
    KeepOwn(job.map.disparity[own], kDoubtCosts[job.doubt[own]], choices);
    for (int32_t k = 0; k < choices->count; ++k) choices->sum[k] = 0;
  }
}

// Processes the doubtful pixels of a row of the cell in blocks. Each block begins at a doubtful
// pixel, unless such a block would extend beyond the cell.
void ChooseInRow(const ChoiceJob& job, const Rect& area, int32_t first, int32_t y) {
  const int32_t last = first + WholeBlocks(area.width) - kCellBlock;
  for (int32_t x = first; x < area.width;) {
    bool doubtful = false;
    for (int32_t row = y; row < y + kCellBlock; row += 2) doubtful |= IsDoubtful(job, area, x, row);
    if (doubtful) {
      ChooseInBlock(job, area, Min(x, last), y);
      x += kCellBlock;
    } else {
      x += 2;
    }
  }
}

// Gives each pixel that is not doubtful its own disparity as the only choice. Returns true if any
// pixel is doubtful.
bool ChooseOwn(const ChoiceJob& job, const Rect& area) {
  bool doubtful = false;
  for (int32_t y = area.y; y < area.y + area.height; ++y) {
    Choices* row = job.memory.choices + (y - job.region.y) * job.region.width - job.region.x;
    for (int32_t x = area.x; x < area.x + area.width; ++x) {
      const size_t at = job.map.At(x, y);
      if (job.doubt[at] <= kDoubtReach) {
        doubtful = true;
        continue;
      }
      row[x].count = 1;
      row[x].disparity[0] = job.map.disparity[at];
      row[x].cost[0] = row[x].sum[0] = 0;
    }
  }
  return doubtful;
}

void ChooseInCell(const ChoiceJob& job, const Rect& area) {
  if (!ChooseOwn(job, area)) return;
  FillCell(job.map, job.doubt, area, job.memory.cell);
  for (int32_t y = 0; y < area.height; y += kCellBlock) {
    for (int32_t odd = 0; odd < 4; ++odd) ChooseInRow(job, area, odd % 2, y + odd / 2);
  }
}

int32_t JumpBetween(const uint8_t* a, const uint8_t* b) {
  return kJump * kColourEdge / (kColourEdge + ColourDifference(a, b));
}

// Continues a path from the choices of one pixel to the choices of the next pixel, and updates the
// path's costs. A change of surface costs `jump`. Adds the new costs to the sums of the next pixel.
void ContinueAmong(const Choices& from, int32_t jump, Choices* to, ChoicePath* path) {
  int32_t least = path->cost[0];
  for (int32_t k = 1; k < from.count; ++k) least = Min(least, path->cost[k]);
  ChoicePath next;
  for (int32_t k = 0; k < to->count; ++k) {
    int32_t cost = least + jump;
    for (int32_t other = 0; other < from.count; ++other) {
      const int32_t difference = Abs(to->disparity[k] - from.disparity[other]);
      if (difference > 3 * kPixel) continue;
      cost = Min(cost, path->cost[other] + (difference > kPixel ? jump / 2 : 0));
    }
    next.cost[k] = static_cast<int16_t>(to->cost[k] + cost - least);
    to->sum[k] = static_cast<int16_t>(to->sum[k] + next.cost[k]);
  }
  *path = next;
}

// Continues a path from a pixel to the next pixel, given the colours of both pixels. In the most
// frequent case, both pixels have a single choice and both choices are on one surface, so the path
// adds no cost.
inline void Continue(const Choices& from, const uint8_t* colour, const uint8_t* next, Choices* to,
                     ChoicePath* path) {
  if (from.count > 1 || to->count > 1 || Abs(to->disparity[0] - from.disparity[0]) > kPixel) {
    return ContinueAmong(from, JumpBetween(colour, next), to, path);
  }
  path->cost[0] = to->cost[0];
  to->sum[0] = static_cast<int16_t>(to->sum[0] + to->cost[0]);
}

void Begin(Choices* choices, ChoicePath* path) {
  for (int32_t k = 0; k < choices->count; ++k) {
    path->cost[k] = choices->cost[k];
    choices->sum[k] = static_cast<int16_t>(choices->sum[k] + choices->cost[k]);
  }
}

// Adds the costs of paths along rows to the sums of the choices. Paths lead to the right (direction
// 1) or to the left (-1).
void AddPathsAcross(const ColourMap& map, const Rect& region, int32_t direction, Choices* choices) {
  for (int32_t y = 0; y < region.height; ++y) {
    Choices* row = choices + static_cast<size_t>(y) * static_cast<size_t>(region.width);
    int32_t x = direction > 0 ? 0 : region.width - 1;
    ChoicePath path;
    Begin(row + x, &path);
    for (int32_t k = 1; k < region.width; ++k, x += direction) {
      const uint8_t* colour = map.Pixel(region.x + x, region.y + y);
      Continue(row[x], colour, colour + 3 * direction, row + x + direction, &path);
    }
  }
}

// Adds the costs of paths along columns to the sums of the choices. Paths lead down (direction 1)
// or up (-1).
void AddPathsDown(const ColourMap& map, const Rect& region, int32_t direction, ChoicePath* paths,
                  Choices* choices) {
  const auto width = static_cast<size_t>(region.width);
  int32_t y = direction > 0 ? 0 : region.height - 1;
  for (size_t x = 0; x < width; ++x) {
    Begin(choices + static_cast<size_t>(y) * width + x, paths + x);
  }
  for (int32_t k = 1; k < region.height; ++k, y += direction) {
    const Choices* from = choices + static_cast<size_t>(y) * width;
    Choices* to = choices + static_cast<size_t>(y + direction) * width;
    const uint8_t* colour = map.Pixel(region.x, region.y + y);
    const uint8_t* next = map.Pixel(region.x, region.y + y + direction);
    for (size_t x = 0; x < width; ++x) {
      Continue(from[x], colour + 3 * x, next + 3 * x, to + x, paths + x);
    }
  }
}

// Divides `length` pixels into cells of equal size, and returns the side of a cell, rounded up to
// whole blocks.
int32_t CellSide(int32_t length) {
  const int32_t cells = (length + kColourCell - 1) / kColourCell;
  return WholeBlocks((length + cells - 1) / cells);
}

}  // namespace

void WeighChoices(const ColourMap& map, const uint8_t* doubt, const Rect& region,
                  const simd::DepthKernels& kernels, const ChoiceMemory& memory) {
  const ChoiceJob job = {map, doubt, region, kernels, memory};
  const int32_t across = CellSide(region.width), down = CellSide(region.height);
  for (int32_t y = 0; y < region.height; y += down) {
    for (int32_t x = 0; x < region.width; x += across) {
      ChooseInCell(job, {region.x + x, region.y + y, Min(across, region.width - x),
                         Min(down, region.height - y)});
    }
  }
  for (const int32_t direction : {1, -1}) {
    AddPathsAcross(map, region, direction, memory.choices);
    AddPathsDown(map, region, direction, memory.paths, memory.choices);
  }
}

}  // namespace starfocus
