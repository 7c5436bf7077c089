// SPDX-License-Identifier: Apache-2.0
// Random light fields and lenses of all kinds, each identified by its seed. The tests compare the
// engine with the double-precision reference on these trials.
#ifndef STARFOCUS_TESTS_CONFORMANCE_TRIAL_H_
#define STARFOCUS_TESTS_CONFORMANCE_TRIAL_H_

#include <cstdint>
#include <string>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/conformance.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace conformance {

struct Trial {
  test::Scene scene;
  starfocus::Params params;
  test::Config config;

  std::string Text() const;
};

// Makes the random trial that `seed` identifies. If `anywhere` is true, trials of the renderer
// slices have any number of views at any positions, instead of a star.
Trial MakeTrial(uint64_t seed, bool anywhere);

// Returns the largest allowed difference between the engine and the reference, in grey levels. With
// highlights, the allowed difference is larger, since codes are rounded before and after highlights
// are added.
int MostLevels(const Trial& trial);

// Returns the distance of the engine from the reference, which gets the engine's partition.
Distance Measure(const Trial& trial);

}  // namespace conformance

#endif  // STARFOCUS_TESTS_CONFORMANCE_TRIAL_H_
