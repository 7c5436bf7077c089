// SPDX-License-Identifier: Apache-2.0
// Finds the superblocks that depend on pixels that differ between two light fields, for videos.
#include <cstring>

#include "lib/base/fixed.h"
#include "lib/engine/stripe.h"
#include "lib/io/depth_map.h"
#include "lib/io/image.h"

namespace starfocus {
namespace {

// Number of pixels that are compared at once.
constexpr int32_t kUnit = 16;

// Returns the stripes that depend on row y of the input.
Range StripesOf(const FrameDiff& changes, int32_t y, int32_t reach) {
  return {Max(0, y - reach) / changes.config->superblock,
          Min(changes.config->height - 1, y + reach) / changes.config->superblock + 1};
}

// Returns true if all superblocks of the stripes are already flagged as changed. If large parts of
// the picture change, this test avoids the comparison of most rows.
bool AllFlagged(const FrameDiff& changes, const Range& stripes) {
  for (int32_t stripe = stripes.first; stripe < stripes.last; ++stripe) {
    if (std::memchr(changes.Flags(stripe), 0, static_cast<size_t>(Columns(*changes.config))) !=
        nullptr) {
      return false;
    }
  }
  return true;
}

// Compares rows y of two pictures with `pixel_bytes` bytes per pixel, and flags the superblocks
// that depend on pixels that differ. widen(&first, &end) may add pixels that change together with
// [first, end).
template <class Widen>
void CompareRow(const FrameDiff& changes, const void* before, const void* now, size_t pixel_bytes,
                int32_t y, int32_t reach, const Widen& widen) {
  const int32_t side = changes.config->superblock, width = changes.config->width;
  const bool fills = changes.config->unknown == STARFOCUS_UNKNOWN_FILL;
  const auto differ = [&](int32_t first, int32_t end) {
    const size_t offset = pixel_bytes * static_cast<size_t>(first);
    return std::memcmp(static_cast<const uint8_t*>(before) + offset,
                       static_cast<const uint8_t*>(now) + offset,
                       pixel_bytes * static_cast<size_t>(end - first)) != 0;
  };
  const Range stripes = StripesOf(changes, y, reach);
  if (AllFlagged(changes, stripes) || !differ(0, width)) return;
  // Last column of superblocks that was flagged for row y. If unknown disparities are filled,
  // pixels beyond the flagged columns may change.
  int32_t flagged = -1;
  for (int32_t x = 0; x < width; x += kUnit) {
    int32_t left = x, right = Min(x + kUnit, width);
    const int32_t column = Min(width - 1, right - 1 + reach) / side;
    if (column == flagged && !fills) continue;
    if (!differ(left, right)) continue;
    widen(&left, &right);
    const int32_t first = Max(0, left - reach) / side;
    flagged = Min(width - 1, right - 1 + reach) / side;
    for (int32_t stripe = stripes.first; stripe < stripes.last; ++stripe) {
      std::memset(changes.Flags(stripe) + first, 1, static_cast<size_t>(flagged - first + 1));
    }
  }
}

// Compares row y of the two disparity maps. A filled disparity changes if a known value next to its
// gap changes.
void CompareMaps(const FrameDiff& changes, int32_t y) {
  const FullConfig& config = *changes.config;
  const float* const before = RowsOf(changes.before->depth).Row(y);
  const float* const now = RowsOf(changes.now->depth).Row(y);
  const auto is_filled = [&](int32_t x) {
    return config.unknown == STARFOCUS_UNKNOWN_FILL && (!IsFinite(before[x]) || !IsFinite(now[x]));
  };
  CompareRow(changes, before, now, sizeof(float), y, changes.centre_reach,
             [&](int32_t* first, int32_t* end) {
               while (*first > 0 && is_filled(*first - 1)) --*first;
               while (*end < config.width && is_filled(*end)) ++*end;
             });
}

// Compares row y of the maps, of the coverage, if the light fields have coverage, and of the views.
void CompareViews(const FrameDiff& changes, int32_t y) {
  const starfocus_light_field &before = *changes.before, &now = *changes.now;
  const auto alone = [](int32_t*, int32_t*) {};
  CompareMaps(changes, y);
  if (changes.covers) {
    const auto row = static_cast<size_t>(y);
    CompareRow(changes, before.coverage + row * before.coverage_stride,
               now.coverage + row * now.coverage_stride, 1, y, changes.centre_reach, alone);
  }
  for (int32_t view = 0; view < changes.views; ++view) {
    CompareRow(changes, RowsOf(before.views[view]).Row(y), RowsOf(now.views[view]).Row(y), 3, y,
               view == 0 ? changes.centre_reach : changes.side_reach, alone);
  }
}

}  // namespace

void TakeFrameDiff(const FullConfig& config, int32_t reach, Arena* arena, FrameDiff* changes) {
  changes->stripes = 2 * reach / config.superblock + 5;
  changes->flags = arena->Take<uint8_t>(static_cast<size_t>(Columns(config)),
                                        static_cast<size_t>(changes->stripes));
}

void StartFrameDiff(const starfocus_previous& previous, const starfocus_light_field* now,
                    EngineState* engine) {
  FrameDiff& changes = engine->stripe.changes;
  const Borders& borders = engine->lens.borders;
  changes.config = &engine->config;
  changes.before = previous.light_field;
  changes.now = now;
  changes.picture = previous.out;
  changes.covers = engine->input.given_coverage.data != nullptr;
  // STARFOCUS_MODE_BLUR reads only the centre view.
  changes.views = engine->lens.params.mode == STARFOCUS_MODE_BLUR ? 1 : engine->config.views;
  changes.side_reach = borders.views;
  changes.centre_reach = borders.highlights > 0 ? borders.views : borders.centre;
  const int32_t side = engine->config.superblock;
  changes.rows = Max(0, StripeRows(*engine).first - side - changes.side_reach);
  changes.known = Max(0, changes.rows - changes.side_reach) / side;
}

starfocus_status CompareRows(int32_t y, CancelToken* cancel, FrameDiff* changes) {
  const FullConfig& config = *changes->config;
  const int32_t reach = changes->side_reach;
  const int32_t end = Min(config.height, y + 2 * config.superblock + reach);
  for (; changes->rows < end; ++changes->rows) {
    const int32_t last = Min(config.height - 1, changes->rows + reach) / config.superblock;
    for (; changes->known <= last; ++changes->known) {
      std::memset(changes->Flags(changes->known), 0, static_cast<size_t>(Columns(config)));
    }
    const int64_t samples = int64_t{3} * config.width * changes->views;
    if (!cancel->Spend(samples)) return STARFOCUS_ERROR_CANCELLED;
    CompareViews(*changes, changes->rows);
  }
  return STARFOCUS_OK;
}

bool HasChanged(const FrameDiff& changes, const Rect& rect) {
  const int32_t side = changes.config->superblock;
  const int32_t first = Max(0, rect.x) / side;
  const int32_t last = Min(changes.config->width, rect.x + rect.width) - 1;
  const int32_t bottom = Min(changes.config->height, rect.y + rect.height) - 1;
  for (int32_t stripe = Max(0, rect.y) / side; stripe <= bottom / side; ++stripe) {
    const uint8_t* flags = changes.Flags(stripe) + first;
    if (std::memchr(flags, 1, static_cast<size_t>(last / side - first + 1)) != nullptr) return true;
  }
  return false;
}

}  // namespace starfocus
