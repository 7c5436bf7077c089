// SPDX-License-Identifier: Apache-2.0
// The renderer of slices: each view stands for its subaperture of the lens.
#ifndef STARFOCUS_LIB_SLICES_SLICE_RENDERER_H_
#define STARFOCUS_LIB_SLICES_SLICE_RENDERER_H_

#include "lib/plan/renderer.h"

namespace starfocus {

extern const Renderer kSliceRenderer;

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_RENDERER_H_
