// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/view/legend.h"

#include <algorithm>

#include "examples/cli/disparity/map_figures.h"
#include "platform/text.h"

namespace starfocus {
namespace {

std::string Gradient() {
  std::string colors;
  for (const uint8_t* color : kDepthColors) {
    colors += ", rgb(" + std::to_string(color[0]) + " " + std::to_string(color[1]) + " " +
              std::to_string(color[2]) + ")";
  }
  return "linear-gradient(to right" + colors + ")";
}

}  // namespace

const char kLegendStyle[] =
    ".legend { margin-top: .6rem; } .bar { position: relative; height: 1rem; }\n"
    ".plane { position: absolute; top: -.3rem; bottom: -.3rem; margin-left: -2.5px; "
    "box-sizing: border-box; border: 2.5px solid var(--text); outline: 2px solid var(--ground); }\n"
    ".ends { display: flex; justify-content: space-between; gap: 1rem; padding-top: .4rem; "
    "font-variant-numeric: tabular-nums; }\n";

std::string LegendHtml(const starfocus_disparity_stats& stats, std::optional<FocusBand> focus) {
  const std::string far = "far " + Decimal(stats.min, 2), near = "near " + Decimal(stats.max, 2);
  std::string says = "Colours of disparity: " + far + ", " + near, plane, label;
  if (focus) {
    const double range = double(stats.max) - stats.min;
    const auto place = [&](double disparity) {
      return range > 0 ? 100 * std::clamp((disparity - stats.min) / range, 0.0, 1.0) : 50.0;
    };
    label = "focus " + Decimal(focus->far, 2);
    if (focus->near > focus->far) label += " to " + Decimal(focus->near, 2);
    says += ", " + label;
    const double begin = place(focus->far), width = place(focus->near) - begin;
    plane = "<span class=\"plane\" style=\"left: " + Decimal(begin, 2) + "%; width: calc(" +
            Decimal(width, 2) + "% + 5px)\"></span>";
    label = "<span>" + label + "</span>";
  }
  return "<div class=\"legend\" role=\"img\" aria-label=\"" + EscapeXml(says) +
         "\"><div class=\"bar\" style=\"background: " + Gradient() + "\">" + plane +
         "</div><div class=\"ends\"><span>" + far + "</span>" + label + "<span>" + near +
         "</span></div></div>";
}

}  // namespace starfocus
