// SPDX-License-Identifier: Apache-2.0
// Fills surfaces that no captured view shows, in the reference.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_

#include "tests/conformance/reference_surfaces.h"

namespace reference {

// If the farthest surface of a pixel repeats another pixel, the surface gets the far colour of the
// other pixel. The replaced colours are then smoothed with each other and with known colours, as in
// lib/slices/inpaint.h. `unit` is the disparity of one pixel, in units of 1/64 pixel.
void InpaintHidden(int unit, SurfaceMap* map);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_
