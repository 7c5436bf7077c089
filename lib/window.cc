#include "lib/window.h"

#include <cstring>

namespace starfocus {
namespace {

constexpr ViewPosition kPositions[kMaxViews] = {
    {0, 0}, {2, 0},  {-2, 0}, {0, 2},  {0, -2}, {2, 2},  {-2, 2}, {2, -2},  {-2, -2},
    {1, 0}, {-1, 0}, {0, 1},  {0, -1}, {1, 1},  {-1, 1}, {1, -1}, {-1, -1},
};

// Triangular taps 1 2 1 and 1 2 3 4 3 2 1 of layers 1 and 2; each sums to 4^L.
int32_t Tap(int layer, int32_t k) { return (1 << layer) - Abs(k); }

}  // namespace

void ReadCaptured(const Window& window, int index, int32_t x, int32_t y, uint8_t* rgb) {
  const Plane<const uint8_t>& view = window.view[index];
  const int32_t right = window.picture_width - 1, bottom = window.picture_height - 1;
  // Clamped before scaling, so that no position overflows.
  const int32_t px = Clamp(x, 0, right) << window.layer, py = Clamp(y, 0, bottom) << window.layer;
  if (window.layer == 0) {
    std::memcpy(rgb, view.Row(py) + 3 * px, 3);
    return;
  }
  const int32_t reach = (1 << window.layer) - 1;
  int32_t sums[3] = {0, 0, 0};
  for (int32_t dy = -reach; dy <= reach; ++dy) {
    const uint8_t* row = view.Row(Clamp(py + dy, 0, bottom));
    for (int32_t dx = -reach; dx <= reach; ++dx) {
      const int32_t tap = Tap(window.layer, dx) * Tap(window.layer, dy);
      const uint8_t* pixel = row + 3 * Clamp(px + dx, 0, right);
      for (int c = 0; c < 3; ++c) sums[c] += tap * pixel[c];
    }
  }
  const int bits = 4 * window.layer;
  for (int c = 0; c < 3; ++c) rgb[c] = static_cast<uint8_t>(RoundShift(sums[c], bits));
}

int CapturedView(int u, int v, bool half) {
  const int distance = half ? 1 : 2;
  for (int index = half ? 9 : 1; index < kMaxViews; ++index) {
    if (kPositions[index].u2 == u * distance && kPositions[index].v2 == v * distance) return index;
  }
  return 0;
}

ViewPosition CapturedPosition(int index) { return kPositions[index]; }

}  // namespace starfocus
