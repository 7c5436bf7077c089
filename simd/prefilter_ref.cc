// SPDX-License-Identifier: Apache-2.0
#include "simd/arithmetic_ref.h"
#include "simd/prefilter.h"

namespace starfocus::simd::reference {
namespace {

// The filter's sum around the sample at `at`, which may be negative.
int32_t FilterLine(const int32_t (&line)[5]) {
  const int32_t around = Mean(line[1], line[3]), far = Mean(line[0], line[4]);
  // An arithmetic shift rounds down.
  return Mean(line[2], around) + ((line[2] - far) >> 3);
}

}  // namespace

void Prefilter(int16_t* samples, size_t stride, size_t rows, size_t count) {
  constexpr size_t kAround = 2 * kPrefilterReach;
  constexpr int32_t kHalved = 2048;  // of the offset, which what is halved has already
  for (size_t y = 0; y + kAround < rows; ++y, samples += stride) {
    const auto along_column = [&](size_t n) {
      int32_t line[5];
      for (size_t k = 0; k < 5; ++k) line[k] = samples[k * stride + n];
      return (FilterLine(line) + 2 * kHalved + 1) >> kPrefilterBits;
    };
    for (size_t n = 0; n + 3 * kAround < count; ++n) {
      int32_t line[5];
      for (size_t k = 0; k < 5; ++k) line[k] = along_column(n + 3 * k);
      samples[n] = static_cast<int16_t>(FilterLine(line) + kPrefilterOffset - kHalved);
    }
  }
}

}  // namespace starfocus::simd::reference
