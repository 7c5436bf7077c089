// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/outlines.h"

#include <algorithm>
#include <cmath>

#include "lib/depth/maps.h"
#include "lib/io/image.h"

namespace starfocus {

namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Smallest step of an outline of a soft map. In hard maps, it is kSurfaceStep.
constexpr int32_t kLeastStep = 2 * kPixel;
// Percentage of the pixels next to the outlines of a hard map that change their side, from which
// the map is assumed to be wrong. In exact maps it is 3 to 10, and 17 among wires with few colours;
// in wrong maps 21 to 50.
constexpr int64_t kWrongPercent = 18;
// A part of a right map is wrong if the outline is displaced: from kDisplacedPercent of the pixels
// next to outlines, within kRightRadius patches, change their side in the direction of the shift of
// their patch. In exact maps it is at most 11 of 97 % of all patches; in displaced maps about 45.
constexpr int64_t kDisplacedPercent = 35;
constexpr int32_t kRightRadius = 8;

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

// Writes to `out` the reduction by `join` of the window around each pixel of `rect`. Pixels outside
// the picture count as `outside`. `out` also has rows for the windows' pixels below `rect`.
template <class Join>
void JoinWindows(const OutlinePass& pass, const Rect& rect, int32_t radius, int16_t outside,
                 const Join& join, int16_t* out) {
  const Rect all = Extended(rect, {radius, radius, radius, radius});
  const Rect inside = Clipped(all, pass.setup->width, pass.setup->height);
  const int32_t side = 2 * radius + 1;
  const auto line = [&](int32_t y) { return out + ptrdiff_t{y} * rect.width; };
  for (int32_t y = 0; y < all.height; ++y) {
    int16_t buffers[2][kMostWidened + 2 * kMostOutlineRadius];
    int16_t *from = buffers[0], *to = buffers[1];
    std::fill_n(from, all.width, outside);
    if (Contains(inside, inside.x, all.y + y)) {
      std::copy_n(pass.map + pass.At(inside.x, all.y + y), inside.width, from + inside.x - all.x);
    }
    GrowWindows(side, [&](int32_t size, int32_t shift) {
      if (size == side) to = line(y);
      for (int32_t k = 0; k + size <= all.width; ++k) to[k] = join(from[k], from[k + shift]);
      std::swap(from, to);
    });
  }
  GrowWindows(side, [&](int32_t size, int32_t shift) {
    for (int32_t y = 0; y + size <= all.height; ++y) {
      for (int32_t k = 0; k < rect.width; ++k) line(y)[k] = join(line(y)[k], line(y + shift)[k]);
    }
  });
}

// Finds the lowest and highest disparity in the window of each pixel of `rect`.
void FindExtremes(const OutlinePass& pass, const Rect& rect, int32_t radius,
                  OutlineScratch* scratch) {
  const auto least = [](int16_t a, int16_t b) { return std::min(a, b); };
  const auto most = [](int16_t a, int16_t b) { return std::max(a, b); };
  JoinWindows(pass, rect, radius, INT16_MAX, least, scratch->distances.low);
  JoinWindows(pass, rect, radius, INT16_MIN, most, scratch->distances.high);
}

// Returns the largest difference to a neighbour on the other side of `middle`, or 0.
int32_t StepAcross(const OutlinePass& pass, int32_t x, int32_t y, int32_t middle) {
  const int32_t own = pass.map[pass.At(x, y)];
  int32_t step = 0;
  ForBeside(pass, x, y, [&](int32_t other, int32_t, int32_t) {
    if ((other > middle) != (own > middle)) step = Max(step, Abs(other - own));
  });
  return step;
}

// Returns true if the map around a pixel is hardly steeper than a plane with the range of the
// window.
bool IsSlanted(const OutlinePass& pass, int32_t x, int32_t y, int32_t range, int32_t radius) {
  int32_t low = INT16_MAX, high = INT16_MIN;
  ForPixels(Widened(*pass.setup, {x, y, 1, 1}, 2), [&](int32_t column, int32_t row) {
    low = Min(low, pass.map[pass.At(column, row)]);
    high = Max(high, pass.map[pass.At(column, row)]);
  });
  return (high - low) * 5 * radius <= 12 * range;
}

// Counts the widths of the map's ramps at the outlines of a tile, at every second pixel of each row
// and column, like the white fields of a chessboard. The width is the range of the
// window, divided by the largest step.
void CountRamps(const OutlinePass& pass, const Rect& tile, OutlineScratch* scratch,
                OutlineCounts* counts) {
  FindExtremes(pass, tile, kMostOutlineRadius, scratch);
  const int16_t *low = scratch->distances.low, *high = scratch->distances.high;
  ForPixels(tile, [&](int32_t x, int32_t y) {
    const int32_t least = *low++, range = *high++ - least;
    // Counted from the nearest border, so that mirrored maps have mirrored fields.
    const int32_t field = Min(x, pass.setup->width - 1 - x) + Min(y, pass.setup->height - 1 - y);
    if (field % 2 != 0 || range <= kLeastStep) return;
    const int32_t step = StepAcross(pass, x, y, least + (range >> 1));
    if (step == 0 || IsSlanted(pass, x, y, range, kMostOutlineRadius)) return;
    ++counts->ramps[Min(kDistance * range / step, kRampCounts - 1)];
  });
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
int32_t MiddleOfStep(const OutlinePass& pass, int32_t x, int32_t y) {
  const int32_t own = pass.map[pass.At(x, y)];
  int32_t step = kSurfaceStep, middle = INT32_MIN;
  ForBeside(pass, x, y, [&](int32_t other, int32_t, int32_t) {
    const int32_t size = Abs(other - own), between = (own + other) >> 1;
    if (size < step || size <= kSurfaceStep) return;
    middle = size > step ? between : Max(middle, between);
    step = size;
  });
  return middle;
}

// Finds the pixels beside outlines in a rectangle, and the middles of their two surfaces.
void FindCrossings(const OutlinePass& pass, const Rect& widened, OutlineScratch* scratch) {
  int32_t* out = scratch->distances.outlines;
  const auto write = [&](int32_t middle) {
    *out++ = middle == INT32_MIN ? kFar : NumberOf(kDistance / 2, middle);
  };
  if (pass.IsHard()) {
    ForPixels(widened, [&](int32_t x, int32_t y) { write(MiddleOfStep(pass, x, y)); });
    return;
  }
  FindExtremes(pass, widened, pass.radius, scratch);
  const int16_t *low = scratch->distances.low, *high = scratch->distances.high;
  ForPixels(widened, [&](int32_t x, int32_t y) {
    const int32_t least = *low++, range = *high++ - least, middle = least + (range >> 1);
    const bool crosses = range > kLeastStep && StepAcross(pass, x, y, middle) > 0 &&
                         !IsSlanted(pass, x, y, range, pass.radius);
    write(crosses ? middle : INT32_MIN);
  });
}

// Extends distances and middles by a chamfer transform with steps of 1 and 1.5 pixels.
void ExtendDistances(const Rect& widened, int32_t* outlines) {
  constexpr int32_t kStep = kDistance << kDistanceBits, kAcross = kStep * 3 / 2;
  const int32_t width = widened.width;
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
  for (int32_t y = 0; y < widened.height; ++y) {
    int32_t* row = outlines + ptrdiff_t{y} * width;
    if (y > 0) take(row, row - width);
    for (int32_t x = 1; x < width; ++x) row[x] = std::min(row[x], row[x - 1] + kStep);
  }
  for (int32_t y = widened.height - 1; y >= 0; --y) {
    int32_t* row = outlines + ptrdiff_t{y} * width;
    if (y + 1 < widened.height) take(row, row + width);
    for (int32_t x = width - 2; x >= 0; --x) row[x] = std::min(row[x], row[x + 1] + kStep);
  }
}

// Writes the middles and the signed distances of a tile.
void MeasureDistances(const OutlinePass& pass, const Rect& tile, OutlineScratch* scratch) {
  const Rect widened = Widened(*pass.setup, tile, pass.band + 2);
  FindCrossings(pass, widened, scratch);
  ExtendDistances(widened, scratch->distances.outlines);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    std::fill_n(pass.distance + pass.At(tile.x, y), tile.width, int8_t{0});
    std::fill_n(pass.side + pass.At(tile.x, y), tile.width, int8_t{0});
    const int32_t* own =
        scratch->distances.outlines + (y - widened.y) * widened.width + tile.x - widened.x;
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x, ++own) {
      const int32_t to_outline = DistanceOf(*own), middle = MiddleOf(*own);
      if (to_outline > kDistance * pass.band + 2) continue;
      const size_t at = pass.At(x, y);
      const bool near = pass.map[at] > middle;
      int32_t ridge = 1;
      ForBeside(pass, x, y, [&](int32_t other, int32_t dx, int32_t dy) {
        const bool farther = DistanceOf(own[dy * widened.width + dx]) > to_outline;
        if (farther && (other > middle) == near) ridge = 0;
      });
      const int32_t distance = to_outline + ridge;
      pass.middle[at] = static_cast<int16_t>(middle);
      pass.distance[at] = static_cast<int8_t>(near ? distance : -distance);
    }
  }
}

