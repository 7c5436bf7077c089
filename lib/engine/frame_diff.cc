// SPDX-License-Identifier: Apache-2.0
// Finds the superblocks that depend on pixels that differ between two light fields, for videos.
#include <cstring>

#include "lib/base/fixed.h"
#include "lib/engine/engine.h"
#include "lib/io/depth_map.h"
#include "lib/io/image.h"

namespace starfocus {
namespace {

// Number of pixels that are compared at once.
constexpr int32_t kUnit = 16;

// Returns the stripes that depend on row y of the input.
Range StripesOf(const FrameDiff& changes, int32_t y, int32_t reach) {
  return {Max(0, y - reach) / changes.side, Min(changes.height - 1, y + reach) / changes.side + 1};
}

// Returns true if all superblocks of the stripes are already flagged as changed. If large parts of
// the picture change, this test avoids the comparison of most rows.
bool AllFlagged(const FrameDiff& changes, const Range& stripes) {
  for (int32_t stripe = stripes.first; stripe < stripes.last; ++stripe) {
    if (std::memchr(changes.Flags(stripe), 0, static_cast<size_t>(changes.columns)) != nullptr) {
      return false;
    }
  }
  return true;
}

// Two rows to compare, with `pixel_bytes` bytes per pixel.
struct RowPair {
  const void *before, *now;
  size_t pixel_bytes;

  // Returns true if pixels [first, end) differ.
  bool Differs(int32_t first, int32_t end) const {
    const size_t offset = pixel_bytes * static_cast<size_t>(first);
    return std::memcmp(static_cast<const uint8_t*>(before) + offset,
                       static_cast<const uint8_t*>(now) + offset,
                       pixel_bytes * static_cast<size_t>(end - first)) != 0;
  }
};

// Compares row y of two pictures and flags the superblocks that depend on pixels that differ.
// widen(&first, &end) may add pixels that change together with [first, end).
template <class Widen>
void CompareRow(const FrameDiff& changes, const RowPair& rows, int32_t y, int32_t reach,
                const Widen& widen) {
  const Range stripes = StripesOf(changes, y, reach);
  if (AllFlagged(changes, stripes) || !rows.Differs(0, changes.width)) return;
  // Last column of superblocks that was flagged for row y. If unknown disparities are filled,
  // pixels beyond the flagged columns may change.
  int32_t flagged = -1;
  for (int32_t x = 0; x < changes.width; x += kUnit) {
    int32_t left = x, right = Min(x + kUnit, changes.width);
    const int32_t column = Min(changes.width - 1, right - 1 + reach) / changes.side;
    if (column == flagged && !changes.fills) continue;
    if (!rows.Differs(left, right)) continue;
    widen(&left, &right);
    const int32_t first = Max(0, left - reach) / changes.side;
    flagged = Min(changes.width - 1, right - 1 + reach) / changes.side;
    for (int32_t stripe = stripes.first; stripe < stripes.last; ++stripe) {
      std::memset(changes.Flags(stripe) + first, 1, static_cast<size_t>(flagged - first + 1));
    }
  }
}

// Compares row y of the two disparity maps. A filled disparity changes if a known value next to its
// gap changes.
void CompareMaps(const FrameDiff& changes, int32_t y) {
  const float* const before = RowsOf(changes.before->depth).Row(y);
  const float* const now = RowsOf(changes.now->depth).Row(y);
  const auto is_filled = [&](int32_t x) {
    return changes.fills && (!IsFinite(before[x]) || !IsFinite(now[x]));
  };
  CompareRow(changes, {before, now, sizeof(float)}, y, changes.centre_reach,
             [&](int32_t* first, int32_t* end) {
               while (*first > 0 && is_filled(*first - 1)) --*first;
               while (*end < changes.width && is_filled(*end)) ++*end;
             });
}

// Compares row y of the coverage, if the light fields have coverage.
void CompareCoverage(const FrameDiff& changes, int32_t y) {
  if (!changes.covers) return;
  const auto row = static_cast<size_t>(y);
  const starfocus_light_field &a = *changes.before, &b = *changes.now;
  CompareRow(changes,
             {a.coverage + row * a.coverage_stride, b.coverage + row * b.coverage_stride, 1}, y,
             changes.centre_reach, [](int32_t*, int32_t*) {});
}

void CompareViews(const FrameDiff& changes, int32_t y) {
  CompareMaps(changes, y);
  CompareCoverage(changes, y);
  for (int32_t view = 0; view < changes.views; ++view) {
    CompareRow(
        changes,
        {RowsOf(changes.before->views[view]).Row(y), RowsOf(changes.now->views[view]).Row(y), 3}, y,
        view == 0 ? changes.centre_reach : changes.side_reach, [](int32_t*, int32_t*) {});
  }
}

}  // namespace

void TakeFrameDiff(int32_t columns, int32_t side, int32_t reach, Arena* arena, FrameDiff* changes) {
  changes->columns = columns;
  changes->stripes = 2 * reach / side + 5;
  changes->flags =
      arena->Take<uint8_t>(static_cast<size_t>(columns), static_cast<size_t>(changes->stripes));
}

void StartFrameDiff(int32_t y, FrameDiff* changes) {
  const int32_t reach = changes->side_reach;
  changes->rows = Max(0, y - changes->side - reach);
  changes->known = Max(0, changes->rows - reach) / changes->side;
}

starfocus_status CompareRows(int32_t y, CancelToken* cancel, FrameDiff* changes) {
  const int32_t reach = changes->side_reach;
  const int32_t end = Min(changes->height, y + 2 * changes->side + reach);
  for (; changes->rows < end; ++changes->rows) {
    const int32_t last = Min(changes->height - 1, changes->rows + reach) / changes->side;
    for (; changes->known <= last; ++changes->known) {
      std::memset(changes->Flags(changes->known), 0, static_cast<size_t>(changes->columns));
    }
    const int64_t samples = int64_t{3} * changes->width * changes->views;
    if (!cancel->Spend(samples)) return STARFOCUS_ERROR_CANCELLED;
    CompareViews(*changes, changes->rows);
  }
  return STARFOCUS_OK;
}

bool HasChanged(const FrameDiff& changes, const Rect& rect) {
  const int32_t side = changes.side;
  const int32_t first = Max(0, rect.x) / side;
  const int32_t last = Min(changes.width, rect.x + rect.width) - 1;
  const int32_t bottom = Min(changes.height, rect.y + rect.height) - 1;
  for (int32_t stripe = Max(0, rect.y) / side; stripe <= bottom / side; ++stripe) {
    const uint8_t* flags = changes.Flags(stripe) + first;
    if (std::memchr(flags, 1, static_cast<size_t>(last / side - first + 1)) != nullptr) return true;
  }
  return false;
}

}  // namespace starfocus
