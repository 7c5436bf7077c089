// SPDX-License-Identifier: Apache-2.0
// Draws text on pictures.
#ifndef STARFOCUS_EXAMPLES_LAB_SHEET_LABEL_H_
#define STARFOCUS_EXAMPLES_LAB_SHEET_LABEL_H_

#include <string>

#include "platform/image.h"

namespace starfocus {

// Height of a line of text in pixels, including its margins.
inline constexpr int kLabelHeight = 28;

// Draws `text` (ASCII) in light grey, clipped to the picture. The upper left corner of the text's
// margin is at (x, y).
void DrawLabel(const std::string& text, int x, int y, Image* image);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_SHEET_LABEL_H_
