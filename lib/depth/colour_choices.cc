// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_choices.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>

#include "lib/base/fixed.h"
#include "simd/matting.h"

namespace starfocus {
namespace {

// Cost of keeping a pixel's own disparity, indexed by the pixel's doubt. Pixels of doubt 0 lie on a
// ramp or are unknown. Doubtful pixels are not compared with pixels of doubt 0. Doubts 1 to 3 have
// equal costs, because a map may displace steps by up to 3 pixels.
constexpr int16_t kDoubtCosts[kDoubtReach + 2] = {80, 45, 45, 45, 22, 11, 0};

// kColourCell is the largest side of a cell in pixels, and kCellBlock is the side of a block in
// pixels. One call of CompareColours processes every second pixel of a block.
constexpr int32_t kColourCell = 64, kCellBlock = 2 * simd::kColourBlock;

// Rounds a length in pixels up to a multiple of kCellBlock.
int32_t WholeBlocks(int32_t length) { return (length + kCellBlock - 1) / kCellBlock * kCellBlock; }

// Number of groups of disparities. Each group contains a range of one pixel of disparity.
constexpr int32_t kGroups = 1024;

}  // namespace

// A cell of the picture and its surroundings, stored as four pictures of half the size, one for
// each combination of even or odd rows and columns, because each doubtful pixel is compared with
// pixels in every second row and column only.
struct ColourCell {
  static constexpr int32_t kHalf = (kColourCell + 4 * simd::kColourReach) / 2;
  // Largest number of slots of a cell. Each group of disparities that occurs in the cell or its
  // surroundings has a slot. An unused slot separates groups that are not adjacent.
  static constexpr int32_t kMostPlaces = kGroups + 2;

  // The pixels of the cell and of its surroundings. The first index of `samples` is the lowest bit
  // of the row, and the second index is the lowest bit of the column.
  simd::ColourSample samples[2][2][kHalf * kHalf];
  // Number of slots, which are ordered from the nearest group to the farthest. The first and the
  // last slot are unused.
  int32_t places;
  int16_t highest[kMostPlaces];  // largest disparity of the group in each slot
  // Index of the slot of each group, multiplied by kSliceLanes; 0 for groups that do not occur in
  // the cell.
  uint16_t place[kGroups];
  uint16_t least[kMostPlaces * simd::kSliceLanes];  // result of CompareColours for a block

  // Returns the samples around the block whose first pixel is (x, y). Coordinates are relative to
  // the first pixel of the cell.
  const simd::ColourSample* Window(int32_t x, int32_t y) const {
    return samples[y & 1][x & 1] + y / 2 * kHalf + x / 2;
  }
};

// Costs of a path up to a pixel, one for each choice of the pixel. `at` is the pixel's position on
// the line of the path.
struct ChoicePath {
  int32_t at;
  int16_t cost[kMostChoices];
};

namespace {

constexpr int32_t kReach = 2 * simd::kColourReach;
// Mask of the low bits of a disparity, which are the offset of the disparity within its group.
constexpr int32_t kLow = (1 << kDisparityBits) - 1;
static_assert(simd::kColourKeyBits == kDisparityBits,
              "a colour key stores the low bits of a disparity");
constexpr simd::ColourSample kOutside = {0, 0, 0, simd::kNoColourKey, 0};

int32_t GroupOf(int32_t disparity) { return (disparity >> kDisparityBits) + kGroups / 2; }

// Assigns a slot to each group of disparities that occurs in `around`. Pixels of doubt 0 are
// ignored.
void PlaceGroups(const ColourMap& map, const uint8_t* doubt, const Rect& around, ColourCell* cell) {
  std::memset(cell->place, 0, sizeof cell->place);
  int32_t first = kGroups, last = 0;
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const size_t row = map.setup.At(around.x, y);
    for (int32_t x = 0; x < around.width; ++x) {
      if (doubt[row + static_cast<size_t>(x)] == 0) continue;
      const int32_t group = GroupOf(map.disparity[row + static_cast<size_t>(x)]);
      cell->place[group] = 1;
      first = Min(first, group);
      last = Max(last, group);
    }
  }
  int32_t places = 1;
  for (int32_t group = last; group >= first; --group) {
    if (cell->place[group] == 0) {
      places += group < last && cell->place[group + 1] != 0 ? 1 : 0;
      continue;
    }
    cell->highest[places] = static_cast<int16_t>((group - kGroups / 2) * (kLow + 1) + kLow);
    cell->place[group] = static_cast<uint16_t>(places++ * static_cast<int32_t>(simd::kSliceLanes));
  }
  cell->places = places + 1;
}

// Fills one sample for every second pixel of a row.
void FillEverySecond(const ColourMap& map, const uint8_t* doubt, const Rect& row,
                     const ColourCell& cell, simd::ColourSample* sample) {
  const uint8_t* colours = map.Pixel(0, row.y);
  const uint8_t* doubts = doubt + map.setup.At(0, row.y);
  const int16_t* disparities = map.disparity + map.setup.At(0, row.y);
  for (int32_t x = row.x; x < row.x + row.width; x += 2, ++sample) {
    *sample = kOutside;
    if (x < 0 || x >= map.setup.width) continue;
    const uint8_t* colour = colours + 3 * x;
    sample->sum = static_cast<int16_t>(colour[0] + colour[1] + colour[2]);
    sample->red_green = static_cast<int16_t>(colour[0] - colour[1]);
    sample->green_blue = static_cast<int16_t>(colour[1] - colour[2]);
    if (doubts[x] == 0) continue;
    const int32_t disparity = disparities[x];
    sample->key = static_cast<uint16_t>((kDoubtCosts[doubts[x]] << kDisparityBits) + kLow -
                                        (disparity & kLow));
    sample->place = cell.place[GroupOf(disparity)];
  }
}

// Fills `cell` with the samples and slots for the rectangle `area` of the picture.
void FillCell(const ColourMap& map, const uint8_t* doubt, const Rect& area, ColourCell* cell) {
  PlaceGroups(map, doubt, Widened(map.setup, area, kReach), cell);
  const int32_t width = WholeBlocks(area.width) + 2 * kReach;
  const int32_t height = WholeBlocks(area.height) + 2 * kReach;
  for (int32_t k = 0; k < height; ++k) {
    const int32_t y = area.y - kReach + k;
    for (int32_t odd = 0; odd < 2; ++odd) {
      simd::ColourSample* row = cell->samples[k & 1][odd] + k / 2 * ColourCell::kHalf;
      if (y < 0 || y >= map.setup.height) {
        for (int32_t n = 0; n < width / 2; ++n) row[n] = kOutside;
      } else {
        FillEverySecond(map, doubt, {area.x - kReach + odd, y, width - odd, 1}, *cell, row);
      }
    }
  }
}

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
         job.doubt[job.map.setup.At(area.x + x, area.y + y)] <= kDoubtReach;
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
    const size_t own = job.map.setup.At(area.x + column, area.y + row);
    KeepOwn(job.map.disparity[own], kDoubtCosts[job.doubt[own]], choices);
    for (int32_t k = 0; k < choices->count; ++k) choices->sum[k] = 0;
  }
}

