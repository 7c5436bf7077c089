// SPDX-License-Identifier: Apache-2.0
// In place of kernels.cc and image_kernels.cc where kernels are a WebAssembly module of their own,
// so that one engine serves machines with and without SIMD. Whoever loads that module into the same
// memory says where its tables are, before the engine is used. See platform/web.
#include "simd/image_kernels.h"
#include "simd/kernels.h"

namespace starfocus::simd {
namespace {

const Kernels* kernels;
const ImageKernels* image_kernels;

}  // namespace

const Kernels& BestKernels() { return *kernels; }
const ImageKernels& BestImageKernels() { return *image_kernels; }

extern "C" {

__attribute__((export_name("use_kernels"))) void UseKernels(const Kernels* table,
                                                            const ImageKernels* image_table) {
  kernels = table;
  image_kernels = image_table;
}

}  // extern "C"

}  // namespace starfocus::simd
