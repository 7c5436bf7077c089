// SPDX-License-Identifier: Apache-2.0
// One table of kernels per SIMD target; Highway picks the best one of the machine.
#include "simd/kernels.h"

#include "simd/targets.h"  // before those of Highway

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels.cc"
#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"
#include "simd/cells-inl.h"
#include "simd/coverage-inl.h"
#include "simd/disc-inl.h"
#include "simd/disparities-inl.h"
#include "simd/finish_composite-inl.h"
#include "simd/hidden_fill-inl.h"
#include "simd/layered_depth-inl.h"
#include "simd/light-inl.h"
#include "simd/neighbourhood-inl.h"
#include "simd/resample-inl.h"
#include "simd/runs-inl.h"
#include "simd/slices-inl.h"
#include "simd/slope-inl.h"
#include "simd/spans-inl.h"
#include "simd/tiles-inl.h"

#ifndef STARFOCUS_TABLE
#define STARFOCUS_TABLE Kernels
#define STARFOCUS_LIST STARFOCUS_KERNELS
#define STARFOCUS_BEST BestKernels
#endif
#include "simd/table-inl.h"
