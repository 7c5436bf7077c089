// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_patch.h"

#include <algorithm>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

int32_t Inside(int32_t at, int32_t length) { return Max(0, Min(at, length - 1)); }

// Splits a row of the picture into planes; beyond its ends they go on as they end.
void CopyRow(const uint8_t* row, int32_t picture_width, const Patches& patches, uint8_t* out) {
  const auto stride = static_cast<int32_t>(patches.stride);
  const int32_t first = Min(Max(0, -patches.left), stride);
  const int32_t last = Max(first, Min(stride, picture_width - patches.left));
  for (size_t c = 0; c < 3; ++c, out += patches.plane) {
    const uint8_t* from = row + 3 * (patches.left + first) + static_cast<int32_t>(c);
    for (int32_t k = first; k < last; ++k, from += 3) out[k] = *from;
    std::fill_n(out, first, row[c]);
    std::fill(out + last, out + stride, row[3 * static_cast<size_t>(picture_width - 1) + c]);
  }
}

// The planes' rectangle in the picture that has samples of its own there.
Rect PartInside(const EstimatePlan& plan, const Patches& patches) {
  const int32_t x = Max(patches.left, 0), y = Max(patches.top, 0);
  const int32_t right = Min(patches.left + static_cast<int32_t>(patches.stride), plan.width);
  return {x, y, right - x, Min(patches.top + patches.rows, plan.height) - y};
}

// Enters what the pixels of a row of the map hide of a view.
void HideBehindRow(const SideView& view, const int16_t* map, int32_t y, const Rect& from,
                   const Rect& inside, const Patches& patches, int16_t* highest) {
  for (int32_t x = from.x; x < from.x + from.width; ++x) {
    const int32_t d = map[x];
    const int32_t to_x = x + WholeMove(MoveAcross(view, d));
    const int32_t to_y = y + WholeMove(MoveDown(view, d));
    if (to_x < inside.x || to_x >= inside.x + inside.width || to_y < inside.y ||
        to_y >= inside.y + inside.height) {
      continue;
    }
    int16_t& here = highest[patches.At(to_x, to_y)];
    here = std::max(here, static_cast<int16_t>(d));
  }
}

}  // namespace

void LoadPatches(const EstimatePlan& plan, const sf_light_field& light_field, const Rect& region,
                 Patches* patches) {
  patches->left = region.x - plan.reach;
  patches->top = region.y - plan.reach;
  patches->rows = region.height + 2 * plan.reach + 1;
  for (int32_t view = 0; view <= plan.side_views(); ++view) {
    const sf_plane& picture = light_field.views[view == 0 ? 0 : plan.side[view - 1].index];
    for (int32_t row = 0; row < patches->rows; ++row) {
      const int32_t y = Inside(patches->top + row, plan.height);
      uint8_t* out = patches->rgb + 3 * static_cast<size_t>(view) * patches->plane +
                     static_cast<size_t>(row) * patches->stride;
      CopyRow(picture.data + static_cast<size_t>(y) * picture.stride, plan.width, *patches, out);
    }
  }
}

void MarkOutside(const EstimatePlan& plan, Patches* patches) {
  const Rect inside = PartInside(plan, *patches);
  patches->all_seen =
      inside.height == patches->rows && static_cast<size_t>(inside.width) == patches->stride;
  const auto rows = static_cast<size_t>(patches->rows);
  for (int32_t view = 0; view < plan.side_views(); ++view) {
    int16_t* highest = patches->highest + static_cast<size_t>(view) * patches->plane;
    std::fill_n(highest, rows * patches->stride, int16_t{INT16_MAX});
    for (int32_t y = inside.y; y < inside.y + inside.height; ++y) {
      std::fill_n(highest + patches->At(inside.x, y), inside.width, int16_t{INT16_MIN});
    }
  }
}

void MarkHidden(const EstimatePlan& plan, const int16_t* map, Patches* patches) {
  MarkOutside(plan, patches);
  patches->all_seen = false;
  const Rect inside = PartInside(plan, *patches);
  const Rect from = Widened(plan, inside, plan.reach);
  for (int32_t view = 0; view < plan.side_views(); ++view) {
    int16_t* highest = patches->highest + static_cast<size_t>(view) * patches->plane;
    for (int32_t y = from.y; y < from.y + from.height; ++y) {
      HideBehindRow(plan.side[view], map + static_cast<size_t>(y) * static_cast<size_t>(plan.width),
                    y, from, inside, *patches, highest);
    }
  }
}

}  // namespace starfocus
