// SPDX-License-Identifier: Apache-2.0
// Disparities of the pixels of a band from their sides. Clean pixels, which lie on no ramp and keep
// their side, keep their disparity. It spreads to the other pixels of their side from neighbour to
// neighbour, so that the disparities of a surface are continuous.
#include <algorithm>

#include "lib/depth/outlines.h"

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

// Returns true if pixel (x, y) of the band belongs to the nearer side according to pass.side of the
// pixel and its neighbours.
bool IsNearer(const OutlinePass& pass, int32_t x, int32_t y) {
  const size_t own = pass.At(x, y);
  const auto row = [&](int32_t by) {
    const int8_t* side = pass.side + pass.At(x, Clamp(y + by, 0, pass.setup->height - 1));
    return side[x > 0 ? -1 : 0] + 2 * side[0] + side[x + 1 < pass.setup->width ? 1 : 0];
  };
  const int32_t sum = pass.side[own] == 0 ? 0 : row(-1) + 2 * row(0) + row(1);
  return sum == 0 ? pass.map[own] > pass.middle[own] : sum > 0;
}

// Returns true if the disparities of the neighbours hardly differ from that of pixel (x, y).
bool IsFlat(const OutlinePass& pass, int32_t x, int32_t y) {
  const int32_t own = pass.map[pass.At(x, y)];
  bool flat = true;
  ForBeside(pass, x, y,
            [&](int32_t other, int32_t, int32_t) { flat = flat && Abs(other - own) <= kFlat; });
  return flat;
}

// Returns true if a neighbour on the same side is so much farther from the middle that pixel (x, y)
// of the band lies on a ramp: by more than `step`.
bool IsOnRamp(const OutlinePass& pass, int32_t x, int32_t y, int32_t step) {
  const size_t at = pass.At(x, y);
  const int32_t own = pass.map[at], sign = own > pass.middle[at] ? 1 : -1;
  bool found = false;
  ForBeside(pass, x, y,
            [&](int32_t other, int32_t, int32_t) { found |= sign * (other - own) > step; });
  return found;
}

// Returns the disparity of the crest of a thin structure, or of the ground of a gap: the extreme of
// the side of pixel (x, y) within kCrestRadius.
int16_t CrestOf(const OutlinePass& pass, int32_t x, int32_t y, bool near) {
  const size_t own = pass.At(x, y);
  const int32_t middle = pass.middle[own];
  int16_t extreme = pass.map[own];
  ForPixels(Widened(*pass.setup, {x, y, 1, 1}, kCrestRadius), [&](int32_t column, int32_t row) {
    const int16_t other = pass.map[pass.At(column, row)];
    if ((other > middle) != near) return;
    const bool takes = (extreme > middle) != near || (near ? other > extreme : other < extreme);
    if (takes) extreme = other;
  });
  return extreme;
}

// Bit of SidePlanes::ready for a round.
uint8_t Bit(int32_t round) { return static_cast<uint8_t>(1 << (round & 1)); }

// Writes the states of the region, the disparities of clean pixels, and the list of the others.
// Returns their number. Clean pixels outside the band are found only beside it.
size_t FindClean(const OutlinePass& pass, SidePlanes* planes) {
  const Rect region = planes->region;
  const int32_t end = kDistance * pass.band - 2;
  const int32_t clean = pass.IsHard() ? 0 : Min(pass.ramp / 2 + kBesideRamp, end);
  std::fill_n(planes->state, planes->Stride() * (region.height + 2), kOutside);
  size_t count = 0;
  ForBand(pass, region, [&](int32_t x, int32_t y, size_t from) {
    const size_t to = planes->At(x, y);
    const int32_t distance = Abs(pass.distance[from]);
    const bool near = IsNearer(pass, x, y), was_near = pass.map[from] > pass.middle[from];
    const bool keeps = near == was_near && distance >= clean &&
                       (pass.IsHard() ? !IsOnRamp(pass, x, y, kRampStep) : IsFlat(pass, x, y));
    planes->disparity[to] = pass.map[from];
    planes->state[to] = static_cast<uint8_t>((keeps ? 0 : kNone) + (near ? kNearer : 0));
    if (!keeps && pass.side[from] != 0) {
      planes->ready[to] = Bit(1);
      planes->pending[count++] = static_cast<int32_t>(to);
    }
    if (distance < end - kDistance) return;
    ForPixels(Widened(*pass.setup, {x, y, 1, 1}, 1), [&](int32_t u, int32_t v) {
      if (pass.distance[pass.At(u, v)] != 0 || !Contains(region, u, v)) return;
      if (!pass.IsHard() && !IsFlat(pass, u, v)) return;
      planes->disparity[planes->At(u, v)] = pass.map[pass.At(u, v)];
      planes->state[planes->At(u, v)] = 0;
    });
  });
  return count;
}

