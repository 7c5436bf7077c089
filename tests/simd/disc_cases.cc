// SPDX-License-Identifier: Apache-2.0
// The case of the kernel of simd/disc.h.
#include <algorithm>
#include <cstdlib>

#include "tests/simd/kernel_cases.h"

namespace test::kernel_cases {
namespace {

using starfocus::simd::Disc;
using starfocus::simd::Kernels;
using starfocus::simd::kMaxDisc;
using starfocus::simd::kPadding;

size_t OctantIndex(int x, int y) {
  const int high = std::max(std::abs(x), std::abs(y)), low = std::min(std::abs(x), std::abs(y));
  return size_t(high * (high + 1) / 2 + low);
}

// Any filter: weights of all sizes, rings of zeros outside, and as large a sum as may be. Four
// pixels that are weighed together sum to 15 bits at most.
Disc MakeDisc(Draw* draw, KernelCall* call) {
  const int size = int(draw->Size(0, kMaxDisc, 4)), pixels = (2 * size + 1) * (2 * size + 1);
  const int used = draw->Rarely(2) ? draw->Int(0, size) : size;
  const int largest = std::min(32767 / 4, (1 << 17) / pixels);
  const int most = draw->Rarely(2) ? draw->Int(1, largest) : largest;
  std::vector<uint16_t> weights(OctantIndex(size, size) + 1);
  for (int y = 0; y <= size; ++y) {
    for (int x = y; x <= size; ++x) {
      const bool zero = x > used || draw->Rarely(6);
      weights[OctantIndex(x, y)] = uint16_t(zero ? 0 : draw->Int(0, most));
    }
  }
  int64_t sum = 0;
  for (int y = -size; y <= size; ++y) {
    for (int x = -size; x <= size; ++x) sum += weights[OctantIndex(x, y)];
  }
  int bits = 1;
  while (int64_t{1} << bits < sum) ++bits;
  return {size, bits, call->Input("weights", weights)};
}

}  // namespace

void FilterDisc(Draw* draw, KernelCall* call) {
  const Disc disc = MakeDisc(draw, call);
  const size_t count = draw->Size(1, draw->Rarely(4) ? 400 : 60, 96);
  const size_t rows = draw->Size(1, 4, kTimedSamples / 96), around = size_t(disc.size);
  const size_t width = count + 6 * around, stride = width + size_t(draw->Int(0, 4));
  const size_t out_stride = count + size_t(draw->Int(0, 7));
  const int16_t* in =
      call->Input("in", Light((rows + 2 * around - 1) * stride + width, draw), kPadding);
  for (size_t y = 0; y + 1 < rows + 2 * around; ++y) {
    call->Ignore(in + y * stride + width, stride - width);
  }
  const int16_t* first = in + around * stride + 3 * around;
  const auto encoding = AnyEncoding(draw, call);
  auto* out = call->Output<uint8_t>("out", rows * out_stride);
  for (size_t y = 0; y < rows; ++y) call->Result(out + y * out_stride, count);
  call->run = [=](const Kernels& kernels) -> uint64_t {
    kernels.FilterDisc(first, stride, disc, encoding, rows, count, out, out_stride);
    return 0;
  };
}

}  // namespace test::kernel_cases
