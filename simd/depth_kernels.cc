// SPDX-License-Identifier: Apache-2.0
// Compiles the table of the disparity map kernels for every SIMD target.
#include "simd/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/depth_kernels.cc"
#include "simd/targets.h"  // compiles this file again for each other SIMD target

#define STARFOCUS_TABLE DepthKernels
#include "simd/match-inl.h"
#include "simd/matting-inl.h"
#include "simd/paths-inl.h"

#define STARFOCUS_LIST STARFOCUS_DEPTH_KERNELS
#include "simd/table-inl.h"