// Processes the doubtful pixels of a row of the cell in blocks. Each block begins at a doubtful
// pixel, unless such a block would extend beyond the cell.
void ChooseInRow(const ChoiceJob& job, const Rect& area, int32_t first, int32_t y) {
  const int32_t last = first + WholeBlocks(area.width) - kCellBlock;
  uint8_t least[kColourCell];  // smallest doubt in each column of the row of blocks
  std::memset(least, kDoubtReach + 1, sizeof least);
  for (int32_t row = y; row < Min(y + kCellBlock, area.height); row += 2) {
    const uint8_t* doubt = job.doubt + job.map.setup.At(area.x, area.y + row);
    for (int32_t x = 0; x < area.width; ++x) least[x] = std::min(least[x], doubt[x]);
  }
  for (int32_t x = first; x < area.width;) {
    if (least[x] <= kDoubtReach) {
      ChooseInBlock(job, area, Min(x, last), y);
      x += kCellBlock;
    } else {
      x += 2;
    }
  }
}

bool HasDoubt(const ChoiceJob& job, const Rect& area) {
  bool doubtful = false;
  for (int32_t y = area.y; y < area.y + area.height && !doubtful; ++y) {
    ForDoubtful(job.doubt + job.map.setup.At(area.x, y), area.width,
                [&](int32_t) { doubtful = true; });
  }
  return doubtful;
}

void ChooseInCell(const ChoiceJob& job, const Rect& area) {
  if (!HasDoubt(job, area)) return;
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
  int16_t next[kMostChoices];
  for (int32_t k = 0; k < to->count; ++k) {
    int32_t cost = least + jump;
    for (int32_t other = 0; other < from.count; ++other) {
      const int32_t difference = Abs(to->disparity[k] - from.disparity[other]);
      if (difference > 3 * kPixel) continue;
      cost = Min(cost, path->cost[other] + (difference > kPixel ? jump / 2 : 0));
    }
    next[k] = static_cast<int16_t>(to->cost[k] + cost - least);
    to->sum[k] = static_cast<int16_t>(to->sum[k] + next[k]);
  }
  std::copy_n(next, to->count, path->cost);
}

// A line of pixels of a region, along which a path leads. The members describe the pixel at
// position 0 and the distances from a pixel to the next pixel.
struct PathLine {
  ptrdiff_t pixel, pixel_step;    // index of the pixel in the map
  ptrdiff_t choice, choice_step;  // index of the pixel in the region
  const uint8_t* colour;
  ptrdiff_t colour_step;

