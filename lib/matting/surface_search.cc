// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

// On a ramp, the steps to both adjacent pixels are at least kLeastRamp, and the larger step is at
// most kRampRatio times the smaller step.
constexpr int32_t kLeastRamp = 1 << (kDisparityBits - 1);
constexpr int32_t kRampRatio = 4;

// Returns true if the middle of three pixels is on a ramp. The arguments are the disparities of the
// pixels in kDisparityBits. Two edges are a ramp with any ratio and up to kRampReach pixels away,
// because repaired maps of networks have narrow strips of another disparity along outlines.
bool IsRamp(int32_t before, int32_t here, int32_t after, bool adjacent) {
  if (Abs(after - before) < 2 * kLeastRamp) return false;  // most pixels
  const int32_t sign = after < before ? -1 : 1;
  const int32_t a = sign * (here - before), b = sign * (after - here);
  if (Min(a, b) > kThinStep) return true;
  return adjacent && Min(a, b) >= kLeastRamp && Max(a, b) <= kRampRatio * Min(a, b);
}

bool IsBetween(const int16_t* here) {
  constexpr int32_t kSide = GivenDisparities::kSide;
  constexpr int32_t kOpposite[] = {1, kSide - 1, kSide, kSide + 1};
  for (const int32_t step : kOpposite) {
    for (int32_t reach = 1; reach <= kRampReach; ++reach) {
      if (IsRamp(here[-reach * step], here[0], here[reach * step], reach == 1)) return true;
    }
  }
  return false;
}

// Rank of a pixel in a search: squared distance, square around the start, row, column. The lowest
// rank wins. Scale: 12 bits for the squared distance, at most 2 kGivenReach^2 = 2048; 6 bits for
// the square; 7 bits each for row and column.
constexpr uint32_t kNotFound = UINT32_MAX;

uint32_t RankOf(int32_t dx, int32_t dy) {
  static_assert(kGivenReach == 32);
  const int32_t ring = Max(Abs(dx), Abs(dy));
  return static_cast<uint32_t>(dx * dx + dy * dy) << 20 | static_cast<uint32_t>(ring) << 14 |
         static_cast<uint32_t>(dy + kGivenReach) << 7 | static_cast<uint32_t>(dx + kGivenReach);
}
int32_t DistanceOf(uint32_t rank) { return static_cast<int32_t>(rank >> 20); }

}  // namespace

SurfaceSearch::SurfaceSearch(const GivenDisparities& around) : around_(around) {
  for (int32_t y = kRampReach; y < kSide - kRampReach; ++y) {
    for (int32_t x = kRampReach; x < kSide - kRampReach; ++x) {
      const int32_t at = y * kSide + x;
      on_ramp_[at] = IsBetween(around.disparity + at);
      Cell& cell = cells_[y / kCellSide * kCells + x / kCellSide];
      if (on_ramp_[at]) {
        cell.has_ramp = true;
      } else {
        cell.Add(around.disparity[at]);
      }
    }
  }
  for (const Cell& cell : cells_) {
    if (cell.least > cell.greatest) continue;
    all_.Add(cell.least);
    all_.Add(cell.greatest);
  }
}

Found SurfaceSearch::FindNearest(int32_t at, int32_t low, int32_t high) const {
  if (high < all_.least || low > all_.greatest) return {around_.disparity[at], INT32_MAX};
  const int32_t x = at % kSide, y = at / kSide;
  uint32_t rank = kNotFound;
  // Lowers `rank` to the ranks of the matching pixels of a cell.
  const auto search = [&](int32_t column, int32_t row) {
    const Cell& cell = cells_[row * kCells + column];
    if (cell.greatest < low || cell.least > high) return;
    const int32_t left = Max(column * kCellSide, x - kGivenReach),
                  right = Min(column * kCellSide + kCellSide - 1, x + kGivenReach),
                  top = Max(row * kCellSide, y - kGivenReach),
                  bottom = Min(row * kCellSide + kCellSide - 1, y + kGivenReach);
    const int32_t nearest = Clamp(x, left, right) - x;
    if (!cell.has_ramp && cell.least >= low && cell.greatest <= high) {
      // All pixels of the cell match, and the nearest one has the lowest rank.
      rank = std::min(rank, RankOf(nearest, Clamp(y, top, bottom) - y));
      return;
    }
    for (int32_t v = top; v <= bottom; ++v) {
      if (nearest * nearest + (v - y) * (v - y) > DistanceOf(rank)) continue;
      for (int32_t u = left; u <= right; ++u) {
        const int32_t there = v * kSide + u, disparity = around_.disparity[there];
        if (on_ramp_[there] || disparity < low || disparity > high) continue;
        rank = std::min(rank, RankOf(u - x, v - y));
      }
    }
  };
  const int32_t column = x / kCellSide, row = y / kCellSide;
  for (int32_t r = 0; r <= kGivenReach / kCellSide; ++r) {
    const int32_t least = (r - 1) * kCellSide + 1;  // distance to the nearest cell of the square
    if (r > 0 && least * least > DistanceOf(rank)) break;
    for (int32_t v = Max(row - r, 0); v <= Min(row + r, kCells - 1); ++v) {
      const int32_t step = Abs(v - row) == r ? 1 : 2 * r;
      for (int32_t u = column - r; u <= column + r; u += step) {
        if (u >= 0 && u < kCells) search(u, v);
      }
    }
  }
  if (rank == kNotFound) return {around_.disparity[at], INT32_MAX};
  const int32_t dy = static_cast<int32_t>(rank >> 7 & 127) - kGivenReach,
                dx = static_cast<int32_t>(rank & 127) - kGivenReach;
  return {around_.disparity[at + dy * kSide + dx], DistanceOf(rank)};
}

bool SurfaceSearch::FindSurfaces(int32_t at, Surfaces* surfaces) const {
  const int32_t here = around_.disparity[at];
  if (on_ramp_[at]) {
    *surfaces = {FindNearest(at, INT16_MIN, here - 1).disparity,
                 FindNearest(at, here + 1, INT16_MAX).disparity};
    if (surfaces->high - surfaces->low > kThinStep) return true;
  }
  const Found nearer = FindNearest(at, here + kThinStep + 1, INT16_MAX);
  const Found farther = FindNearest(at, INT16_MIN, here - kThinStep - 1);
  const bool is_near = farther.distance <= nearer.distance;
  *surfaces = {is_near ? farther.disparity : here, is_near ? here : nearer.disparity};
  return Min(nearer.distance, farther.distance) != INT32_MAX;
}

}  // namespace starfocus
