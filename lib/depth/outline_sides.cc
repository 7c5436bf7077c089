// SPDX-License-Identifier: Apache-2.0
// Disparities of the pixels of a band from their sides. Clean pixels, which lie on no ramp and keep
// their side, keep their disparity. It spreads to the other pixels of their side from neighbour to
// neighbour, so that the disparities of a surface are continuous.
#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/outline_votes.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Pixels that are farther than half of the ramp plus kBesideRamp from the outline are clean, in
// 1/kDistance pixel.
constexpr int32_t kBesideRamp = 2 * kDistance;
// Largest difference to a neighbour on a clean pixel of a soft and of a hard map (kDisparityBits).
constexpr int32_t kFlat = kPixel / 8, kRampStep = kPixel / 2;
constexpr int32_t kCrestRadius = 3;
// Round from which the crests of thin structures and the grounds of gaps are clean.
constexpr int32_t kFlatRounds = 12;

// States of pixels: the lowest bit is the side, and the others are the round in which the pixel got
// its disparity, or one of these.
constexpr uint8_t kNearer = 1, kRound = 2, kNone = 0x7e, kOutside = 0xfe;

// Returns true if pixel (x, y) of the band belongs to the nearer side according to memory.side of
// the pixel and its neighbours.
bool IsNearer(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y) {
  const size_t own = memory.At(x, y);
  const auto row = [&](int32_t by) {
    const int8_t* side = memory.side + memory.At(x, Clamp(y + by, 0, memory.height - 1));
    return side[x > 0 ? -1 : 0] + 2 * side[0] + side[x + 1 < memory.width ? 1 : 0];
  };
  const int32_t sum = memory.side[own] == 0 ? 0 : row(-1) + 2 * row(0) + row(1);
  return sum == 0 ? map[own] > memory.middle[own] : sum > 0;
}

// Returns true if the disparities of the neighbours hardly differ from that of pixel (x, y).
bool IsFlat(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y) {
  const int16_t* own = map + memory.At(x, y);
  const ptrdiff_t width = memory.width;
  const auto differs = [&](ptrdiff_t by) { return Abs(own[by] - *own) > kFlat; };
  return !((x > 0 && differs(-1)) || (x + 1 < width && differs(1)) || (y > 0 && differs(-width)) ||
           (y + 1 < memory.height && differs(width)));
}

// Returns true if a neighbour on the same side is so much farther from the middle that pixel (x, y)
// of the band lies on a ramp: by more than `step`.
bool IsOnRamp(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y, int32_t step) {
  const size_t at = memory.At(x, y);
  const int32_t middle = memory.middle[at], own = map[at] - middle;
  bool found = false;
  ForBeside(memory, map, x, y, [&](int32_t other, int32_t, int32_t) {
    const int32_t beyond = own > 0 ? other - middle - own : own - (other - middle);
    found |= beyond > step;
  });
  return found;
}

// Returns the disparity of the crest of a thin structure, or of the ground of a gap: the extreme of
// the side of pixel (x, y) within kCrestRadius.
int16_t CrestOf(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y, bool near) {
  const size_t own = memory.At(x, y);
  const int32_t middle = memory.middle[own];
  const Rect around = memory.Widened({x, y, 1, 1}, kCrestRadius);
  int16_t extreme = map[own];
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const int16_t other = map[memory.At(column, row)];
      if ((other > middle) != near) continue;
      const bool takes = (extreme > middle) != near || (near ? other > extreme : other < extreme);
      if (takes) extreme = other;
    }
  }
  return extreme;
}

bool Contains(const Rect& rect, int32_t x, int32_t y) {
  return x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
}

// A region with a margin of one pixel, whose pixels get their states and disparities.
struct Region {
  const OutlineMemory& memory;
  Rect rect;
  SidePlanes* planes;

  int32_t Stride() const { return rect.width + 2; }
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>((y - rect.y + 1) * Stride() + x - rect.x + 1);
  }
  int32_t XOf(int32_t at) const { return at % Stride() + rect.x - 1; }
  int32_t YOf(int32_t at) const { return at / Stride() + rect.y - 1; }
};

// Bit of SidePlanes::ready for a round.
uint8_t Bit(int32_t round) { return static_cast<uint8_t>(1 << (round & 1)); }

