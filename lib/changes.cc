#include "lib/changes.h"

#include <cstring>

#include "lib/fixed.h"

namespace starfocus {
namespace {

// Pixels that are compared at once.
constexpr int32_t kUnit = 16;

// Flags the blocks that depend on pixels [x, x + kUnit) of row y.
void Flag(const Changes& changes, int32_t x, int32_t y, int32_t reach) {
  const int32_t side = changes.side;
  const int32_t first = Max(0, x - reach) / side;
  const int32_t last = Min(changes.width - 1, x + kUnit - 1 + reach) / side;
  const int32_t last_stripe = Min(changes.height - 1, y + reach) / side;
  for (int32_t stripe = Max(0, y - reach) / side; stripe <= last_stripe; ++stripe) {
    std::memset(changes.Flags(stripe) + first, 1, static_cast<size_t>(last - first + 1));
  }
}

// Compares row y of `pixel_bytes` a pixel.
void CompareRow(const Changes& changes, const void* a, const void* b, size_t pixel_bytes, int32_t y,
                int32_t reach) {
  const auto* before = static_cast<const uint8_t*>(a);
  const auto* now = static_cast<const uint8_t*>(b);
  if (std::memcmp(before, now, pixel_bytes * static_cast<size_t>(changes.width)) == 0) return;
  for (int32_t x = 0; x < changes.width; x += kUnit) {
    const size_t offset = pixel_bytes * static_cast<size_t>(x);
    const size_t bytes = pixel_bytes * static_cast<size_t>(Min(kUnit, changes.width - x));
    if (std::memcmp(before + offset, now + offset, bytes) != 0) Flag(changes, x, y, reach);
  }
}

void CompareViews(const Changes& changes, int32_t y) {
  const auto row = static_cast<size_t>(y);
  const sf_light_field &a = changes.before, &b = changes.now;
  CompareRow(changes, a.disparity + row * (a.disparity_stride / sizeof(float)),
             b.disparity + row * (b.disparity_stride / sizeof(float)), sizeof(float), y,
             changes.centre_reach);
  for (int32_t view = 0; view < changes.views; ++view) {
    CompareRow(changes, a.views[view].data + row * a.views[view].stride,
               b.views[view].data + row * b.views[view].stride, 3, y,
               view == 0 ? changes.centre_reach : changes.side_reach);
  }
}

int32_t LargestReach(const Changes& changes) {
  return changes.views == 1 ? changes.centre_reach : changes.side_reach;
}

}  // namespace

int32_t ChangeStripes(int32_t side, int32_t reach) {
  // Rows up to `reach` beyond the stripe after the current one are compared, which flag stripes up
  // to as much again beyond; the one before the current is still asked for.
  return 2 * reach / side + 5;
}

void StartChanges(int32_t y, Changes* changes) {
  const int32_t reach = LargestReach(*changes);
  changes->rows = Max(0, y - changes->side - reach);
  changes->known = Max(0, changes->rows - reach) / changes->side;
}

void CompareRows(int32_t y, Changes* changes) {
  const int32_t reach = LargestReach(*changes);
  const int32_t end = Min(changes->height, y + 2 * changes->side + reach);
  for (; changes->rows < end; ++changes->rows) {
    const int32_t last = Min(changes->height - 1, changes->rows + reach) / changes->side;
    for (; changes->known <= last; ++changes->known) {
      std::memset(changes->Flags(changes->known), 0, static_cast<size_t>(changes->columns));
    }
    CompareViews(*changes, changes->rows);
  }
}

bool HasChanged(const Changes& changes, const Rect& rect) {
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
