#include "lib/window.h"

namespace starfocus {
namespace {

constexpr ViewPosition kPositions[kMaxViews] = {
    {0, 0}, {2, 0},  {-2, 0}, {0, 2},  {0, -2}, {2, 2},  {-2, 2}, {2, -2},  {-2, -2},
    {1, 0}, {-1, 0}, {0, 1},  {0, -1}, {1, 1},  {-1, 1}, {1, -1}, {-1, -1},
};

}  // namespace

int CapturedView(int u, int v, bool half) {
  const int distance = half ? 1 : 2;
  for (int index = half ? 9 : 1; index < kMaxViews; ++index) {
    if (kPositions[index].u2 == u * distance && kPositions[index].v2 == v * distance) return index;
  }
  return 0;
}

ViewPosition CapturedPosition(int index) { return kPositions[index]; }

}  // namespace starfocus
