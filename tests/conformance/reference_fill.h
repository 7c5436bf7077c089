// SPDX-License-Identifier: Apache-2.0
// The reference's fill of what no captured view shows.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_

#include "tests/conformance/reference_surfaces.h"

namespace reference {

// Gives pixels whose farthest surface repeats another pixel that one's far colour, and then smooths
// them among each other and with what is known: see lib/slices/hidden_fill.h. `unit` is a pixel of
// disparity.
void InpaintHidden(int unit, SurfaceMap* map);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FILL_H_
