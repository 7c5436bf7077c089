// SPDX-License-Identifier: Apache-2.0
// Tests and sets bits of test::Config.features.
#ifndef STARFOCUS_TESTS_SUPPORT_FEATURES_H_
#define STARFOCUS_TESTS_SUPPORT_FEATURES_H_

#include <cstdint>

#include "tests/support/config.h"

namespace test {

inline bool Has(uint32_t features, uint32_t feature) { return (features & feature) != 0; }

inline void SetFeature(uint32_t feature, bool on, uint32_t* features) {
  *features = on ? *features | feature : *features & ~feature;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_FEATURES_H_
