// SPDX-License-Identifier: Apache-2.0
// Rows of samples that SIMD kernels read and write: padding after the last sample, groups of
// samples, and fixed-point arithmetic that the references of several kernel families share.
#ifndef STARFOCUS_SIMD_SAMPLES_H_
#define STARFOCUS_SIMD_SAMPLES_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>

// Begins the definition of a reference, the plain C++ code that defines the result of a kernel. The
// vector code of every target calls references for rows that are shorter than a vector. References
// are not inlined there, because the library would grow by 13 %.
#define STARFOCUS_REFERENCE [[gnu::noinline]] inline

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

namespace reference {

inline int16_t Saturated(int32_t value) {
  return static_cast<int16_t>(value < INT16_MIN   ? INT16_MIN
                              : value > INT16_MAX ? INT16_MAX
                                                  : value);
}

// Returns the difference of two pixels, summed over R, G and B, whose planes are `plane` apart.
inline int ColourDistance(const uint8_t* a, const uint8_t* b, size_t plane) {
  int sum = 0;
  for (size_t c = 0; c < 3; ++c) sum += std::abs(a[c * plane] - b[c * plane]);
  return sum;
}

// Returns the mean of two numbers, rounded half up.
inline int32_t Mean(int32_t a, int32_t b) { return (a + b + 1) >> 1; }

// Returns the product of two numbers with 15 fractional bits, rounded half up.
inline int16_t Product15(int32_t a, int32_t b) {
  return static_cast<int16_t>((a * b + (1 << 14)) >> 15);
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SAMPLES_H_
