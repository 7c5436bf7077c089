// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/outlines.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/matting/outline_votes.h"

namespace starfocus {

namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Smallest step of an outline of a soft map. In hard maps, it is kSurfaceStep.
constexpr int32_t kLeastStep = 2 * kPixel;
// The distances of a tile depend on the outlines up to kMargin pixels around it.
constexpr int32_t kMargin = kMostBand + 2;
constexpr size_t kMostTall = kMostRegion + 2 * kMostOutlineRadius;
constexpr uint8_t kFar = UINT8_MAX;
// Widths of ramps that are counted apart, in 1/kDistance pixel. The last one includes all wider.
constexpr int32_t kRampCounts = kDistance * 25;
// Percentage of the pixels next to the outlines of a hard map that change their side, from which
// the map is assumed to be wrong. In exact maps it is 3 to 10, and 17 among wires with few colours;
// in wrong maps 21 to 50.
constexpr int64_t kWrongPercent = 18;
// A part of a right map is wrong if the outline is displaced: from kDisplacedPercent of the pixels
// next to outlines, within kRightReach cells, change their side in the direction of the shift of
// their cell. In exact maps it is at most 11 of 97 % of all cells; in displaced maps about 45.
constexpr int64_t kDisplacedPercent = 35;
constexpr int32_t kRightReach = 8;

}  // namespace

struct OutlineCounts {
  uint32_t ramps[kRampCounts];
  uint32_t beside, changes;  // Pixels next to outlines, and those of them that change their side.
  bool wrong;                // true if a part of the map is wrong
};

struct OutlineScratch {
  int16_t low[kMostRegion * kMostRegion], high[kMostRegion * kMostRegion];
  int16_t middle[kMostRegion * kMostRegion];
  int16_t rows[2][kMostTall * kMostRegion];  // extremes of windows of one row
  uint8_t distance[kMostRegion * kMostRegion];
  VoteBlock block;
  SidePlanes sides;
};

namespace {

// Takes the lower of `low` and `from`, and the higher of `high` and `upper`.
void JoinExtremes(const int16_t* lower, const int16_t* upper, int32_t count, int16_t* low,
                  int16_t* high) {
  for (int32_t k = 0; k < count; ++k) {
    low[k] = std::min(low[k], lower[k]);
    high[k] = std::max(high[k], upper[k]);
  }
}

// Fills scratch->low and scratch->high with the lowest and highest disparity in the window of each
// pixel of `rect`.
void FindExtremes(const OutlineMemory& memory, const int16_t* map, const Rect& rect, int32_t radius,
                  OutlineScratch* scratch) {
  const Rect tall = memory.Widened(rect, radius);
  const auto line = [&](int16_t* plane, int32_t y) { return plane + ptrdiff_t{y} * rect.width; };
  for (int32_t y = 0; y < tall.height; ++y) {
    int16_t *low = line(scratch->rows[0], y), *high = line(scratch->rows[1], y);
    std::fill_n(low, rect.width, INT16_MAX);
    std::fill_n(high, rect.width, INT16_MIN);
    for (int32_t shift = -radius; shift <= radius; ++shift) {
      const int32_t first = Max(0, -rect.x - shift);
      const int32_t end = Min(rect.width, memory.width - rect.x - shift);
      const int16_t* from = map + memory.At(0, tall.y + y) + rect.x + shift;
      if (end > first)
        JoinExtremes(from + first, from + first, end - first, low + first, high + first);
    }
  }
  for (int32_t y = 0; y < rect.height; ++y) {
    int16_t *low = line(scratch->low, y), *high = line(scratch->high, y);
    std::fill_n(low, rect.width, INT16_MAX);
    std::fill_n(high, rect.width, INT16_MIN);
    const int32_t top = rect.y - tall.y + y;
    for (int32_t k = Max(top - radius, 0); k <= Min(top + radius, tall.height - 1); ++k) {
      JoinExtremes(line(scratch->rows[0], k), line(scratch->rows[1], k), rect.width, low, high);
    }
  }
}

// Calls act(disparity, dx, dy) for the four neighbours of a pixel.
template <class Act>
void ForBeside(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y,
               const Act& act) {
  const int16_t* own = map + memory.At(x, y);
  if (x > 0) act(int32_t{own[-1]}, -1, 0);
  if (x + 1 < memory.width) act(int32_t{own[1]}, 1, 0);
  if (y > 0) act(int32_t{own[-memory.width]}, 0, -1);
  if (y + 1 < memory.height) act(int32_t{own[memory.width]}, 0, 1);
}

// Returns the largest difference to a neighbour on the other side of `middle`, or 0.
int32_t StepAcross(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y,
                   int32_t middle) {
  const int32_t own = map[memory.At(x, y)];
  int32_t step = 0;
  ForBeside(memory, map, x, y, [&](int32_t other, int32_t, int32_t) {
    if ((own > middle) != (other > middle)) step = Max(step, Abs(other - own));
  });
  return step;
}

// Returns true if the map around a pixel is hardly steeper than a plane with the range of the
// window.
bool IsSlanted(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y, int32_t range,
               int32_t radius) {
  const Rect around = memory.Widened({x, y, 1, 1}, 2);
  int32_t low = INT16_MAX, high = INT16_MIN;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      low = Min(low, map[memory.At(column, row)]);
      high = Max(high, map[memory.At(column, row)]);
    }
  }
  return (high - low) * 5 * radius <= 12 * range;
}

