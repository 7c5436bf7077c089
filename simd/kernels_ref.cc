// SPDX-License-Identifier: Apache-2.0
// Defines the tables of the references, for tests and for machines without SIMD.
#include "simd/depth_kernels.h"
#include "simd/image_kernels.h"
#include "simd/kernels.h"

namespace starfocus::simd {

#define STARFOCUS_DEFINE_REFERENCES(Table, LIST)                           \
  const Table& Reference##Table() {                                        \
    using namespace reference;                                             \
    static constexpr Table kernels = {"reference", LIST(STARFOCUS_ENTRY)}; \
    return kernels;                                                        \
  }

STARFOCUS_DEFINE_REFERENCES(Kernels, STARFOCUS_KERNELS)
STARFOCUS_DEFINE_REFERENCES(DepthKernels, STARFOCUS_DEPTH_KERNELS)
STARFOCUS_DEFINE_REFERENCES(ImageKernels, STARFOCUS_IMAGE_KERNELS)

}  // namespace starfocus::simd
