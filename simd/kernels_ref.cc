// SPDX-License-Identifier: Apache-2.0
#include "simd/kernels.h"
#include "simd/targets.h"

namespace starfocus::simd {

const Kernels& ReferenceKernels() {
  using namespace reference;
  static constexpr Kernels kernels = {"reference", STARFOCUS_KERNELS(STARFOCUS_ENTRY)};
  return kernels;
}

}  // namespace starfocus::simd
