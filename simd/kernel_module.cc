// SPDX-License-Identifier: Apache-2.0
// What a WebAssembly module of kernels alone tells whoever loads it for an engine: where its tables
// are, and how long. A table is the address of a name and then numbers of functions, in this
// module's own table of functions. See platform/web.
#include "simd/image_kernels.h"
#include "simd/kernels.h"

namespace {

#ifdef STARFOCUS_REFERENCE_KERNELS
const starfocus::simd::Kernels& Table() { return starfocus::simd::ReferenceKernels(); }
const starfocus::simd::ImageKernels& ImageTable() {
  return starfocus::simd::ReferenceImageKernels();
}
#else
const starfocus::simd::Kernels& Table() { return starfocus::simd::BestKernels(); }
const starfocus::simd::ImageKernels& ImageTable() { return starfocus::simd::BestImageKernels(); }
#endif

}  // namespace

extern "C" {

__attribute__((export_name("kernels"))) const void* KernelTable() { return &Table(); }
__attribute__((export_name("kernels_bytes"))) size_t KernelTableBytes() {
  return sizeof(starfocus::simd::Kernels);
}
__attribute__((export_name("image_kernels"))) const void* ImageKernelTable() {
  return &ImageTable();
}
__attribute__((export_name("image_kernels_bytes"))) size_t ImageKernelTableBytes() {
  return sizeof(starfocus::simd::ImageKernels);
}

}  // extern "C"
