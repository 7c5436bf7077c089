// SPDX-License-Identifier: Apache-2.0
// Text on pictures.
#ifndef STARFOCUS_EXAMPLES_LAB_SHEET_LABEL_H_
#define STARFOCUS_EXAMPLES_LAB_SHEET_LABEL_H_

#include <string>

#include "platform/image.h"

namespace starfocus {

// Height of a line of text in pixels, with its margins.
inline constexpr int kLabelHeight = 28;

// Writes `text` (ASCII) in light grey, its margin starting at (x, y); clipped to the picture.
void DrawLabel(const std::string& text, int x, int y, Image* image);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_SHEET_LABEL_H_