// Counts the widths of the map's ramps at the outlines of a tile. The width is the range of the
// window, divided by the largest step.
void CountRamps(const OutlineMemory& memory, const Rect& tile, OutlineScratch* scratch,
                OutlineCounts* counts) {
  const int16_t* map = memory.given;
  FindExtremes(memory, map, tile, kMostOutlineRadius, scratch);
  for (int32_t y = 0; y < tile.height; ++y) {
    for (int32_t x = 0; x < tile.width; ++x) {
      const int32_t k = y * tile.width + x, range = scratch->high[k] - scratch->low[k];
      if (range <= kLeastStep) continue;
      const int32_t middle = (scratch->high[k] + scratch->low[k]) >> 1;
      const int32_t step = StepAcross(memory, map, tile.x + x, tile.y + y, middle);
      if (step == 0) continue;
      if (IsSlanted(memory, map, tile.x + x, tile.y + y, range, kMostOutlineRadius)) continue;
      ++counts->ramps[Min(kDistance * range / step, kRampCounts - 1)];
    }
  }
}

// Finds the pixels beside outlines in a region, and the middles of their two surfaces.
void FindCrossings(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                   const Rect& region, OutlineScratch* scratch) {
  if (!pass.IsHard()) FindExtremes(memory, map, region, pass.radius, scratch);
  for (int32_t y = 0; y < region.height; ++y) {
    for (int32_t x = 0; x < region.width; ++x) {
      const int32_t k = y * region.width + x, column = region.x + x, row = region.y + y;
      bool crosses = false;
      int32_t middle = 0;
      if (pass.IsHard()) {
        const int32_t own = map[memory.At(column, row)];
        int32_t step = kSurfaceStep;
        ForBeside(memory, map, column, row, [&](int32_t other, int32_t, int32_t) {
          const int32_t size = Abs(other - own), between = (own + other) >> 1;
          if (size < step || size <= kSurfaceStep) return;
          // Of equal steps, the nearer one counts, so that mirrored maps have mirrored outlines.
          middle = size > step ? between : Max(middle, between);
          step = size;
          crosses = true;
        });
      } else {
        const int32_t range = scratch->high[k] - scratch->low[k];
        middle = (scratch->high[k] + scratch->low[k]) >> 1;
        crosses = range > kLeastStep && StepAcross(memory, map, column, row, middle) > 0 &&
                  !IsSlanted(memory, map, column, row, range, pass.radius);
      }
      scratch->middle[k] = static_cast<int16_t>(middle);
      scratch->distance[k] = crosses ? uint8_t{kDistance / 2} : kFar;
    }
  }
}

