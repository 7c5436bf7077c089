// SPDX-License-Identifier: Apache-2.0
// Compiles the table of the kernels of 16-bit words for every SIMD target.
#include "simd/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/word_kernels.cc"
#include "simd/targets.h"  // compiles this file again for each other SIMD target

#define STARFOCUS_TABLE WordKernels
#include "simd/words-inl.h"

#define STARFOCUS_LIST STARFOCUS_WORD_KERNELS
#include "simd/table-inl.h"