// Takes the mean disparity of the neighbours of the same side that have had theirs before `round`.
// Neighbours that are more than a pixel of disparity from the clearest one, such as a second near
// surface, are left out. Returns false if no neighbour has a disparity of this side.
bool TakeFromNeighbours(int32_t middle, int32_t at, int32_t round, SidePlanes* planes) {
  const int32_t end = round * kRound;
  const bool near = (planes->state[at] & kNearer) != 0;
  int32_t found[8], count = 0, extreme = near ? INT16_MIN : INT16_MAX;
  for (int32_t row = -1; row <= 1; ++row) {
    for (int32_t column = -1; column <= 1; ++column) {
      const int32_t other = at + row * planes->Stride() + column;
      if (planes->state[other] >= end) continue;
      const int32_t disparity = planes->disparity[other];
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
  planes->disparity[at] =
      static_cast<int16_t>((2 * sum + (sum < 0 ? -number : number)) / (2 * number));
  return true;
}

// Lets pending pixels on the crests of thin structures, or on the ground of gaps, keep their
// disparity, and the others try again. Returns the number of pixels that remain.
size_t FindCrests(const OutlinePass& pass, size_t pending, int32_t round, SidePlanes* planes) {
  size_t left = 0;
  for (size_t k = 0; k < pending; ++k) {
    const int32_t at = planes->pending[k], x = planes->XOf(at), y = planes->YOf(at);
    const size_t from = pass.At(x, y);
    const bool near = (planes->state[at] & kNearer) != 0;
    planes->ready[at] = Bit(round);
    if ((pass.map[from] > pass.middle[from]) == near && !IsOnRamp(pass, x, y, 0)) {
      planes->state[at] = near ? kNearer : 0;
    } else {
      planes->pending[left++] = at;
    }
  }
  return left;
}

}  // namespace

void TakeDisparities(const OutlinePass& pass, const Rect& tile, SidePlanes* planes) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    std::copy_n(pass.map + pass.At(tile.x, y), tile.width, pass.result + pass.At(tile.x, y));
  }
  const int32_t rounds = 2 * pass.band + 2;
  planes->region = Widened(*pass.setup, tile, rounds);
  size_t pending = FindClean(pass, planes);
  const auto write = [&](int32_t at, int32_t x, int32_t y) {
    if (Contains(tile, x, y)) pass.result[pass.At(x, y)] = planes->disparity[at];
  };
  for (int32_t round = 1; round <= rounds && pending > 0; ++round) {
    if (round == kFlatRounds) pending = FindCrests(pass, pending, round, planes);
    size_t left = 0;
    for (size_t k = 0; k < pending; ++k) {
      const int32_t at = planes->pending[k];
      planes->pending[left++] = at;
      if ((planes->ready[at] & Bit(round)) == 0) continue;
      planes->ready[at] &= static_cast<uint8_t>(~Bit(round));
      const int32_t x = planes->XOf(at), y = planes->YOf(at);
      if (!TakeFromNeighbours(pass.middle[pass.At(x, y)], at, round, planes)) continue;
      --left;
      write(at, x, y);
      planes->state[at] = static_cast<uint8_t>(round * kRound + (planes->state[at] & kNearer));
      for (int32_t row = -1; row <= 1; ++row) {
        uint8_t* ready = planes->ready + at + row * planes->Stride();
        for (int32_t column = -1; column <= 1; ++column) ready[column] |= Bit(round + 1);
      }
    }
    pending = left;
  }
  for (size_t k = 0; k < pending; ++k) {
    const int32_t at = planes->pending[k], x = planes->XOf(at), y = planes->YOf(at);
    planes->disparity[at] = CrestOf(pass, x, y, (planes->state[at] & kNearer) != 0);
    write(at, x, y);
  }
}

}  // namespace starfocus
