// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_cell.h"

#include <cstring>

namespace starfocus {
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
    const size_t row = map.At(around.x, y);
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
  const uint8_t* doubts = doubt + map.At(0, row.y);
  const int16_t* disparities = map.disparity + map.At(0, row.y);
  for (int32_t x = row.x; x < row.x + row.width; x += 2, ++sample) {
    *sample = kOutside;
    if (x < 0 || x >= map.plan.width) continue;
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

}  // namespace

void FillCell(const ColourMap& map, const uint8_t* doubt, const Rect& area, ColourCell* cell) {
  PlaceGroups(map, doubt, Widened(map.plan, area, kReach), cell);
  const int32_t width = WholeBlocks(area.width) + 2 * kReach;
  const int32_t height = WholeBlocks(area.height) + 2 * kReach;
  for (int32_t k = 0; k < height; ++k) {
    const int32_t y = area.y - kReach + k;
    for (int32_t odd = 0; odd < 2; ++odd) {
      simd::ColourSample* row = cell->samples[k & 1][odd] + k / 2 * ColourCell::kHalf;
      if (y < 0 || y >= map.plan.height) {
        for (int32_t n = 0; n < width / 2; ++n) row[n] = kOutside;
      } else {
        FillEverySecond(map, doubt, {area.x - kReach + odd, y, width - odd, 1}, *cell, row);
      }
    }
  }
}

}  // namespace starfocus
