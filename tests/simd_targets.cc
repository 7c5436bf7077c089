#include "tests/simd_targets.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hwy/highway.h"

namespace test {

using starfocus::simd::BestKernels;
using starfocus::simd::Kernels;

std::vector<const Kernels*> SimdTargets() {
  std::vector<const Kernels*> all;
#ifdef HWY_COMPILE_ONLY_STATIC
  all.push_back(&BestKernels());
#else
  for (int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    const Kernels* kernels = &BestKernels();
    bool known = false;
    for (const Kernels* other : all) known |= std::strcmp(other->name, kernels->name) == 0;
    if (!known) all.push_back(kernels);
  }
  hwy::SetSupportedTargetsForTest(0);
#endif
  if (all.empty()) {
    std::fprintf(stderr, "no SIMD target of this program runs on this machine\n");
    std::exit(1);
  }
  return all;
}

}  // namespace test
