// SPDX-License-Identifier: Apache-2.0
// Padding that every buffer of a kernel must provide beyond its own samples.
#ifndef STARFOCUS_SIMD_PADDING_H_
#define STARFOCUS_SIMD_PADDING_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Number of bytes past the end of any source that kernels may read, since they process whole
// vectors. They may also add zero to as many bytes past the end of accumulators. The contents of
// those bytes do not affect results.
inline constexpr size_t kPadding = 64;

// Number of samples that kernels for surfaces, slices and cells process as one group. If a contract
// says that whole groups are read or written, a row of n samples needs SliceSamples(n) samples of
// memory.
inline constexpr size_t kSliceLanes = 16;
inline constexpr int32_t kStripColumns = static_cast<int32_t>(kSliceLanes);
constexpr size_t SliceSamples(size_t count) {
  return (count + kSliceLanes - 1) / kSliceLanes * kSliceLanes;
}

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PADDING_H_
