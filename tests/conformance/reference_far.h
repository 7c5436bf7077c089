// SPDX-License-Identifier: Apache-2.0
// Estimates the light of the far surface where few pixels show this surface. The light is averaged
// over cells of increasing size, for the farthest surface in each cell, and continued into cells
// without known light.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FAR_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FAR_H_

#include <vector>

#include "tests/conformance/reference_line.h"

namespace reference {

// Side of the tiles that are tested for thin structure, in pixels.
inline constexpr int kTile = 16;

struct FarLight {
  Colour light = {0, 0, 0};
  double known = 0;      // Certainty of `light`, 0 to 1.
  double disparity = 0;  // Disparity of the farther surface, in units of 1/64 pixel.
};

// Planes of cells with sides of 1, 2, 4, 8 and 16 pixels. The planes extend beyond the picture by
// one tile on each side.
class FarPyramid {
 public:
  FarPyramid(int columns, int rows);  // numbers of tiles

  FarLight& Pixel(int x, int y) { return At(0, x, y); }
  // Averages cells into cells of twice their side, and fills cells without known light.
  void Fill();
  // Returns the light of a pixel. Where the light of the pixel is not known, the light of the
  // larger cells around the pixel is used.
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
