// SPDX-License-Identifier: Apache-2.0
// Random light fields and lenses of all kinds, each known by its seed, on which the engine is held
// to the double-precision reference.
#ifndef STARFOCUS_TESTS_CONFORMANCE_TRIAL_H_
#define STARFOCUS_TESTS_CONFORMANCE_TRIAL_H_

#include <cstdint>
#include <string>

#include "starfocus/starfocus.h"
#include "tests/conformance/conformance.h"
#include "tests/support/test_scene.h"

namespace conformance {

struct Trial {
  test::Scene scene;
  starfocus_params params;
  starfocus_config config;

  std::string Text() const;
};

// `anywhere`: its views, by the rule of subapertures, are any number at any positions, else a star.
Trial MakeTrial(uint64_t seed, bool anywhere);

// Gray levels that the engine may be from the reference: highlights are added to codes, which are
// rounded before and after it.
int MostLevels(const Trial& trial);

// How far the engine is from the reference, which is given the engine's partition.
Distance Measure(const Trial& trial);

}  // namespace conformance

#endif  // STARFOCUS_TESTS_CONFORMANCE_TRIAL_H_
