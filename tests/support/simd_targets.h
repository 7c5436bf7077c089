// SPDX-License-Identifier: Apache-2.0
// The kernels of every SIMD target this program was built with and this machine runs.
#ifndef STARFOCUS_TESTS_SUPPORT_SIMD_TARGETS_H_
#define STARFOCUS_TESTS_SUPPORT_SIMD_TARGETS_H_

#include <stdexcept>
#include <vector>

#include "lib/engine/engine.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace test {

// Targets 0, 1, ... of `target`, at least one: a test that would run on none must not pass.
inline std::vector<const starfocus::simd::Kernels*> ListTargets(
    const starfocus::simd::Kernels* (*target)(size_t index)) {
  std::vector<const starfocus::simd::Kernels*> all;
  while (const starfocus::simd::Kernels* kernels = target(all.size())) all.push_back(kernels);
  if (all.empty()) throw std::runtime_error("no SIMD target of this program runs on this machine");
  return all;
}

// Best first.
inline std::vector<const starfocus::simd::Kernels*> SimdTargets() {
  return ListTargets(starfocus::simd::KernelsOfTarget);
}

// Makes an engine use other kernels than the machine's best. Undone by sf_init.
inline void UseKernels(const starfocus::simd::Kernels* kernels, sf_engine* engine) {
  reinterpret_cast<starfocus::EngineState*>(engine)->kernels = kernels;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_SIMD_TARGETS_H_
