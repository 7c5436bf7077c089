// SPDX-License-Identifier: Apache-2.0
// Defines the number of rounds of tests with random cases.
#ifndef STARFOCUS_TESTS_SUPPORT_ROUNDS_H_
#define STARFOCUS_TESTS_SUPPORT_ROUNDS_H_

namespace test {

// Returns the number of rounds that a test executes on this machine. Emulators are twenty times
// slower, so tests execute a quarter of their rounds on emulators. A quarter of the rounds
// suffices: native builds, whose bytes must be equal, execute all rounds.
constexpr int Rounds(int all) { return STARFOCUS_EMULATED ? (all + 3) / 4 : all; }

// True if this build is much slower than a native build, because the build is emulated or checks
// every range.
#ifdef STARFOCUS_CHECK_RANGES
inline constexpr bool kSlow = true;
#else
inline constexpr bool kSlow = STARFOCUS_EMULATED;
#endif

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_ROUNDS_H_
