// SPDX-License-Identifier: Apache-2.0
// Sets captured views in windows that tests make.
#ifndef STARFOCUS_TESTS_SUPPORT_STAR_VIEWS_H_
#define STARFOCUS_TESTS_SUPPORT_STAR_VIEWS_H_

#include <vector>

#include "lib/io/window.h"
#include "lib/optics/view_set.h"

namespace test {

inline void SetViews(const starfocus_config& config, starfocus::Window* window) {
  starfocus::ViewSet views;
  starfocus::FindViews(config.views, config.positions, config.problem, &views);
  window->views = config.views;
  window->occlusion_views = starfocus::ChooseOcclusionViews(views);
}

// Makes `window` read the views from planes of codes. `planes` must outlive the window.
inline void ReadPlanes(starfocus::PlaneViews* planes, starfocus::Window* window) {
  planes->kernels = &starfocus::simd::BestKernels();
  planes->transfer = window->transfer;
  window->reader = starfocus::ReaderOf(*planes);
  window->centre = planes->view[0];
}

// Sets the views of `window` to the star set of 1, 5, 9 or 17 views.
inline void SetStar(int views, starfocus::Window* window) {
  starfocus_config config = {};
  config.views = views;
  SetViews(config, window);
}

// Sets the views of `window` to the centre view and side views at the positions `sides`.
inline void SetPositions(const std::vector<starfocus_position>& sides, starfocus::Window* window) {
  starfocus_config config = {};
  config.views = 1;
  for (const starfocus_position& position : sides) config.positions[config.views++] = position;
  SetViews(config, window);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_STAR_VIEWS_H_
