// SPDX-License-Identifier: Apache-2.0
// Compiles the table of the line scan's kernels for every SIMD target.
#include "simd/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/line_scan.cc"
#include "simd/targets.h"  // compiles this file again for each other SIMD target

#define STARFOCUS_TABLE LineScanKernels
#include "simd/line_scan-inl.h"

#define STARFOCUS_LIST STARFOCUS_LINE_SCAN_KERNELS
#include "simd/table-inl.h"
