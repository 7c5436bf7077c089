// SPDX-License-Identifier: Apache-2.0
// Disparities of the pixels of a band from their sides. Clean pixels, which lie on no ramp and keep
// their side, keep their disparity. It spreads to the other pixels of their side from neighbour to
// neighbour, so that the disparities of a surface are continuous.
#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/matting/outline_votes.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Largest vote and weight of a pixel outside the band.
constexpr int32_t kSure = 127;
// Pixels that are farther than half of the ramp plus kBesideRamp from the outline are clean, in
// 1/kDistance pixel.
constexpr int32_t kBesideRamp = 2 * kDistance;
// Largest difference to a neighbour on a clean pixel of a soft map (kDisparityBits).
constexpr int32_t kFlat = kPixel / 8;
constexpr int32_t kCrestRadius = 3;

// States of pixels: the lowest bit is the side, and the others are the round in which the pixel got
// its disparity, or one of these.
constexpr uint8_t kNearer = 1, kRound = 2, kNone = 0x7e, kOutside = 0xfe;

// Returns true if pixel (x, y) of the band belongs to the nearer side according to memory.side of
// the pixel and its neighbours.
bool IsNearer(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y) {
  static constexpr int32_t kWeights[3] = {1, 2, 1};
  const size_t own = memory.At(x, y);
  const int32_t middle = memory.middle[own];
  if (memory.side[own] == 0) return map[own] > middle;
  int32_t sum = 0;
  for (int32_t row = -1; row <= 1; ++row) {
    for (int32_t column = -1; column <= 1; ++column) {
      const size_t at =
          memory.At(Clamp(x + column, 0, memory.width - 1), Clamp(y + row, 0, memory.height - 1));
      const int32_t outside = map[at] > middle ? kSure : -kSure;
      const int32_t side = memory.distance[at] != 0 ? memory.side[at] : outside;
      sum += kWeights[column + 1] * kWeights[row + 1] * side;
    }
  }
  return sum > 0;
}

// Returns true if the disparities of the neighbours hardly differ from that of pixel (x, y).
bool IsFlat(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y) {
  const int16_t* own = map + memory.At(x, y);
  const ptrdiff_t width = memory.width;
  const auto differs = [&](ptrdiff_t by) { return Abs(own[by] - *own) > kFlat; };
  return !((x > 0 && differs(-1)) || (x + 1 < width && differs(1)) || (y > 0 && differs(-width)) ||
           (y + 1 < memory.height && differs(width)));
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

// A region with a margin of one pixel, whose pixels get their states and disparities.
struct Region {
  const OutlineMemory& memory;
  Rect rect;
  SidePlanes* planes;

  int32_t Stride() const { return rect.width + 2; }
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>((y - rect.y + 1) * Stride() + x - rect.x + 1);
  }
};

// Writes the states of the region, the disparities of clean pixels, and the list of the others.
// Returns their number.
size_t FindClean(const Region& region, const OutlinePass& pass, const int16_t* map) {
  const OutlineMemory& memory = region.memory;
  SidePlanes& planes = *region.planes;
  const int32_t end = kDistance * pass.band - 2;
  const int32_t clean = pass.IsHard() ? 0 : Min(pass.ramp / 2 + kBesideRamp, end);
  std::fill_n(planes.state, region.Stride() * (region.rect.height + 2), kOutside);
  size_t count = 0;
  for (int32_t y = region.rect.y; y < region.rect.y + region.rect.height; ++y) {
    for (int32_t x = region.rect.x; x < region.rect.x + region.rect.width; ++x) {
      const size_t from = memory.At(x, y), to = region.At(x, y);
      const int32_t distance = memory.distance[from];
      planes.disparity[to] = map[from];
      planes.state[to] = 0;
      if (distance == 0) {
        if (!pass.IsHard() && !IsFlat(memory, map, x, y)) planes.state[to] = kOutside;
        continue;
      }
      const bool near = IsNearer(memory, map, x, y), was_near = map[from] > memory.middle[from];
      const bool keeps = near == was_near && Abs(distance) >= clean &&
                         (pass.IsHard() || IsFlat(memory, map, x, y));
      planes.state[to] = static_cast<uint8_t>((keeps ? 0 : kNone) + (near ? kNearer : 0));
      if (!keeps && memory.side[from] != 0) planes.pending[count++] = static_cast<int32_t>(from);
    }
  }
  return count;
}

// Takes the mean disparity of the neighbours of the same side that have had theirs before `round`.
// Neighbours that are more than a pixel of disparity from the clearest one, such as a second near
// surface, are left out. Returns false if no neighbour has a disparity of this side.
bool TakeFromNeighbours(const Region& region, int32_t middle, int32_t at, int32_t round) {
  SidePlanes& planes = *region.planes;
  const bool near = (planes.state[at] & kNearer) != 0;
  int32_t found[8], count = 0, extreme = near ? INT16_MIN : INT16_MAX;
  for (int32_t row = -1; row <= 1; ++row) {
    for (int32_t column = -1; column <= 1; ++column) {
      const int32_t other = at + row * region.Stride() + column;
      if (planes.state[other] / kRound >= round) continue;
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

}  // namespace

void TakeDisparities(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                     const Rect& tile, SidePlanes* planes, int16_t* repaired) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    std::copy_n(map + memory.At(tile.x, y), tile.width, repaired + memory.At(tile.x, y));
  }
  const int32_t rounds = 2 * pass.band + 2;
  const Region region = {memory, memory.Widened(tile, rounds), planes};
  size_t pending = FindClean(region, pass, map);
  const auto visit = [&](const auto& act) {
    size_t left = 0;
    for (size_t k = 0; k < pending; ++k) {
      const int32_t from = planes->pending[k];
      const int32_t x = from % memory.width, y = from / memory.width;
      if (!act(x, y, static_cast<size_t>(from), region.At(x, y))) planes->pending[left++] = from;
    }
    pending = left;
  };
  for (int32_t round = 1; round <= rounds && pending > 0; ++round) {
    visit([&](int32_t, int32_t, size_t from, size_t at) {
      if (!TakeFromNeighbours(region, memory.middle[from], static_cast<int32_t>(at), round)) {
        return false;
      }
      planes->state[at] = static_cast<uint8_t>(round * kRound + (planes->state[at] & kNearer));
      return true;
    });
  }
  visit([&](int32_t x, int32_t y, size_t, size_t at) {
    planes->disparity[at] = CrestOf(memory, map, x, y, (planes->state[at] & kNearer) != 0);
    return true;
  });
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = memory.At(x, y);
      if (memory.side[at] != 0 && memory.distance[at] != 0)
        repaired[at] = planes->disparity[region.At(x, y)];
    }
  }
}

}  // namespace starfocus