// Extends distances and middles by a chamfer transform with steps of 1 and 1.5 pixels.
void ExtendDistances(const Rect& region, int32_t most, OutlineScratch* scratch) {
  const int32_t width = region.width;
  const auto take = [&](int32_t k, int32_t from, int32_t step) {
    const int32_t sum = scratch->distance[from] + step;
    if (sum > scratch->distance[k] || sum > most) return;
    const int16_t middle = scratch->middle[from];
    const bool equal = sum == scratch->distance[k];
    scratch->middle[k] = equal ? std::max(scratch->middle[k], middle) : middle;
    scratch->distance[k] = static_cast<uint8_t>(sum);
  };
  // Takes from the previous row and column if `next` is 1, from the following ones if it is -1.
  const auto visit = [&](int32_t x, int32_t y, int32_t next) {
    const int32_t k = y * width + x, row = next * width;
    const bool has_row = next > 0 ? y > 0 : y + 1 < region.height;
    const bool has_column = next > 0 ? x > 0 : x + 1 < width;
    const bool has_other = next > 0 ? x + 1 < width : x > 0;
    if (has_row) take(k, k - row, kDistance);
    if (has_column) take(k, k - next, kDistance);
    if (has_row && has_column) take(k, k - row - next, 3 * kDistance / 2);
    if (has_row && has_other) take(k, k - row + next, 3 * kDistance / 2);
  };
  for (int32_t y = 0; y < region.height; ++y) {
    for (int32_t x = 0; x < width; ++x) visit(x, y, 1);
  }
  for (int32_t y = region.height - 1; y >= 0; --y) {
    for (int32_t x = width - 1; x >= 0; --x) visit(x, y, -1);
  }
}

// Writes the middles and the signed distances of a tile.
void MeasureDistances(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                      const Rect& tile, OutlineScratch* scratch) {
  const Rect region = memory.Widened(tile, pass.band + 2);
  FindCrossings(memory, pass, map, region, scratch);
  ExtendDistances(region, kDistance * pass.band + 2, scratch);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const int32_t k = (y - region.y) * region.width + x - region.x;
      const size_t at = memory.At(x, y);
      memory.distance[at] = 0;
      if (scratch->distance[k] == kFar) continue;
      const int32_t middle = scratch->middle[k];
      const bool near = map[at] > middle;
      int32_t ridge = 1;
      ForBeside(memory, map, x, y, [&](int32_t other, int32_t dx, int32_t dy) {
        const bool farther = scratch->distance[k + dy * region.width + dx] > scratch->distance[k];
        if (farther && (other > middle) == near) ridge = 0;
      });
      const int32_t distance = scratch->distance[k] + ridge;
      memory.middle[at] = static_cast<int16_t>(middle);
      memory.distance[at] = static_cast<int8_t>(near ? distance : -distance);
    }
  }
}

// Returns the first pass from the widths of the ramps that all workers have counted. The width of
// the band follows from the median.
OutlinePass FirstPass(const OutlineCounts* counts, int32_t workers) {
  const auto count = [&](int32_t ramp) {
    uint32_t sum = 0;
    for (int32_t k = 0; k < workers; ++k) sum += counts[k].ramps[ramp];
    return sum;
  };
  uint32_t total = 0, below = 0;
  for (int32_t ramp = 0; ramp < kRampCounts; ++ramp) total += count(ramp);
  OutlinePass pass = {kDistance, 0, 6, 5, 60};
  for (int32_t ramp = 0; ramp < kRampCounts && 2 * below < total; ++ramp) {
    below += count(ramp);
    pass.ramp = ramp;
  }
  if (pass.IsHard()) return pass;
  pass.radius = Clamp(pass.ramp / (2 * kDistance) + 3, 4, kMostOutlineRadius);
  pass.band = Clamp((13 * pass.ramp + 10 * kDistance) / (10 * kDistance), 5, kMostBand);
  pass.trusted = 4;
  pass.clear = 51;
  return pass;
}

