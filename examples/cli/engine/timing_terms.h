// SPDX-License-Identifier: Apache-2.0
// Table of the terms of the timing model, for loops over all terms.
#ifndef STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_TERMS_H_
#define STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_TERMS_H_

#include <cstdint>

#include "lib/plan/renderer.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct TimingTerm {
  const char* name;
  uint32_t starfocus_timing::*coefficient;
  uint64_t BlockWork::*work;  // Amount of work in a block; null if each block is one unit.
  const char* unit;           // Unit of work to which the coefficient refers.
};

inline constexpr TimingTerm kTimingTerms[] = {
    {"block", &starfocus_timing::block, nullptr, "block"},
    {"field", &starfocus_timing::field, &BlockWork::field, "pixel of the extended block"},
    {"a", &starfocus_timing::a, &BlockWork::a, "rendered pixel of type A"},
    {"b", &starfocus_timing::b, &BlockWork::b, "rendered pixel of type B"},
    {"c", &starfocus_timing::c, &BlockWork::c, "rendered pixel of type C"},
    {"upsample", &starfocus_timing::upsample, &BlockWork::upsample, "upsampled pixel"},
    {"span", &starfocus_timing::span, &BlockWork::span, "stretch of a rendered line"},
    {"hole", &starfocus_timing::hole, &BlockWork::hole, "uncovered pixel"},
};
inline constexpr int kTimingTermCount = sizeof(kTimingTerms) / sizeof(kTimingTerms[0]);
static_assert(sizeof(starfocus_timing) == kTimingTermCount * sizeof(uint32_t), "every coefficient");

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_TERMS_H_
