// SPDX-License-Identifier: Apache-2.0
// How often tests draw anew.
#ifndef STARFOCUS_TESTS_SUPPORT_ROUNDS_H_
#define STARFOCUS_TESTS_SUPPORT_ROUNDS_H_

namespace test {

// Rounds of a test with random cases: an emulator, which needs twenty times as long, does a quarter
// of them. The bytes are those of this machine, where all are done, natively and under sanitizers.
constexpr int Rounds(int all) { return STARFOCUS_EMULATED ? (all + 3) / 4 : all; }

// Whether this build takes much longer than a native one: emulated, or checking every range.
#ifdef STARFOCUS_CHECK_RANGES
inline constexpr bool kSlow = true;
#else
inline constexpr bool kSlow = STARFOCUS_EMULATED;
#endif

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_ROUNDS_H_
