// SPDX-License-Identifier: Apache-2.0
// Lists the kernel tables of all SIMD targets that the program includes and this machine supports.
#ifndef STARFOCUS_TESTS_SUPPORT_SIMD_TARGETS_H_
#define STARFOCUS_TESTS_SUPPORT_SIMD_TARGETS_H_

#include <stdexcept>
#include <vector>

#include "simd/kernels.h"

namespace test {

// Returns the tables target(0), target(1) and so on, up to the first null pointer. Throws if the
// list is empty, since a test of no SIMD target must not pass.
template <class Table>
std::vector<const Table*> ListTargets(const Table* (*target)(size_t index)) {
  std::vector<const Table*> all;
  while (const Table* kernels = target(all.size())) all.push_back(kernels);
  if (all.empty()) throw std::runtime_error("no SIMD target of this program runs on this machine");
  return all;
}

// Returns the kernel tables of all SIMD targets, the best target first.
inline std::vector<const starfocus::simd::Kernels*> SimdTargets() {
  return ListTargets(starfocus::simd::KernelsOfTarget);
}
inline std::vector<const starfocus::simd::DepthKernels*> DepthTargets() {
  return ListTargets(starfocus::simd::DepthKernelsOfTarget);
}
inline std::vector<const starfocus::simd::ImageKernels*> ImageTargets() {
  return ListTargets(starfocus::simd::ImageKernelsOfTarget);
}
inline std::vector<const starfocus::simd::LineScanKernels*> LineScanTargets() {
  return ListTargets(starfocus::simd::LineScanKernelsOfTarget);
}
inline std::vector<const starfocus::simd::VideoKernels*> VideoTargets() {
  return ListTargets(starfocus::simd::VideoKernelsOfTarget);
}
inline std::vector<const starfocus::simd::WordKernels*> WordTargets() {
  return ListTargets(starfocus::simd::WordKernelsOfTarget);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_SIMD_TARGETS_H_
