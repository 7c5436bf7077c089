// SPDX-License-Identifier: Apache-2.0
// What the renderers are asked for: all views of one rectangle.
#ifndef STARFOCUS_LIB_INPUT_RENDER_JOB_H_
#define STARFOCUS_LIB_INPUT_RENDER_JOB_H_

#include "lib/base/geometry.h"
#include "lib/base/view_grid.h"
#include "lib/base/watch.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

// A rectangle of the window's layer, refocused by the views of the grid. `border` is how far beyond
// the rectangle pixels may splat into it. A renderer whose patience ends leaves anything in its
// output.
struct RenderJob {
  const Window* window;
  const ViewGrid* grid;
  const simd::Kernels* kernels;
  Rect rect;
  Border border;
  Patience* patience = nullptr;  // null: it goes on to the end
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_RENDER_JOB_H_
