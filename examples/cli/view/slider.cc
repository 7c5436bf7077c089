// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/view/slider.h"

namespace starfocus {

// The range input is invisible and covers the pictures, so that mouse, touch and keyboard work as
// for every range input. The input extends by half the width of its thumb, 22 pixels, beyond both
// sides of the pictures. The centre of the thumb is therefore exactly at the divider.
const char kSliderStyle[] =
    ".slider { --at: 50%; position: relative; margin-bottom: 1rem; }\n"
    ".slider img { width: 100%; } .after { position: absolute; inset: 0; "
    "clip-path: inset(0 0 0 var(--at)); }\n"
    ".tag { position: absolute; top: .5rem; left: .5rem; padding: .1rem .6rem; "
    "border-radius: 1rem; background: #000c; color: #fff; } .after .tag { left: auto; "
    "right: .5rem; }\n"
    ".slider input { position: absolute; top: 0; left: -22px; width: calc(100% + 44px); "
    "height: 100%; margin: 0; opacity: 0; cursor: ew-resize; touch-action: pan-y; "
    "appearance: none; -webkit-appearance: none; }\n"
    ".slider input::-webkit-slider-thumb { -webkit-appearance: none; width: 44px; height: 100vh; "
    "}\n"
    ".slider input::-moz-range-thumb { width: 44px; height: 100%; border: 0; }\n"
    ".divider { position: absolute; top: 0; bottom: 0; left: var(--at); width: 4px; "
    "margin-left: -2px; background: #fff; box-shadow: 0 0 0 1px #0008; pointer-events: none; }\n"
    ".divider::after { content: '\\2194'; position: absolute; top: 50%; left: 50%; width: 44px; "
    "height: 44px; transform: translate(-50%, -50%); border-radius: 50%; background: #fff; "
    "color: #111; font: 24px/44px system-ui, sans-serif; text-align: center; "
    "box-shadow: 0 0 0 1px #0008; }\n"
    ".slider input:focus-visible + .divider::after { outline: 4px solid #1d6fe0; "
    "outline-offset: 2px; box-shadow: 0 0 0 2px #fff, 0 0 0 7px #fff; }\n";

const char kSliderScript[] =
    "for (const input of document.querySelectorAll('.slider input')) {\n"
    "  const move = () => input.parentElement.style.setProperty('--at', input.value + '%');\n"
    "  input.addEventListener('input', move);\n"
    "  move();\n"
    "}\n";

const char kSliderScriptHash[] = "sha256-zIS2m6OEF+AKdy0refatAylTp/9YswseUnOo2HqNM/Y=";

std::string SliderHtml(const std::string& before, const std::string& after, int width, int height) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  // The slider is at most as high as the window, so that all of the pictures are visible.
  return "<div class=\"slider\" style=\"max-width: min(" + w + "px, 92vh * " + w + " / " + h +
         ")\">\n" + before + "<span class=\"tag\">Before</span>\n<div class=\"after\">" + after +
         "<span class=\"tag\">After</span></div>\n<input type=\"range\" min=\"0\" max=\"100\" "
         "step=\"any\" "
         "value=\"50\" aria-label=\"Divider: the picture before is left of it, and the picture "
         "after is right of it\">\n<div class=\"divider\"></div>\n</div>\n";
}

}  // namespace starfocus