// Writes the states of the region, the disparities of clean pixels, and the list of the others.
// Returns their number. Clean pixels outside the band are found only beside it.
size_t FindClean(const Region& region, const OutlinePass& pass, const int16_t* map) {
  const OutlineMemory& memory = region.memory;
  SidePlanes& planes = *region.planes;
  const int32_t end = kDistance * pass.band - 2;
  const int32_t clean = pass.IsHard() ? 0 : Min(pass.ramp / 2 + kBesideRamp, end);
  std::fill_n(planes.state, region.Stride() * (region.rect.height + 2), kOutside);
  size_t count = 0;
  ForBand(memory, region.rect, [&](int32_t x, int32_t y, size_t from) {
    const size_t to = region.At(x, y);
    const int32_t distance = Abs(memory.distance[from]);
    const bool near = IsNearer(memory, map, x, y), was_near = map[from] > memory.middle[from];
    const bool keeps =
        near == was_near && distance >= clean &&
        (pass.IsHard() ? !IsOnRamp(memory, map, x, y, kRampStep) : IsFlat(memory, map, x, y));
    planes.disparity[to] = map[from];
    planes.state[to] = static_cast<uint8_t>((keeps ? 0 : kNone) + (near ? kNearer : 0));
    if (!keeps && memory.side[from] != 0) {
      planes.ready[to] = Bit(1);
      planes.pending[count++] = static_cast<int32_t>(to);
    }
    if (distance < end - kDistance) return;
    const Rect around = memory.Widened({x, y, 1, 1}, 1);
    for (int32_t v = around.y; v < around.y + around.height; ++v) {
      for (int32_t u = around.x; u < around.x + around.width; ++u) {
        if (memory.distance[memory.At(u, v)] != 0 || !Contains(region.rect, u, v)) continue;
        if (!pass.IsHard() && !IsFlat(memory, map, u, v)) continue;
        planes.disparity[region.At(u, v)] = map[memory.At(u, v)];
        planes.state[region.At(u, v)] = 0;
      }
    }
  });
  return count;
}

// Takes the mean disparity of the neighbours of the same side that have had theirs before `round`.
// Neighbours that are more than a pixel of disparity from the clearest one, such as a second near
// surface, are left out. Returns false if no neighbour has a disparity of this side.
bool TakeFromNeighbours(const Region& region, int32_t middle, int32_t at, int32_t round) {
  SidePlanes& planes = *region.planes;
  const int32_t end = round * kRound;
  const bool near = (planes.state[at] & kNearer) != 0;
  int32_t found[8], count = 0, extreme = near ? INT16_MIN : INT16_MAX;
  for (int32_t row = -1; row <= 1; ++row) {
    for (int32_t column = -1; column <= 1; ++column) {
      const int32_t other = at + row * region.Stride() + column;
      if (planes.state[other] >= end) continue;
      const int32_t disparity = planes.disparity[other];
      if ((disparity > middle) != near) continue;
      found[count++] = disparity;
      extreme = near ? Max(extreme, disparity) : Min(extreme, disparity);
    }
  }
  if (count == 0) return false;
  int32_t sum = 0, number = 0;
  for (int32_t k = 0; k < count; ++k) {
    if (Abs(found[k] - extreme) > kPixel) continue;
    sum += found[k];
    ++number;
  }
  planes.disparity[at] =
      static_cast<int16_t>((2 * sum + (sum < 0 ? -number : number)) / (2 * number));
  return true;
}

// Lets pending pixels on the crests of thin structures, or on the ground of gaps, keep their
// disparity, and the others try again. Returns the number of pixels that remain.
size_t FindCrests(const Region& region, const int16_t* map, size_t pending, int32_t round) {
  SidePlanes& planes = *region.planes;
  size_t left = 0;
  for (size_t k = 0; k < pending; ++k) {
    const int32_t at = planes.pending[k], x = region.XOf(at), y = region.YOf(at);
    const size_t from = region.memory.At(x, y);
    const bool near = (planes.state[at] & kNearer) != 0;
    planes.ready[at] = Bit(round);
    if ((map[from] > region.memory.middle[from]) == near &&
        !IsOnRamp(region.memory, map, x, y, 0)) {
      planes.state[at] = near ? kNearer : 0;
    } else {
      planes.pending[left++] = at;
    }
  }
  return left;
}

}  // namespace

void TakeDisparities(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                     const Rect& tile, SidePlanes* planes, int16_t* repaired) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    std::copy_n(map + memory.At(tile.x, y), tile.width, repaired + memory.At(tile.x, y));
  }
  const int32_t rounds = 2 * pass.band + 2;
  const Region region = {memory, memory.Widened(tile, rounds), planes};
  size_t pending = FindClean(region, pass, map);
  const auto write = [&](int32_t at, int32_t x, int32_t y) {
    if (Contains(tile, x, y)) repaired[memory.At(x, y)] = planes->disparity[at];
  };
  for (int32_t round = 1; round <= rounds && pending > 0; ++round) {
    if (round == kFlatRounds) pending = FindCrests(region, map, pending, round);
    size_t left = 0;
    for (size_t k = 0; k < pending; ++k) {
      const int32_t at = planes->pending[k];
      planes->pending[left++] = at;
      if ((planes->ready[at] & Bit(round)) == 0) continue;
      planes->ready[at] &= static_cast<uint8_t>(~Bit(round));
      const int32_t x = region.XOf(at), y = region.YOf(at);
      if (!TakeFromNeighbours(region, memory.middle[memory.At(x, y)], at, round)) continue;
      --left;
      write(at, x, y);
      planes->state[at] = static_cast<uint8_t>(round * kRound + (planes->state[at] & kNearer));
      for (int32_t row = -1; row <= 1; ++row) {
        uint8_t* ready = planes->ready + at + row * region.Stride();
        for (int32_t column = -1; column <= 1; ++column) ready[column] |= Bit(round + 1);
      }
    }
    pending = left;
  }
  for (size_t k = 0; k < pending; ++k) {
    const int32_t at = planes->pending[k], x = region.XOf(at), y = region.YOf(at);
    planes->disparity[at] = CrestOf(memory, map, x, y, (planes->state[at] & kNearer) != 0);
    write(at, x, y);
  }
}

}  // namespace starfocus