// Sets the widths of the first pass from the widths of the ramps that all workers have counted. The
// width of the band follows from the median.
void SetWidths(OutlinePass* pass) {
  uint32_t ramps[kRampCounts] = {}, total = 0, below = 0;
  for (int32_t ramp = 0; ramp < kRampCounts; ++ramp) {
    for (int32_t k = 0; k < pass->workers; ++k) ramps[ramp] += pass->counts[k].ramps[ramp];
    total += ramps[ramp];
  }
  for (int32_t ramp = 0; ramp < kRampCounts && 2 * below < total; ++ramp) {
    below += ramps[ramp];
    pass->ramp = ramp;
  }
  if (pass->IsHard()) return;
  pass->radius = Clamp(pass->ramp / (2 * kDistance) + 3, 4, kMostOutlineRadius);
  pass->band = Clamp((13 * pass->ramp + 10 * kDistance) / (10 * kDistance), 5, kMostBand);
  pass->trusted = 4;
  pass->clear = 51;
}

constexpr int32_t kPassPhases = 7;

// Counts the pixels next to the outlines in the patches of a tile, and those that change their
// side.
void CountChanges(const OutlinePass& pass, const Rect& tile, OutlineCounts* counts) {
  ForShiftPatches(pass, tile, [&](int32_t number, const Rect& patch, bool begins) {
    if (!begins) return;
    uint8_t beside = 0, displaced = 0;
    ForBand(pass, patch, [&](int32_t, int32_t, size_t at) {
      if (pass.side[at] == 0 || Abs(pass.distance[at]) >= kDistance) return;
      ++beside;
      if ((pass.side[at] > 0) == (pass.distance[at] > 0)) return;
      ++counts->changes;
      if (pass.shift[number] * pass.side[at] > 0) ++displaced;
    });
    pass.beside[number] = beside;
    pass.displaced[number] = displaced;
    counts->beside += beside;
  });
}

