// SPDX-License-Identifier: Apache-2.0
// The far surface's light where few pixels show it: means of what is known of it over growing
// cells, each of the farthest surface in it, continued to where nothing is known.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FAR_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FAR_H_

#include <vector>

#include "tests/conformance/reference_line.h"

namespace reference {

// Tiles by which thin structure is told, in pixels.
inline constexpr int kTile = 16;

struct FarLight {
  Colour light = {0, 0, 0};
  double known = 0;      // how much of it, up to 1
  double disparity = 0;  // 1/64
};

// Planes of cells of 1, 2, 4, 8 and 16 pixels a side, with a tile around the picture.
class FarPyramid {
 public:
  FarPyramid(int columns, int rows);  // of tiles

  FarLight& Pixel(int x, int y) { return At(0, x, y); }
  // Makes cells of those of half their side, and fills what they don't know.
  void Fill();
  // What is known of a pixel with what goes on from the cells around.
  FarLight Filled(int x, int y) const;

 private:
  struct Level {
    int margin, width, height;
    std::vector<FarLight> cells;
  };
  FarLight& At(int level, int x, int y);
  FarLight Get(const std::vector<Level>& levels, int level, int x, int y) const;
  FarLight Pushed(int level, int x, int y, FarLight cell, double disparity) const;
  std::vector<FarLight> Above(int level, int x, int y) const;

  std::vector<Level> levels_, filled_;
};

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FAR_H_
