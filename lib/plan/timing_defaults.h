// Built-in coefficients of the timing model, in picoseconds, by architecture.
//
// x86-64: measured by `starfocus calibrate` on a processor with AVX-512. All others: no board was
// at hand. They come from the number of instructions that `starfocus calibrate --counter` counts on
// an emulated board, each taken as 250 ps; what memory costs is not in them. `./do coefficients`
// writes their lines anew. On a board of your own, calibrate and hand the result to the engine.
#ifndef STARFOCUS_LIB_PLAN_TIMING_DEFAULTS_H_
#define STARFOCUS_LIB_PLAN_TIMING_DEFAULTS_H_

#include "starfocus/starfocus.h"

namespace starfocus {

struct NamedTiming {
  const char* name;  // as in `./do cross`
  sf_timing timing;  // block, field, a, b, c, upsample, span, hole
};

inline constexpr NamedTiming kBuiltInTimings[] = {
    {"x86-64", {5659266, 0, 2354, 0, 106, 3266, 720, 507}},
    {"aarch64", {0, 0, 26372, 0, 1793, 18114, 0, 11406}},
    {"armhf", {0, 0, 36900, 0, 2432, 24672, 0, 13551}},
    {"armv6", {0, 0, 165589, 0, 27576, 104061, 0, 74953}},
    {"riscv64", {0, 0, 247915, 0, 42508, 173399, 0, 100188}},
};

// The index of the architecture this is compiled for; unknown ones are taken for x86-64.
#if defined(__aarch64__)
inline constexpr int kOwnTiming = 1;
#elif defined(__arm__) && defined(__ARM_NEON)
inline constexpr int kOwnTiming = 2;
#elif defined(__arm__)
inline constexpr int kOwnTiming = 3;
#elif defined(__riscv)
inline constexpr int kOwnTiming = 4;
#else
inline constexpr int kOwnTiming = 0;
#endif

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_TIMING_DEFAULTS_H_
