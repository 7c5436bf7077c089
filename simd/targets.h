// SPDX-License-Identifier: Apache-2.0
// Which SIMD targets Highway compiles for; comes before hwy/foreach_target.h.
#ifndef STARFOCUS_SIMD_TARGETS_H_
#define STARFOCUS_SIMD_TARGETS_H_

// Highway 1.0.3 truncates 16-bit numbers wrongly on AVX3_DL, which -march=native can bring in; AVX3
// stands in for it.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#endif

// Vectors emulated without SIMD, which clang has instead of single numbers, give other results.
#ifndef HWY_BROKEN_EMU128
#define HWY_BROKEN_EMU128 1
#endif

// An entry of a table: the kernel of that name that is declared where this stands.
#define STARFOCUS_ENTRY(Kernel) Kernel,

#endif  // STARFOCUS_SIMD_TARGETS_H_