// Returns true if few pixels around a patch would change their side. The map has `changes` changes
// in `beside` pixels.
bool IsRight(const OutlineMemory& memory, int32_t number, int64_t beside, int64_t changes) {
  const int32_t columns = memory.Columns().Count(), rows = memory.Rows().Count();
  const int32_t column = number % columns, row = number / columns;
  int64_t near_beside = 0, near_displaced = 0;
  for (int32_t v = row - kRightRadius; v <= row + kRightRadius; v += 2) {
    for (int32_t u = column - kRightRadius; u <= column + kRightRadius; u += 2) {
      if (u < 0 || v < 0 || u >= columns || v >= rows) continue;
      near_beside += memory.beside[v * columns + u];
      near_displaced += memory.displaced[v * columns + u];
    }
  }
  return 100 * changes < kWrongPercent * beside &&
         100 * near_displaced < kDisplacedPercent * near_beside;
}

// Keeps the known disparities of a tile where the map is right. The first pass writes
// pass.is_right.
void KeepRight(const OutlinePass& pass, const starfocus_light_field& light_field, const Rect& tile,
               OutlineCounts* counts) {
  const bool decides = pass.map == pass.given;
  int64_t beside = 0, changes = 0;
  for (int32_t k = 0; k < pass.workers; ++k) {
    beside += pass.counts[k].beside;
    changes += pass.counts[k].changes;
  }
  ForShiftPatches(pass, tile, [&](int32_t number, const Rect& patch, bool begins) {
    const bool has_band = HasBand(pass, patch);
    const bool right =
        has_band && (decides ? IsRight(pass, number, beside, changes) : pass.is_right[number] != 0);
    // The first pass may move an outline into a patch that had none. There, it is not right.
    if (decides && begins) pass.is_right[number] = right ? 1 : 0;
    counts->wrong |= has_band && !right;
    if (!right) return;
    ForBand(pass, patch, [&](int32_t x, int32_t y, size_t at) {
      if (!Contains(tile, x, y) || pass.side[at] == 0) return;
      if (!std::isfinite(GivenAt(light_field, y)[x])) return;
      if ((pass.side[at] > 0) != (pass.distance[at] > 0)) pass.vote[at] = 0;
      pass.side[at] = 0;
    });
  });
}

