// SPDX-License-Identifier: Apache-2.0
// The method once more, whole pictures in double precision, written to be read: what the engine is
// held to. Which pixel is visible where is decided on the engine's grid (disparity and focus to
// 1/64, shifts to 1/256 of a pixel), everything about colours in double and unrounded.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_

#include <vector>

#include "lib/slices/depth_slices.h"
#include "starfocus/starfocus.h"
#include "tests/conformance/reference_opening.h"
#include "tests/support/test_scene.h"

namespace reference {

// Views along the aperture radius: (9), or 2 * ceil(r_max) for the benchmark.
int ViewsAlongRadius(double r_max, int mode);

struct Result {
  int n = 0;                // views along the aperture radius
  int views = 0;            // rendered
  std::vector<double> rgb;  // codes, unrounded, 3 * width * height
};

// Refocuses the scene by the transfer of `config`. `block` is the side of the
// blocks: runs of one shift start at the edge of a block's extended rectangle, so that results
// depend on it.
Result Refocus(const test::Scene& scene, const starfocus_params& params,
               const starfocus_config& config, int block);

// A cell of the picture that is gathered (reference_gather.h).
struct GatheredCell {
  int x, y, width, height;              // in the picture
  bool on_slope;                        // blurred by the radius of each pixel
  int at_x, at_y, at_width, at_height;  // what shows it at the block's layer
};

// A block of the block mode and what it is rendered from.
struct Block {
  int x, y, width, height;  // of the picture
  int layer, n;
  int rendered_x, rendered_y, rendered_width, rendered_height;  // at the layer, margins included
  int left, right, top, bottom;                                 // border at the layer
  std::vector<GatheredCell> gathered;                           // after the views, at the layer
};

// Block mode, or the benchmark's blocks, with a given partition of the picture and without
// deblocking; unrounded, 3 * width * height.
std::vector<double> RefocusBlocks(const test::Scene& scene, const starfocus_params& params,
                                  const starfocus_config& config, const std::vector<Block>& blocks);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_
