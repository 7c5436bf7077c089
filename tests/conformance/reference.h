// SPDX-License-Identifier: Apache-2.0
// Reference implementation of the method: whole pictures in double precision, written for
// readability. The conformance tests compare the engine with this reference. To decide visibility,
// disparities and focus are rounded to 1/64 pixel and shifts to 1/256 pixel, as in the engine.
// Colours in the reference are unrounded doubles.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_

#include <vector>

#include "lib/slices/slice_plane.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/reference_opening.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace reference {

// Returns the largest blur radius in pixels of the disparities from `low` to `high`.
double LargestBlur(const starfocus::Params& lens, double low, double high);

// Returns the number of views along the aperture radius: (9), or 2 * ceil(r_max) for the benchmark.
int ViewsAlongRadius(double r_max, int mode);

struct Result {
  int n = 0;                // N, the number of views along the aperture radius.
  int views = 0;            // Number of rendered views.
  std::vector<double> rgb;  // Codes, unrounded, 3 * width * height.
};

// Refocuses the scene with the transfer function of `config`. `block` is the side of the blocks in
// pixels. The side of the blocks affects the result, since runs start at the edge of a block's
// extended rectangle.
Result Refocus(const test::Scene& scene, const starfocus::Params& params,
               const test::Config& config, int block);

// A cell of the picture that is blurred by a filter, without rendering views (reference_gather.h).
struct GatheredCell {
  int x, y, width, height;              // In the picture.
  bool on_slope;                        // True if each pixel is blurred by its own radius.
  int at_x, at_y, at_width, at_height;  // Rectangle of the cell, in pixels of the block's layer.
};

// A block of block mode, and the rectangle of the layer that the views of this block render.
struct Block {
  int x, y, width, height;  // in the picture
  int layer, n;
  // Rendered rectangle with margins, in pixels of the layer.
  int rendered_x, rendered_y, rendered_width, rendered_height;
  // Border around the rendered rectangle, in pixels of the layer.
  int left, right, top, bottom;
  std::vector<GatheredCell> gathered;  // Cells blurred by a filter instead of rendered by views.
};

// Refocuses in block mode or in benchmark mode. `blocks` is the partition of the picture;
// boundaries are not deblocked. Returns 3 * width * height unrounded values.
std::vector<double> RefocusBlocks(const test::Scene& scene, const starfocus::Params& params,
                                  const test::Config& config, const std::vector<Block>& blocks);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_
