// The kernels of every SIMD target this program was built with and this machine runs.
#ifndef STARFOCUS_TESTS_SIMD_TARGETS_H_
#define STARFOCUS_TESTS_SIMD_TARGETS_H_

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "lib/engine.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace test {

// Best first, at least one: the program ends with a message otherwise, because a test that would
// run on no SIMD target must not pass.
inline std::vector<const starfocus::simd::Kernels*> SimdTargets() {
  std::vector<const starfocus::simd::Kernels*> all;
  while (const starfocus::simd::Kernels* kernels = starfocus::simd::KernelsOfTarget(all.size())) {
    all.push_back(kernels);
  }
  if (all.empty()) {
    std::fprintf(stderr, "no SIMD target of this program runs on this machine\n");
    std::exit(1);
  }
  return all;
}

// Makes an engine use other kernels than the machine's best. Undone by sf_init.
inline void UseKernels(const starfocus::simd::Kernels* kernels, sf_engine* engine) {
  reinterpret_cast<starfocus::EngineState*>(engine)->kernels = kernels;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SIMD_TARGETS_H_
