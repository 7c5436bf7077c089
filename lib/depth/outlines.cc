// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/outlines.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/outline_votes.h"

namespace starfocus {

namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Smallest step of an outline of a soft map. In hard maps, it is kSurfaceStep.
constexpr int32_t kLeastStep = 2 * kPixel;
// The distances of a tile depend on the outlines up to kMargin pixels around it.
constexpr int32_t kMargin = kMostBand + 2;
constexpr size_t kMostTall = kMostRegion + 2 * kMostOutlineRadius;
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

struct DistancePlanes {
  int32_t outlines[kMostRegion * kMostRegion];
  int16_t extremes[2][kMostTall * kMostRegion];  // lowest and highest disparities of windows
};

// Each phase uses one of these.
union OutlineScratch {
  DistancePlanes distances;
  VoteBlock block;
  SidePlanes sides;
};

namespace {

// Lowest and highest disparities of the windows of a row of pixels.
struct Extremes {
  int16_t *low, *high;

  // Joins each window with that of the same pixel of `other`, which may begin `shift` later.
  void Join(const Extremes& one, const Extremes& other, int32_t shift, int32_t count) const {
    for (int32_t k = 0; k < count; ++k) low[k] = std::min(one.low[k], other.low[k + shift]);
    for (int32_t k = 0; k < count; ++k) high[k] = std::max(one.high[k], other.high[k + shift]);
  }
};

// Calls join(size, shift) so that windows of one pixel become windows of `most` pixels: each window
// is joined with the one `shift` pixels later, which makes it `size` pixels long.
template <class Join>
void GrowWindows(int32_t most, const Join& join) {
  for (int32_t size = 1; size < most;) {
    const int32_t shift = Min(size, most - size);
    size += shift;
    join(size, shift);
  }
}

// Fills scratch->distances.extremes with the lowest and highest disparity in the window of each
// pixel of `rect`.
void FindExtremes(const OutlineMemory& memory, const int16_t* map, const Rect& rect, int32_t radius,
                  OutlineScratch* scratch) {
  const int32_t side = 2 * radius + 1, wide = rect.width + 2 * radius;
  const int32_t tall = rect.height + 2 * radius;
  const auto line = [&](int32_t y) {
    return Extremes{scratch->distances.extremes[0] + ptrdiff_t{y} * rect.width,
                    scratch->distances.extremes[1] + ptrdiff_t{y} * rect.width};
  };
  int16_t buffers[2][2][kMostTall];
  for (int32_t y = 0; y < tall; ++y) {
    Extremes from = {buffers[0][0], buffers[0][1]}, to = {buffers[1][0], buffers[1][1]};
    std::fill_n(from.low, wide, INT16_MAX);
    std::fill_n(from.high, wide, INT16_MIN);
    const int32_t row = rect.y - radius + y, left = rect.x - radius;
    if (row >= 0 && row < memory.height) {
      const int32_t first = Max(left, 0), end = Min(left + wide, memory.width);
      for (int16_t* plane : {from.low, from.high}) {
        std::copy_n(map + memory.At(first, row), end - first, plane + first - left);
      }
    }
    GrowWindows(side, [&](int32_t size, int32_t shift) {
      const Extremes out = size == side ? line(y) : to;
      out.Join(from, from, shift, wide - size + 1);
      std::swap(from, to);
    });
  }
  GrowWindows(side, [&](int32_t size, int32_t shift) {
    for (int32_t y = 0; y + size <= tall; ++y) {
      line(y).Join(line(y), line(y + shift), 0, rect.width);
    }
  });
}

// Returns the largest difference to a neighbour on the other side of `middle`, or 0.
int32_t StepAcross(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y,
                   int32_t middle) {
  const int16_t* own = map + memory.At(x, y);
  const bool near = *own > middle;
  int32_t step = 0;
  // The neighbours of pixels at the border are clamped to the picture.
  for (const int16_t* other :
       {x > 0 ? own - 1 : own, x + 1 < memory.width ? own + 1 : own,
        y > 0 ? own - memory.width : own, y + 1 < memory.height ? own + memory.width : own}) {
    if ((*other > middle) != near) step = Max(step, Abs(*other - *own));
  }
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

// Counts the widths of the map's ramps at the outlines of a tile, at every second pixel of each row
// and column, like the white fields of a chessboard. The width is the range of the
// window, divided by the largest step.
void CountRamps(const OutlineMemory& memory, const Rect& tile, OutlineScratch* scratch,
                OutlineCounts* counts) {
  const int16_t* map = memory.given;
  FindExtremes(memory, map, tile, kMostOutlineRadius, scratch);
  for (int32_t y = 0; y < tile.height; ++y) {
    for (int32_t x = 0; x < tile.width; ++x) {
      const int32_t column = tile.x + x, row = tile.y + y;
      // Counted from the nearest border, so that mirrored maps have mirrored fields.
      const int32_t field =
          Min(column, memory.width - 1 - column) + Min(row, memory.height - 1 - row);
      if (field % 2 != 0) continue;
      const int32_t k = y * tile.width + x,
                    range = scratch->distances.extremes[1][k] - scratch->distances.extremes[0][k];
      if (range <= kLeastStep) continue;
      const int32_t middle =
          (scratch->distances.extremes[1][k] + scratch->distances.extremes[0][k]) >> 1;
      const int32_t step = StepAcross(memory, map, column, row, middle);
      if (step == 0) continue;
      if (IsSlanted(memory, map, column, row, range, kMostOutlineRadius)) continue;
      ++counts->ramps[Min(kDistance * range / step, kRampCounts - 1)];
    }
  }
}

// Distances to outlines and the middles of their surfaces, in one number: of equally near outlines,
// the one with the nearer surfaces is the smaller number, so that mirrored maps have mirrored
// outlines.
constexpr int32_t kFar = 1 << 30, kDistanceBits = 16;
int32_t NumberOf(int32_t distance, int32_t middle) {
  return (distance << kDistanceBits) + (INT16_MAX - middle);
}
int32_t DistanceOf(int32_t number) { return number >> kDistanceBits; }
int32_t MiddleOf(int32_t number) { return INT16_MAX - (number & UINT16_MAX); }

// Returns the middle of the largest step between a pixel of a hard map and a neighbour, or
// INT32_MIN if there is no outline.
int32_t MiddleOfStep(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y) {
  const int32_t own = map[memory.At(x, y)];
  int32_t step = kSurfaceStep, middle = INT32_MIN;
  ForBeside(memory, map, x, y, [&](int32_t other, int32_t, int32_t) {
    const int32_t size = Abs(other - own), between = (own + other) >> 1;
    if (size < step || size <= kSurfaceStep) return;
    middle = size > step ? between : Max(middle, between);
    step = size;
  });
  return middle;
}

// Finds the pixels beside outlines in a region, and the middles of their two surfaces.
void FindCrossings(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                   const Rect& region, OutlineScratch* scratch) {
  if (!pass.IsHard()) FindExtremes(memory, map, region, pass.radius, scratch);
  for (int32_t y = 0; y < region.height; ++y) {
    for (int32_t x = 0; x < region.width; ++x) {
      const int32_t k = y * region.width + x, column = region.x + x, row = region.y + y;
      int32_t middle = INT32_MIN;
      if (pass.IsHard()) {
        middle = MiddleOfStep(memory, map, column, row);
      } else {
        const int32_t low = scratch->distances.extremes[0][k],
                      range = scratch->distances.extremes[1][k] - low;
        const int32_t between = low + (range >> 1);
        const bool crosses = range > kLeastStep &&
                             StepAcross(memory, map, column, row, between) > 0 &&
                             !IsSlanted(memory, map, column, row, range, pass.radius);
        if (crosses) middle = between;
      }
      scratch->distances.outlines[k] = middle == INT32_MIN ? kFar : NumberOf(kDistance / 2, middle);
    }
  }
}

// Extends distances and middles by a chamfer transform with steps of 1 and 1.5 pixels.
void ExtendDistances(const Rect& region, int32_t* outlines) {
  constexpr int32_t kStep = kDistance << kDistanceBits, kAcross = kStep * 3 / 2;
  const int32_t width = region.width;
  // Takes from a neighbouring row.
  const auto take = [&](int32_t* row, const int32_t* from) {
    const auto from_three = [&](int32_t x, int32_t left, int32_t right) {
      const int32_t beside = std::min(from[left], from[right]);
      row[x] = std::min(row[x], std::min(from[x] + kStep, beside + kAcross));
    };
    from_three(0, 0, Min(1, width - 1));
    for (int32_t x = 1; x + 1 < width; ++x) from_three(x, x - 1, x + 1);
    from_three(width - 1, Max(width - 2, 0), width - 1);
  };
  for (int32_t y = 0; y < region.height; ++y) {
    int32_t* row = outlines + ptrdiff_t{y} * width;
    if (y > 0) take(row, row - width);
    for (int32_t x = 1; x < width; ++x) row[x] = std::min(row[x], row[x - 1] + kStep);
  }
  for (int32_t y = region.height - 1; y >= 0; --y) {
    int32_t* row = outlines + ptrdiff_t{y} * width;
    if (y + 1 < region.height) take(row, row + width);
    for (int32_t x = width - 2; x >= 0; --x) row[x] = std::min(row[x], row[x + 1] + kStep);
  }
}

// Writes the middles and the signed distances of a tile.
void MeasureDistances(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                      const Rect& tile, OutlineScratch* scratch) {
  const Rect region = memory.Widened(tile, pass.band + 2);
  FindCrossings(memory, pass, map, region, scratch);
  ExtendDistances(region, scratch->distances.outlines);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    std::fill_n(memory.distance + memory.At(tile.x, y), tile.width, int8_t{0});
    std::fill_n(memory.side + memory.At(tile.x, y), tile.width, int8_t{0});
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const int32_t* own =
          scratch->distances.outlines + (y - region.y) * region.width + x - region.x;
      const int32_t to_outline = DistanceOf(*own), middle = MiddleOf(*own);
      if (to_outline > kDistance * pass.band + 2) continue;
      const size_t at = memory.At(x, y);
      const bool near = map[at] > middle;
      int32_t ridge = 1;
      ForBeside(memory, map, x, y, [&](int32_t other, int32_t dx, int32_t dy) {
        const bool farther = DistanceOf(own[dy * region.width + dx]) > to_outline;
        if (farther && (other > middle) == near) ridge = 0;
      });
      const int32_t distance = to_outline + ridge;
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
    if (!HasBand(memory, cell)) return;
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
             bool was_hard, const int16_t* map, int16_t* repaired, Sequence* run) {
  run->Run([&](int32_t index, int32_t worker) {
    MeasureDistances(memory, pass, map, picture.Tile(index), memory.scratch + worker);
  });
  run->Run([&](int32_t index, int32_t worker) {
    VoteByColour(picture, memory, pass, map, picture.Tile(index), &memory.scratch[worker].block);
  });
  run->Run([&](int32_t index, int32_t) { ShiftOutlines(memory, pass, picture.Tile(index)); });
  run->Run([&](int32_t index, int32_t worker) {
    VoteAgain(picture, memory, pass, map, picture.Tile(index), &memory.scratch[worker].block);
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
                              Sequence* run) {
  std::fill_n(memory.counts, picture.max_workers, OutlineCounts{});
  run->Run([&](int32_t index, int32_t worker) {
    CountRamps(memory, picture.Tile(index), memory.scratch + worker, memory.counts + worker);
  });
  const OutlinePass pass = FirstPass(memory.counts, picture.max_workers);
  RunPass(picture, memory, pass, pass.IsHard(), memory.given, memory.repaired, run);
  bool again = false;
  for (int32_t k = 0; k < picture.max_workers; ++k) again |= memory.counts[k].wrong;
  if (again) {
    RunPass(picture, memory, kSecondPass, true, memory.repaired, memory.given, run);
    return memory.given;
  }
  for (int32_t k = 0; k < kPassPhases; ++k) run->Skip();
  return memory.repaired;
}

}  // namespace starfocus
