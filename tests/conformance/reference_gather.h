// SPDX-License-Identifier: Apache-2.0
// What the reference gathers: cells of one surface, blurred from the centre view by the ideal
// kernel (4), and cells on a slope by that of each pixel.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_GATHER_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_GATHER_H_

#include "tests/conformance/reference.h"
#include "tests/conformance/reference_field.h"

namespace reference {

// Gathers the cells of a block from the centre view at its layer into `frame`, whose first pixel is
// (frame_x, frame_y) of the layer. `r_max` is the largest blur of the lens, for which there are
// kernels.
void GatherCells(const LightField& field, const Picture& of_layer, const Block& block,
                 const Lens& lens, double r_max, int frame_x, int frame_y, Picture* frame);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_GATHER_H_
