// SPDX-License-Identifier: Apache-2.0
// Generates two pictures on top of each other with a movable divider, for a page. Left of the
// divider the first picture is visible, and right of the divider the second picture.
#ifndef STARFOCUS_EXAMPLES_CLI_VIEW_SLIDER_H_
#define STARFOCUS_EXAMPLES_CLI_VIEW_SLIDER_H_

#include <string>

namespace starfocus {

// CSS rules of the slider. The rules use the colours of the page (page.cc).
extern const char kSliderStyle[];

// Script that moves the divider, and its hash for the content security policy of the page. Without
// the script, the divider stays in the middle.
extern const char kSliderScript[];
extern const char kSliderScriptHash[];

// Returns HTML of the slider. `before` and `after` are <img> elements of `width` x `height` pixels.
std::string SliderHtml(const std::string& before, const std::string& after, int width, int height);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIEW_SLIDER_H_
