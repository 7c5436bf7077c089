// SPDX-License-Identifier: Apache-2.0
// Gathering in the reference: flat cells of one surface are blurred from the centre view by the
// ideal PSF (4). In cells on a slope, each pixel is blurred by the PSF of its own radius.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_GATHER_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_GATHER_H_

#include "tests/conformance/reference.h"
#include "tests/conformance/reference_field.h"

namespace reference {

// Blurs cells of a block by a filter, without rendering views, from the centre view at the block's
// layer. Writes the cells to `frame`, whose first pixel is (frame_x, frame_y) of the layer. `r_max`
// is the largest blur radius for which there are PSFs.
void GatherCells(const LightField& field, const Picture& of_layer, const Block& block,
                 const Lens& lens, double r_max, int frame_x, int frame_y, Picture* frame);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_GATHER_H_
