// SPDX-License-Identifier: Apache-2.0
// Benchmarks of starfocus-bench-micro that measure more than one kernel.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_MICRO_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_MICRO_H_

#include <string>

#include "simd/kernels.h"

namespace starfocus::bench {

// Registers the benchmark of the deblocking filter.
void RegisterDeblocking();

// Registers the benchmark of the line scan, including the search for runs.
void RegisterLineScan(const simd::LineScanKernels* kernels);

// Registers benchmarks that refocus small pictures with one view in the modes blur, frame and
// block.
void RegisterWholePictures(const std::string& target);

// Registers benchmarks that measure the time per pixel of an ordinary picture and of the most
// expensive valid pictures.
void RegisterBounds();

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_MICRO_H_
