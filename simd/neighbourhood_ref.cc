// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "simd/neighbourhood.h"

namespace starfocus::simd::reference {
namespace {

// Returns the number of pixels between cell k and a block that consists of cells `around` and
// `around` + 1. The result is negative if cell k is in the block.
int GapTo(int k, int around) {
  const int before = around - 1 - k, behind = k - around - 2;
  return kCellPixels * (before > behind ? before : behind);
}

void AddReach(int value, int16_t* largest) {
  if (value > *largest) *largest = static_cast<int16_t>(value);
}

}  // namespace

void ReachBlock(const CellPlanes& planes, int32_t around, const int16_t margins[3],
                BlockReach* reach) {
  *reach = {};
  const int side = 2 * around + 2;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int16_t* cell =
          planes.cells + (y - around) * static_cast<ptrdiff_t>(planes.stride) + x - around;
      const auto value = [&](int plane) -> int {
        return cell[static_cast<size_t>(plane) * planes.plane];
      };
      const int gap_x = GapTo(x, around), gap_y = GapTo(y, around);
      // Cells reach the block across their side that faces the block: a cell to the left of the
      // block across its right side.
      const int from_x = x < around ? kReachRight : kReachLeft;
      const int from_y = y < around ? kReachBottom : kReachTop;
      for (int layer = 0; layer < 3; ++layer) {
        if (gap_x >= 0 && value(from_x) + margins[layer] <= gap_x) continue;
        if (gap_y >= 0 && value(from_y) + margins[layer] <= gap_y) continue;
        if (layer == 0) {
          AddReach(value(kRadiusPlane), &reach->radius);
          AddReach(value(kEdgePlane), &reach->edge);
        }
        const auto inside = [&](int from) -> int {
          return layer == 0 ? value(from + kInsideLeft - kReachLeft) : kCellPixels;
        };
        int16_t(&border)[4] = reach->border[layer];
        if (gap_x >= 0) {
          AddReach(gap_x + inside(from_x), &border[x < around ? kReachLeft : kReachRight]);
        }
        if (gap_y >= 0) {
          AddReach(gap_y + inside(from_y), &border[y < around ? kReachTop : kReachBottom]);
        }
      }
    }
  }
}

void SurroundCells(const CellPlanes& planes, int32_t around, size_t count,
                   const CellRanges& ranges) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int16_t* cell = planes.cells + n;
    int16_t low = INT16_MAX, high = INT16_MIN, edge = 0;
    int widest = 0;
    for (int y = -around; y <= around; ++y) {
      for (int x = -around; x <= around; ++x) {
        const int16_t* at = cell + y * static_cast<ptrdiff_t>(planes.stride) + x;
        const int away = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
        const int16_t first = at[kLowPlane * planes.plane], last = at[kHighPlane * planes.plane];
        const bool nearer = last > cell[kHighPlane * planes.plane];
        const int own = cell[kReachPlane * planes.plane];
        const int other = nearer ? at[kNearPlane * planes.plane] : 0;
        if ((away - 1) * kCellPixels >= (own > other ? own : other)) continue;
        low = first < low ? first : low;
        high = last > high ? last : high;
        widest = last - first > widest ? last - first : widest;
        AddReach(at[kEdgePlane * planes.plane], &edge);
      }
    }
    ranges.low[n] = low;
    ranges.high[n] = high;
    ranges.widest[n] = static_cast<uint16_t>(widest);
    ranges.edge[n] = edge;
  }
}

}  // namespace starfocus::simd::reference
