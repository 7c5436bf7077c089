// SPDX-License-Identifier: Apache-2.0
// Sets captured views in inputs that tests make.
#ifndef STARFOCUS_TESTS_SUPPORT_STAR_VIEWS_H_
#define STARFOCUS_TESTS_SUPPORT_STAR_VIEWS_H_

#include <vector>

#include "lib/io/input.h"
#include "lib/optics/view_set.h"
#include "tests/support/config.h"

namespace test {

inline void SetViews(const test::Config& config, starfocus::Input* input) {
  starfocus::ViewSet views;
  starfocus::FindViews(config.views, config.positions, nullptr, &views);
  input->views = config.views;
  input->occlusion_views = starfocus::ChooseOcclusionViews(views);
}

// Sets the pixels of a view: rows of packed RGB codes, which must outlive `input`.
inline void SetPixels(int view, const std::vector<uint8_t>& codes, size_t stride,
                      starfocus::Input* input) {
  input->kernels = &starfocus::simd::BestKernels();
  input->images[view].planes[0] = codes.data();
  input->images[view].strides[0] = stride;
  if (view == 0) input->centre = {codes.data(), stride, 0, 0};
}

// Sets the views of `input` to the star set of 1, 5, 9 or 17 views.
inline void SetStar(int views, starfocus::Input* input) {
  test::Config config;
  config.views = views;
  SetViews(config, input);
}

// Sets the views of `input` to the centre view and side views at the positions `sides`.
inline void SetPositions(const std::vector<starfocus_position>& sides, starfocus::Input* input) {
  test::Config config;
  config.views = 1;
  for (const starfocus_position& position : sides) config.positions[config.views++] = position;
  SetViews(config, input);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_STAR_VIEWS_H_