// The edges of the result of the first pass are steps that are hardly off. In soft maps, a second
// pass hardly improves results, and leaves more single pixels.
constexpr OutlinePass kSecondPass = {kDistance, 0, 3, 5, 8};

constexpr int32_t kPassPhases = 7;

// Counts the pixels next to the outlines in the cells of a tile, and those that change their side.
void CountChanges(const OutlineMemory& memory, const Rect& tile, OutlineCounts* counts) {
  ForShiftCells(memory, tile, [&](int32_t number, const Rect& cell, bool begins) {
    if (!begins) return;
    uint8_t beside = 0, changes = 0, displaced = 0;
    ForBand(memory, cell, [&](int32_t, int32_t, size_t at) {
      if (memory.side[at] == 0 || Abs(memory.distance[at]) >= kDistance) return;
      ++beside;
      if ((memory.side[at] > 0) == (memory.distance[at] > 0)) return;
      ++changes;
      if (memory.shift[number] * memory.side[at] > 0) ++displaced;
    });
    memory.beside[number] = beside;
    memory.displaced[number] = displaced;
    counts->beside += beside;
    counts->changes += changes;
  });
}

// Returns true if few pixels around a cell would change their side. The map has `changes` changes
// in `beside` pixels.
bool IsRight(const OutlineMemory& memory, int32_t number, int64_t beside, int64_t changes) {
  const int32_t columns = memory.Columns().Count(), rows = memory.Rows().Count();
  const int32_t column = number % columns, row = number / columns;
  int64_t near_beside = 0, near_displaced = 0;
  for (int32_t v = row - kRightReach; v <= row + kRightReach; v += 2) {
    for (int32_t u = column - kRightReach; u <= column + kRightReach; u += 2) {
      if (u < 0 || v < 0 || u >= columns || v >= rows) continue;
      near_beside += memory.beside[v * columns + u];
      near_displaced += memory.displaced[v * columns + u];
    }
  }
  return 100 * changes < kWrongPercent * beside &&
         100 * near_displaced < kDisplacedPercent * near_beside;
}

// Keeps the known disparities of a tile where the map is right. If `decides` is true, writes
// memory.is_right.
void KeepRight(const OutlinePicture& picture, const OutlineMemory& memory, bool decides,
               const Rect& tile, OutlineCounts* counts) {
  int64_t beside = 0, changes = 0;
  for (int32_t k = 0; k < picture.max_workers; ++k) {
    beside += memory.counts[k].beside;
    changes += memory.counts[k].changes;
  }
  ForShiftCells(memory, tile, [&](int32_t number, const Rect& cell, bool begins) {
    bool any = false;
    ForBand(memory, cell, [&](int32_t, int32_t, size_t) { any = true; });
    if (!any) return;
    const bool right =
        decides ? IsRight(memory, number, beside, changes) : memory.is_right[number] != 0;
    if (decides && begins) memory.is_right[number] = right ? 1 : 0;
    counts->wrong |= !right;
    if (!right) return;
    ForBand(memory, cell, [&](int32_t x, int32_t y, size_t at) {
      const bool inside =
          x >= tile.x && y >= tile.y && x < tile.x + tile.width && y < tile.y + tile.height;
      if (!inside || memory.side[at] == 0 || !picture.known(picture.data, x, y)) return;
      if ((memory.side[at] > 0) != (memory.distance[at] > 0)) memory.vote[at] = 0;
      memory.side[at] = 0;
    });
  });
}

