// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/reference_edges.h"

#include "tests/conformance/reference_field.h"

namespace reference {

int ThinMap::Disparity(int x, int y) const {
  return picture_.disparities[picture_.At(std::clamp(x, 0, picture_.width - 1),
                                          std::clamp(y, 0, picture_.height - 1))];
}

bool ThinMap::IsBesideNearer(int x, int y) const {
  for (const Direction& side : kDirections) {
    if (Disparity(x + side.x, y + side.y) - Disparity(x, y) > kThinEdge) return true;
  }
  return false;
}

// Returns the offset of the nearest pixel within `reach` for which `is` returns true, or (0, 0) if
// no pixel is found. Among equally near pixels, the pixel with the smaller maximum of |dx| and |dy|
// is chosen, then the first in row order.
std::pair<int, int> ThinMap::Nearest(int x, int y, int reach, const Is& is) const {
  std::pair<int, int> nearest = {0, 0};
  std::pair<int, int> least = {INT32_MAX, 0};
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const std::pair<int, int> rank = {dx * dx + dy * dy, std::max(std::abs(dx), std::abs(dy))};
      if (rank.first == 0 || !(rank < least) || !is(x + dx, y + dy)) continue;
      least = rank;
      nearest = {dx, dy};
    }
  }
  return nearest;
}

// Returns true if the disparity of the pixel lies between the disparities of two opposite pixels at
// an equal distance of 1 to 3 pixels. Either both steps must be edges, or the pixels must be
// adjacent, both steps at least half a pixel, and the larger step at most 4 times the smaller one.
bool ThinMap::IsRamp(int x, int y) const {
  constexpr Direction kOpposite[] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
  for (const Direction& to : kOpposite) {
    for (int k = 1; k <= 3; ++k) {
      const int here = Disparity(x, y);
      const int before = here - Disparity(x - k * to.x, y - k * to.y);
      const int after = Disparity(x + k * to.x, y + k * to.y) - here;
      const int least = std::min(std::abs(before), std::abs(after));
      const int most = std::max(std::abs(before), std::abs(after));
      const bool ramp = least > kThinEdge || (k == 1 && least >= 32 && most <= 4 * least);
      if ((before > 0) == (after > 0) && ramp) return true;
    }
  }
  return false;
}

bool ThinMap::FindGiven(int x, int y, int* low, int* high) const {
  const int here = Disparity(x, y);
  const auto find = [&](int from, int to) {
    return Nearest(x, y, 32, [&](int column, int row) {
      const int there = Disparity(column, row);
      return there >= from && there <= to && !IsRamp(column, row);
    });
  };
  const auto disparity = [&](const std::pair<int, int>& at) {
    return Disparity(x + at.first, y + at.second);
  };
  if (IsRamp(x, y)) {
    *high = disparity(find(here + 1, INT16_MAX));
    *low = disparity(find(INT16_MIN, here - 1));
    if (*high - *low > kThinEdge) return true;
  }
  const auto nearer = find(here + kThinEdge + 1, INT16_MAX);
  const auto farther = find(INT16_MIN, here - kThinEdge - 1);
  const auto square = [](const std::pair<int, int>& at) {
    const int sum = at.first * at.first + at.second * at.second;
    return sum == 0 ? INT32_MAX : sum;
  };
  const bool is_near = square(farther) <= square(nearer);
  *high = is_near ? here : disparity(nearer);
  *low = is_near ? disparity(farther) : here;
  return std::min(square(nearer), square(farther)) != INT32_MAX;
}

bool ThinMap::FindEdge(int x, int y, int* low, int* high, int* square) const {
  const int here = Disparity(x, y);
  int other = here;
  *square = 0;
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) {
      const int there = Disparity(x + dx, y + dy), distance = dx * dx + dy * dy;
      if (std::abs(there - here) <= kThinEdge || (*square != 0 && distance > *square)) continue;
      // Among equally near pixels, the one with the largest disparity counts.
      other = distance == *square ? std::max(other, there) : there;
      *square = distance;
    }
  }
  *low = std::min(here, other);
  *high = std::max(here, other);
  return *square != 0;
}

bool ThinMap::IsStrand(int x, int y) const {
  for (const Direction& to : {kDirections[0], kDirections[2]}) {
    const int beside = std::max(Disparity(x - to.x, y - to.y), Disparity(x + to.x, y + to.y));
    if (Disparity(x, y) - beside > kThinEdge) return true;
  }
  return false;
}

double ThinMap::SmoothNear(int x, int y, int near) const {
  constexpr int kWeights[] = {6, 4, 1};
  double sum = 0, weights = 0;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      if (std::abs(Disparity(x + dx, y + dy) - near) > 2 * 64) continue;
      const double weight = kWeights[std::abs(dx)] * kWeights[std::abs(dy)];
      sum += weight * (Disparity(x + dx, y + dy) - near);
      weights += weight;
    }
  }
  return weights == 0 ? near : near + std::round(sum / weights);
}

}  // namespace reference
