// SPDX-License-Identifier: Apache-2.0
// Openings of lenses for tests: random openings, and one opening of each kind.
#ifndef STARFOCUS_TESTS_SUPPORT_SHAPES_H_
#define STARFOCUS_TESTS_SUPPORT_SHAPES_H_

#include <cstdio>
#include <string>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/test_scene.h"

namespace test {

// Sets a random shape, with or without a cat's eye. With a probability of one half, a parameter is
// at an end of its range.
inline void RandomShape(starfocus_params* lens, Random* random) {
  const auto often_an_end = [&](double low, double high) {
    const int end = random->Int(0, 3);
    return static_cast<float>(end == 0 ? low : end == 1 ? high : random->Real(low, high));
  };
  lens->shape = random->Int(STARFOCUS_SHAPE_FALL_OFF, STARFOCUS_SHAPE_RING);
  lens->blades = random->Int(STARFOCUS_MIN_BLADES, STARFOCUS_MAX_BLADES);
  lens->rotation = often_an_end(0, 360) - (random->Int(0, 1) == 0 ? 360.0F : 0.0F);
  lens->curvature = often_an_end(0, 1);
  lens->ring_inner = often_an_end(0, STARFOCUS_MAX_RING_INNER);
  if (random->Int(0, 2) == 0) lens->cats_eye = often_an_end(0, 1);
}

// Sets STARFOCUS_FEATURE_SHAPES if the lens requires this feature, and clears this feature
// otherwise.
inline void ReserveFor(const starfocus::Params& lens, starfocus_config* config) {
  const bool needed = lens.shape == STARFOCUS_SHAPE_POLYGON || lens.cats_eye > 0;
  SetFeature(STARFOCUS_FEATURE_SHAPES, needed, &config->features);
}

inline std::string ShapeText(const starfocus::Params& lens) {
  char text[200];
  std::snprintf(text, sizeof(text),
                "shape %d, blades %d, rotation %.9g, curvature %.9g, inner %.9g, cats_eye %.9g",
                lens.shape, lens.blades, lens.rotation, lens.curvature, lens.ring_inner,
                lens.cats_eye);
  return text;
}

// One lens of each kind except the default lens.
struct NamedShape {
  const char* name;
  int shape, blades;
  float rotation, curvature, inner, cats_eye;

  void Set(starfocus_params* lens) const {
    lens->shape = shape;
    lens->blades = blades;
    lens->rotation = rotation;
    lens->curvature = curvature;
    lens->ring_inner = inner;
    lens->cats_eye = cats_eye;
  }
};
inline constexpr NamedShape kShapes[] = {
    {"disc", STARFOCUS_SHAPE_DISC, 5, 0, 0, 0.5F, 0},
    {"pentagon", STARFOCUS_SHAPE_POLYGON, 5, 0, 0, 0.5F, 0},
    {"curved-hexagon", STARFOCUS_SHAPE_POLYGON, 6, 17.5F, 0.5F, 0.5F, 0},
    {"ring", STARFOCUS_SHAPE_RING, 5, 0, 0, 0.5F, 0},
    {"cats-eye", STARFOCUS_SHAPE_FALL_OFF, 5, 0, 0, 0.5F, 0.75F},
    {"pentagon-cats-eye", STARFOCUS_SHAPE_POLYGON, 5, 0, 0, 0.5F, 0.5F}};

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_SHAPES_H_
