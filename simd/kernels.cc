// SPDX-License-Identifier: Apache-2.0
// Compiles the table of the engine's kernels for every SIMD target.
#include "simd/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels.cc"
#include "simd/targets.h"  // compiles this file again for each other SIMD target

#define STARFOCUS_TABLE Kernels
#include "simd/cells-inl.h"
#include "simd/composite-inl.h"
#include "simd/disparities-inl.h"
#include "simd/finish_composite-inl.h"
#include "simd/gather-inl.h"
#include "simd/hidden_fill-inl.h"
#include "simd/layered_depth-inl.h"
#include "simd/light-inl.h"
#include "simd/matting-inl.h"
#include "simd/resample-inl.h"
#include "simd/slices-inl.h"

#define STARFOCUS_LIST STARFOCUS_KERNELS
#include "simd/table-inl.h"
