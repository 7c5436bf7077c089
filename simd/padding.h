// SPDX-License-Identifier: Apache-2.0
// Defines the padding that every buffer of a SIMD kernel must have after its last sample.
#ifndef STARFOCUS_SIMD_PADDING_H_
#define STARFOCUS_SIMD_PADDING_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Number of bytes past the end of a source that kernels may read. Kernels read past the end because
// they process whole vectors. Kernels may also add zeros to the first kPadding bytes after the end
// of accumulators. The contents of the padding do not affect results.
inline constexpr size_t kPadding = 64;

// Number of samples in a group. Kernels for surfaces, slices and cells process whole groups. If a
// contract says that whole groups are read or written, a row of n samples requires memory for
// SliceSamples(n) samples.
inline constexpr size_t kSliceLanes = 16;
inline constexpr int32_t kStripColumns = static_cast<int32_t>(kSliceLanes);
constexpr size_t SliceSamples(size_t count) {
  return (count + kSliceLanes - 1) / kSliceLanes * kSliceLanes;
}

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PADDING_H_
