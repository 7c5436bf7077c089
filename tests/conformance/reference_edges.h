// SPDX-License-Identifier: Apache-2.0
// Disparities of thin structures: large edges of a map, and the two surfaces that meet there.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_EDGES_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_EDGES_H_

#include <functional>
#include <utility>

#include "tests/conformance/reference_line.h"

namespace reference {

// Threshold of edges of thin structures: a larger step of disparity, in 1/64 pixel, is an edge.
inline constexpr int kThinEdge = 5 * 64;

class ThinMap {
 public:
  explicit ThinMap(const Picture& picture) : picture_(picture) {}

  // Returns the disparity of a pixel. Beyond the picture, the outermost pixels are repeated.
  int Disparity(int x, int y) const;
  bool IsBesideNearer(int x, int y) const;
  // Returns true if two opposite neighbours of a pixel are farther.
  bool IsStrand(int x, int y) const;
  // Returns true if the disparity of a pixel lies between the disparities of two opposite pixels.
  bool IsRamp(int x, int y) const;
  // FindGiven and FindEdge find the disparities of the two surfaces of a pixel, and return false if
  // the pixel has only one surface. FindGiven, for given coverage, uses the nearest surfaces within
  // 32 pixels, without ramps. FindEdge uses the surfaces at the nearest edge within 3 pixels.
  // `square` receives the squared distance to the pixel beyond the edge.
  bool FindGiven(int x, int y, int* low, int* high) const;
  bool FindEdge(int x, int y, int* low, int* high, int* square) const;
  // Returns the mean of the disparities within 2 pixels that are close to the disparity `near`.
  double SmoothNear(int x, int y, int near) const;

 private:
  using Is = std::function<bool(int x, int y)>;
  std::pair<int, int> Nearest(int x, int y, int reach, const Is& is) const;

  const Picture& picture_;
};

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_EDGES_H_
