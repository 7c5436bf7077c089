// SPDX-License-Identifier: Apache-2.0
// Defines the number of rounds of tests with random cases.
#ifndef STARFOCUS_TESTS_SUPPORT_ROUNDS_H_
#define STARFOCUS_TESTS_SUPPORT_ROUNDS_H_

namespace test {

// Returns the number of rounds of a test. Emulators take twenty times as long and therefore execute
// a quarter of the rounds. A quarter suffices, since the bytes must equal the bytes of native
// builds, which execute all rounds.
constexpr int Rounds(int all) { return STARFOCUS_EMULATED ? (all + 3) / 4 : all; }

// True if this build is much slower than a native build, because it is emulated or checks every
// range.
#ifdef STARFOCUS_CHECK_RANGES
inline constexpr bool kSlow = true;
#else
inline constexpr bool kSlow = STARFOCUS_EMULATED;
#endif

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_ROUNDS_H_
