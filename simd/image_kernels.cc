// SPDX-License-Identifier: Apache-2.0
// Compiles the table of the picture and depth map conversion kernels for every SIMD target.
#include "simd/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/image_kernels.cc"
#include "simd/targets.h"  // compiles this file again for each other SIMD target

#define STARFOCUS_TABLE ImageKernels
#include "simd/depth_values-inl.h"
#include "simd/pixels-inl.h"

#define STARFOCUS_LIST STARFOCUS_IMAGE_KERNELS
#include "simd/table-inl.h"
