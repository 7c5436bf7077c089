// SPDX-License-Identifier: Apache-2.0
// What starfocus-bench-micro times beside the kernels themselves.
#ifndef STARFOCUS_TESTS_BENCH_MICRO_H_
#define STARFOCUS_TESTS_BENCH_MICRO_H_

#include <string>

#include "simd/kernels.h"

namespace starfocus::bench {

// What has no kernels.
void RegisterDeblocking();

// The line scan with the search for runs before it.
void RegisterLineScan(const simd::Kernels* kernels);

// Small pictures through the whole engine, by mode: "blur" is the ideal blur of one view.
void RegisterWholePictures(const std::string& target);

// The time per pixel of the most expensive legal pictures, beside an ordinary one.
void RegisterBounds();

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_MICRO_H_