  PathLine(const ChoiceJob& job, int32_t x, int32_t y, int32_t dx, int32_t dy) {
    const Rect& region = job.region;
    pixel = static_cast<ptrdiff_t>(job.map.setup.At(region.x + x, region.y + y));
    pixel_step = dx + ptrdiff_t{dy} * job.map.setup.width;
    choice = x + ptrdiff_t{y} * region.width;
    choice_step = dx + ptrdiff_t{dy} * region.width;
    colour = job.map.Pixel(region.x + x, region.y + y);
    colour_step = 3 * ptrdiff_t{dx} + dy * static_cast<ptrdiff_t>(job.map.ColourStride());
  }
  // Moves position 0 by `columns` to the right.
  void Move(int32_t columns) {
    pixel += columns;
    choice += columns;
    colour += 3 * ptrdiff_t{columns};
  }
};

// Returns the choices of the pixel at position `at` of a line. A pixel without doubt has its own
// disparity as the only choice, which is stored in `own`.
inline Choices* ChoicesAt(const ChoiceJob& job, const PathLine& line, int32_t at, Choices* own) {
  const ptrdiff_t place = line.pixel + at * line.pixel_step;
  if (job.doubt[place] <= kDoubtReach) {
    return job.memory.choices + line.choice + at * line.choice_step;
  }
  own->count = 1;
  own->disparity[0] = job.map.disparity[place];
  own->cost[0] = own->sum[0] = 0;
  return own;
}

void Begin(Choices* choices, ChoicePath* path) {
  for (int32_t k = 0; k < choices->count; ++k) {
    path->cost[k] = choices->cost[k];
    choices->sum[k] = static_cast<int16_t>(choices->sum[k] + choices->cost[k]);
  }
}

// Continues the path of a line to the doubtful pixel at position `at`. The costs of a path at a
// pixel without doubt whose predecessor is also without doubt depend only on these two pixels. A
// path that has reached neither therefore begins two pixels before the doubtful pixel.
void ContinueTo(const ChoiceJob& job, const PathLine& line, int32_t at, ChoicePath* path) {
  Choices own[2];
  const int32_t first = Max(at - 2, 0);
  if (path->at < first) {
    path->at = first;
    Begin(ChoicesAt(job, line, first, own), path);
  }
  for (; path->at < at; ++path->at) {
    const Choices* from = ChoicesAt(job, line, path->at, own);
    Choices* to = ChoicesAt(job, line, path->at + 1, own + 1);
    if (from->count == 1 && to->count == 1 &&
        Abs(to->disparity[0] - from->disparity[0]) <= kPixel) {
      // In the most frequent case, both pixels have a single choice and both choices are on one
      // surface, so the path adds no cost.
      Begin(to, path);
      continue;
    }
    const uint8_t* colour = line.colour + path->at * line.colour_step;
    ContinueAmong(*from, JumpBetween(colour, colour + line.colour_step), to, path);
  }
}

constexpr int32_t kNotBegun = -1;

// Adds the costs of paths along rows to the sums of the choices. Paths lead to the right (direction
// 1) or to the left (-1).
void AddPathsAcross(const ChoiceJob& job, int32_t direction) {
  const Rect& region = job.region;
  const int32_t last = region.width - 1;
  for (int32_t y = 0; y < region.height; ++y) {
    const uint8_t* doubt = job.doubt + job.map.setup.At(region.x, region.y + y);
    const PathLine line(job, direction > 0 ? 0 : last, y, direction, 0);
    ChoicePath path;
    path.at = kNotBegun;
    if (direction > 0) {
      ForDoubtful(doubt, region.width, [&](int32_t x) { ContinueTo(job, line, x, &path); });
      continue;
    }
    for (int32_t at = 0; at <= last; ++at) {
      if (doubt[last - at] <= kDoubtReach) ContinueTo(job, line, at, &path);
    }
  }
}

// Adds the costs of paths along columns to the sums of the choices. Paths lead down (direction 1)
// or up (-1).
void AddPathsDown(const ChoiceJob& job, int32_t direction) {
  const Rect& region = job.region;
  ChoicePath* paths = job.memory.paths;
  for (int32_t x = 0; x < region.width; ++x) paths[x].at = kNotBegun;
  const int32_t top = direction > 0 ? 0 : region.height - 1;
  const PathLine first(job, 0, top, 0, direction);
  for (int32_t at = 0; at < region.height; ++at) {
    const uint8_t* doubt = job.doubt + job.map.setup.At(region.x, region.y + top + at * direction);
    ForDoubtful(doubt, region.width, [&](int32_t x) {
      PathLine line = first;
      line.Move(x);
      ContinueTo(job, line, at, paths + x);
    });
  }
}

// Divides `length` pixels into cells of equal size, and returns the side of a cell, rounded up to
// whole blocks.
int32_t CellSide(int32_t length) {
  const int32_t cells = (length + kColourCell - 1) / kColourCell;
  return WholeBlocks((length + cells - 1) / cells);
}

}  // namespace

ChoiceMemory TakeChoices(size_t width, size_t area, Arena* arena) {
  return {arena->Take<Choices>(area), arena->Take<ChoicePath>(width), arena->Take<ColourCell>(1)};
}

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
    AddPathsAcross(job, direction);
    AddPathsDown(job, direction);
  }
}

}  // namespace starfocus
