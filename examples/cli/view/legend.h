// SPDX-License-Identifier: Apache-2.0
// Generates the legend of a depth map in colours (DrawDepth) for a page.
#ifndef STARFOCUS_EXAMPLES_CLI_VIEW_LEGEND_H_
#define STARFOCUS_EXAMPLES_CLI_VIEW_LEGEND_H_

#include <optional>
#include <string>

#include "examples/command_line/options.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// CSS rules of the legend. The rules use the colours of the page (page.cc).
extern const char kLegendStyle[];

// Returns HTML of a bar with the colours from the smallest disparity, far, to the largest, near.
// The bar marks the disparities in focus. A focus beyond an end of the bar is marked at this end.
std::string LegendHtml(const starfocus_disparity_stats& stats, std::optional<FocusBand> focus);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIEW_LEGEND_H_
