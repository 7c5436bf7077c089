// SPDX-License-Identifier: Apache-2.0
// The disparities of thin structure: large edges of a map, and the two surfaces that meet there.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_EDGES_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_EDGES_H_

#include <functional>
#include <utility>

#include "tests/conformance/reference_line.h"

namespace reference {

// A larger step (1/64) is an edge of thin structure.
inline constexpr int kThinEdge = 5 * 64;

class ThinMap {
 public:
  explicit ThinMap(const Picture& picture) : picture_(picture) {}

  // The picture's outermost pixels go on beyond it.
  int Disparity(int x, int y) const;
  bool IsBesideNearer(int x, int y) const;
  // Find the two surfaces of a pixel; false: it has one. Where coverage is given these are the
  // nearest within 32 pixels, ramps left out, else those of the nearest edge within 3. `square` is
  // that of the distance to the pixel beyond the edge.
  bool FindGiven(int x, int y, int* low, int* high) const;
  bool FindEdge(int x, int y, int* low, int* high, int* square) const;
  // The mean of disparities around within 2 pixels of the near one.
  double SmoothNear(int x, int y, int near) const;

 private:
  using Is = std::function<bool(int x, int y)>;
  std::pair<int, int> Nearest(int x, int y, int reach, const Is& is) const;
  bool IsRamp(int x, int y) const;

  const Picture& picture_;
};

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_EDGES_H_