// Sets pass.side to 0 in the patches of a tile that have thin structure or hair.
void KeepParts(const OutlinePass& pass, const ThinPatches& thin, const HairMemory* hair,
               int32_t index) {
  ForPatches(thin, index, [&](const Rect& patch, int32_t number) {
    if (thin.thin[number] == 0 && (hair == nullptr || !HasHair(*hair, patch))) return;
    for (int32_t y = patch.y; y < patch.y + patch.height; ++y) {
      std::fill_n(pass.side + pass.At(patch.x, y), patch.width, int8_t{0});
    }
  });
}

}  // namespace

OutlineMemory TakeOutlines(const SweepSetup& setup, int32_t max_workers, Arena* arena) {
  const size_t pixels = setup.At(0, setup.height);
  OutlineMemory memory = {};
  memory.setup = &setup;
  memory.workers = max_workers;
  for (int16_t** plane : {&memory.given, &memory.repaired, &memory.middle}) {
    *plane = arena->Take<int16_t>(pixels);
  }
  for (int8_t** plane : {&memory.distance, &memory.vote, &memory.side}) {
    *plane = arena->Take<int8_t>(pixels);
  }
  const int32_t patches = memory.Columns().Count() * memory.Rows().Count();
  memory.shift = arena->Take<int8_t>(static_cast<size_t>(patches));
  for (uint8_t** plane : {&memory.gain, &memory.beside, &memory.displaced, &memory.is_right}) {
    *plane = arena->Take<uint8_t>(static_cast<size_t>(patches));
  }
  memory.counts = arena->Take<OutlineCounts>(static_cast<size_t>(max_workers));
  memory.scratch = arena->Take<OutlineScratch>(static_cast<size_t>(max_workers));
  return memory;
}

const int16_t* FollowOutlines(const starfocus_light_field& light_field,
                              const simd::DepthKernels& kernels, const ThinPatches& thin,
                              const HairMemory* hair, const OutlineMemory& memory, Sequence* run) {
  // Calls work(tile, worker, index) for each tile.
  const auto phase = [&](const auto& work) {
    run->Run(
        [&](int32_t index, int32_t worker) { work(TileOf(*memory.setup, index), worker, index); });
  };
  // If the map was hard, it is kept where it is right.
  const auto run_pass = [&](const OutlinePass& pass, bool was_hard) {
    phase([&](const Rect& tile, int32_t worker, int32_t) {
      MeasureDistances(pass, tile, pass.scratch + worker);
    });
    phase([&](const Rect& tile, int32_t worker, int32_t) {
      VoteByColour(pass, tile, &pass.scratch[worker].block);
    });
    phase([&](const Rect& tile, int32_t, int32_t) { ShiftOutlines(pass, tile); });
    phase([&](const Rect& tile, int32_t worker, int32_t index) {
      VoteAgain(pass, tile, &pass.scratch[worker].block);
      KeepParts(pass, thin, hair, index);
    });
    if (was_hard) {
      phase([&](const Rect& tile, int32_t worker, int32_t) {
        CountChanges(pass, tile, pass.counts + worker);
      });
      phase([&](const Rect& tile, int32_t worker, int32_t) {
        KeepRight(pass, light_field, tile, pass.counts + worker);
      });
    } else {
      run->Skip();
      run->Skip();
    }
    phase([&](const Rect& tile, int32_t worker, int32_t) {
      WriteResult(pass, tile, &pass.scratch[worker].sides);
    });
  };
  std::fill_n(memory.counts, memory.workers, OutlineCounts{});
  OutlinePass pass = {memory,
                      RowsOf(light_field.views[0]),
                      &kernels,
                      memory.given,
                      memory.repaired,
                      kDistance,
                      0,
                      6,
                      5,
                      60};
  phase([&](const Rect& tile, int32_t worker, int32_t) {
    CountRamps(pass, tile, pass.scratch + worker, pass.counts + worker);
  });
  SetWidths(&pass);
  run_pass(pass, pass.IsHard());
  bool again = false;
  for (int32_t k = 0; k < memory.workers; ++k) again |= memory.counts[k].wrong;
  if (again) {
    // The edges of the result of the first pass are steps that are hardly off. In soft maps, a
    // second pass hardly improves results, and leaves more single pixels.
    run_pass({memory, pass.rgb, &kernels, memory.repaired, memory.given, kDistance, 0, 3, 5, 8},
             true);
    return memory.given;
  }
  for (int32_t k = 0; k < kPassPhases; ++k) run->Skip();
  return memory.repaired;
}

}  // namespace starfocus
