// SPDX-License-Identifier: Apache-2.0
// The paper's renderer: views at most about a pixel apart, rendered line by line.
#ifndef STARFOCUS_LIB_LINE_SCAN_LINE_SCAN_RENDERER_H_
#define STARFOCUS_LIB_LINE_SCAN_LINE_SCAN_RENDERER_H_

#include "lib/plan/renderer.h"

namespace starfocus {

extern const Renderer kLineScanRenderer;

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_LINE_SCAN_RENDERER_H_
