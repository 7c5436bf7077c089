// SPDX-License-Identifier: Apache-2.0
// What every buffer that a kernel works on must provide beyond its own samples.
#ifndef STARFOCUS_SIMD_PADDING_H_
#define STARFOCUS_SIMD_PADDING_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Kernels work with whole vectors. They may read this many bytes past the end of any source, and
// add zero to as many bytes past the end of accumulators. Whatever those bytes hold changes no
// result.
inline constexpr size_t kPadding = 64;

// Samples that kernels of surfaces, slices and cells handle as one group. Where a contract says
// that they read or write whole groups, a row of n samples takes SliceSamples(n) of them in memory.
inline constexpr size_t kSliceLanes = 16;
inline constexpr int32_t kStripColumns = static_cast<int32_t>(kSliceLanes);
constexpr size_t SliceSamples(size_t count) {
  return (count + kSliceLanes - 1) / kSliceLanes * kSliceLanes;
}

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PADDING_H_
