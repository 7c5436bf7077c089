// SPDX-License-Identifier: Apache-2.0
// Compiles the table of the kernels for videos for every SIMD target.
#include "simd/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/video_kernels.cc"
#include "simd/targets.h"  // compiles this file again for each other SIMD target

#define STARFOCUS_TABLE VideoKernels
#include "simd/motion-inl.h"

#define STARFOCUS_LIST STARFOCUS_VIDEO_KERNELS
#include "simd/table-inl.h"
