// SPDX-License-Identifier: Apache-2.0
// Fills surfaces that no captured view shows, in the reference.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_

#include "tests/conformance/reference_surfaces.h"

namespace reference {

// Replaces the colour of each farthest surface that repeats another pixel by the far colour of that
// pixel. Then smooths these pixels with each other and with known ones: see
// lib/slices/hidden_fill.h. `unit` is a pixel of disparity.
void InpaintHidden(int unit, SurfaceMap* map);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_