// Runs a pass that reads `map` and writes `repaired`. If the map was hard, it is kept where it is
// right, which the first pass decides.
void RunPass(const OutlinePicture& picture, const OutlineMemory& memory, const OutlinePass& pass,
             bool was_hard, const int16_t* map, int16_t* repaired,
             const simd::DepthKernels& kernels, Sequence* run) {
  run->Run([&](int32_t index, int32_t worker) {
    MeasureDistances(memory, pass, map, picture.Tile(index), memory.scratch + worker);
  });
  run->Run([&](int32_t index, int32_t worker) {
    VoteByColour(picture, memory, pass, map, picture.Tile(index), kernels,
                 &memory.scratch[worker].block);
  });
  run->Run([&](int32_t index, int32_t) { ShiftOutlines(memory, pass, picture.Tile(index)); });
  run->Run([&](int32_t index, int32_t worker) {
    VoteAgain(picture, memory, pass, map, picture.Tile(index), kernels,
              &memory.scratch[worker].block);
    picture.keep(picture.data, index, memory.side);
  });
  if (was_hard) {
    const bool decides = map == memory.given;
    run->Run([&](int32_t index, int32_t worker) {
      CountChanges(memory, picture.Tile(index), memory.counts + worker);
    });
    run->Run([&](int32_t index, int32_t worker) {
      KeepRight(picture, memory, decides, picture.Tile(index), memory.counts + worker);
    });
  } else {
    run->Skip();
    run->Skip();
  }
  run->Run([&](int32_t index, int32_t worker) {
    const Rect tile = picture.Tile(index);
    TakeDisparities(memory, pass, map, tile, &memory.scratch[worker].sides, repaired);
  });
}

}  // namespace

OutlineMemory TakeOutlines(int32_t width, int32_t height, int32_t max_workers, Arena* arena) {
  const auto columns = static_cast<size_t>(width), rows = static_cast<size_t>(height);
  OutlineMemory memory = {};
  memory.width = width;
  memory.height = height;
  for (int16_t** plane : {&memory.given, &memory.repaired, &memory.middle}) {
    *plane = arena->Take<int16_t>(columns, rows);
  }
  for (int8_t** plane : {&memory.distance, &memory.vote, &memory.side}) {
    *plane = arena->Take<int8_t>(columns, rows);
  }
  const auto across = static_cast<size_t>(memory.Columns().Count());
  const auto down = static_cast<size_t>(memory.Rows().Count());
  memory.shift = arena->Take<int8_t>(across, down);
  memory.gain = arena->Take<uint8_t>(across, down);
  for (uint8_t** plane : {&memory.beside, &memory.displaced, &memory.is_right}) {
    *plane = arena->Take<uint8_t>(across, down);
  }
  memory.counts = arena->Take<OutlineCounts>(static_cast<size_t>(max_workers));
  memory.scratch = arena->Take<OutlineScratch>(static_cast<size_t>(max_workers));
  return memory;
}

const int16_t* FollowOutlines(const OutlinePicture& picture, const OutlineMemory& memory,
                              const simd::DepthKernels& kernels, Sequence* run) {
  std::fill_n(memory.counts, picture.max_workers, OutlineCounts{});
  run->Run([&](int32_t index, int32_t worker) {
    CountRamps(memory, picture.Tile(index), memory.scratch + worker, memory.counts + worker);
  });
  const OutlinePass pass = FirstPass(memory.counts, picture.max_workers);
  RunPass(picture, memory, pass, pass.IsHard(), memory.given, memory.repaired, kernels, run);
  bool again = false;
  for (int32_t k = 0; k < picture.max_workers; ++k) again |= memory.counts[k].wrong;
  if (again) {
    RunPass(picture, memory, kSecondPass, true, memory.repaired, memory.given, kernels, run);
    return memory.given;
  }
  for (int32_t k = 0; k < kPassPhases; ++k) run->Skip();
  return memory.repaired;
}

}  // namespace starfocus
