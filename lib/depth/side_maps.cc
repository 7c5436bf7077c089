// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/side_maps.h"

#include "lib/base/fixed.h"
#include "lib/depth/tile_views.h"
#include "simd/disparities.h"

namespace starfocus {
namespace {

// A hidden strip is at most as wide as the largest movement. kMoreReach is the number of pixels
// next to a hidden strip that may be wrong. The limit kMostReach bounds the time in pictures in
// which no pixel is seen.
constexpr int32_t kMoreReach = 16, kMostReach = 128;

// Returns true if a side view shows pixel (x, y) at disparity d.
bool IsSeen(const EstimatePlan& plan, const EstimateMemory& memory, int32_t x, int32_t y,
            int32_t d) {
  for (int32_t k = 0; k < plan.side_views; ++k) {
    const int32_t column = x + WholeMoveBy(plan.side[k].at.u, d);
    const int32_t row = y + WholeMoveBy(plan.side[k].at.v, d);
    if (column < 0 || column >= plan.width || row < 0 || row >= plan.height) continue;
    const int16_t* line = SideMap(plan, memory, k) + ptrdiff_t{row} * plan.width;
    if (Abs(line[column] - d) <= kSurfaceDepth) return true;
  }
  return false;
}

// Returns the disparity of the nearest pixel in a direction from pixel (x, y) that a side view
// shows, or kNoSurface if no side view shows a pixel within `reach` pixels.
int16_t SeenBeside(const EstimatePlan& plan, const int16_t* seen, int32_t x, int32_t y,
                   const int8_t* direction) {
  const int32_t reach = Min(plan.reach + kMoreReach, kMostReach);
  for (int32_t k = 1; k <= reach; ++k) {
    const int32_t column = x + k * direction[0], row = y + k * direction[1];
    if (column < 0 || column >= plan.width || row < 0 || row >= plan.height) break;
    const int16_t d = seen[ptrdiff_t{row} * plan.width + column];
    if (d != simd::kNoSurface) return d;
  }
  return simd::kNoSurface;
}

// Returns the second smallest disparity of the nearest seen pixels in eight directions. If only one
// pixel is found, returns the disparity of this pixel. If no pixel is found, returns kNoSurface.
// The second smallest disparity is robust to a single disparity that is too small.
int16_t FarBeside(const EstimatePlan& plan, const int16_t* seen, int32_t x, int32_t y) {
  int32_t least = INT32_MAX, second = INT32_MAX;
  for (const auto& direction : kEightDirections) {
    const int16_t d = SeenBeside(plan, seen, x, y, direction);
    if (d == simd::kNoSurface) continue;
    second = Min(second, Max(least, d));
    least = Min(least, d);
  }
  if (least == INT32_MAX) return simd::kNoSurface;
  return static_cast<int16_t>(second == INT32_MAX ? least : second);
}

}  // namespace

SideReference MakeSideReference(const EstimatePlan& plan, const starfocus_light_field& light_field,
                                int32_t k) {
  SideReference reference = {plan, light_field};
  const SideView& view = plan.side[k];
  reference.light_field.views[0] = light_field.views[view.index];
  reference.light_field.views[1] = light_field.views[0];
  reference.plan.side_views = 1;
  reference.plan.side[0] = {1,
                            {static_cast<int16_t>(-view.at.u), static_cast<int16_t>(-view.at.v)}};
  reference.plan.sides[0] = 1;
  return reference;
}

void FindUnseen(const EstimatePlan& plan, const Rect& tile, EstimateMemory* memory) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t row = static_cast<size_t>(y) * static_cast<size_t>(plan.width);
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = row + static_cast<size_t>(x);
      const int16_t d = memory->second[at];
      memory->first[at] = IsSeen(plan, *memory, x, y, d) ? d : simd::kNoSurface;
    }
  }
}

void FillUnseen(const EstimatePlan& plan, const Rect& tile, EstimateMemory* memory) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t row = static_cast<size_t>(y) * static_cast<size_t>(plan.width);
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = row + static_cast<size_t>(x);
      if (memory->first[at] != simd::kNoSurface) continue;
      memory->certainty[at] = 0;
      const int16_t far = FarBeside(plan, memory->first, x, y);
      if (far != simd::kNoSurface) memory->second[at] = far;
    }
  }
}

}  // namespace starfocus
