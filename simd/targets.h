// SPDX-License-Identifier: Apache-2.0
// Selects the SIMD targets for which Highway compiles a table of kernels. A unit defines
// HWY_TARGET_INCLUDE as its own file name and then includes this header, before any other header of
// Highway.
#ifndef STARFOCUS_SIMD_TARGETS_H_
#define STARFOCUS_SIMD_TARGETS_H_

// Highway 1.0.3 truncates 16-bit numbers incorrectly on target AVX3_DL, which -march=native may
// enable. Target AVX3 replaces AVX3_DL.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#endif

// Without SIMD, clang uses emulated vectors in place of scalars, and the emulated vectors give
// different results.
#ifndef HWY_BROKEN_EMU128
#define HWY_BROKEN_EMU128 1
#endif

#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"

// Oldest supported version of Highway, as stated in cmake/highway.cmake and docs/developing.md.
#if HWY_MAJOR * 1000000 + HWY_MINOR * 1000 + HWY_PATCH < 1000003
#error "Highway: unsupported version (expected 1.0.3 or newer)"
#endif

#endif  // STARFOCUS_SIMD_TARGETS_H_
