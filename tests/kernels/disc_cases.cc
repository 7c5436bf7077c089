// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/gather.h.
#include <algorithm>
#include <cstdlib>

#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

size_t OctantIndex(int x, int y) {
  const int high = std::max(std::abs(x), std::abs(y)), low = std::min(std::abs(x), std::abs(y));
  return size_t(high * (high + 1) / 2 + low);
}

// Returns the smallest number of bits, at least 1, such that 2^bits is no less than the sum of all
// weights.
int BitsOf(int size, const std::vector<uint16_t>& weights) {
  int64_t sum = 0;
  for (int y = -size; y <= size; ++y) {
    for (int x = -size; x <= size; ++x) sum += weights[OctantIndex(x, y)];
  }
  int bits = 1;
  while (int64_t{1} << bits < sum) ++bits;
  return bits;
}

// Returns a random disc filter; its outer weights may be zero, and its sum of weights may reach the
// maximum. The weights of any four pixels sum to at most 15 bits, since kernels weight four pixels
// together.
Disc MakeDisc(Draw* draw, KernelCall* call) {
  const int size = int(draw->Size(0, kMaxDisc, 4));
  const int pixels = (2 * size + 1) * (2 * size + 1);
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
  return {size, BitsOf(size, weights), call->Input("weights", weights)};
}

// A disc filter, the rows of a picture that the disc filters, and the pixels around these rows.
struct Filtered {
  Disc disc;
  size_t out_stride;
  SampleRows in;

  Filtered(Draw* draw, KernelCall* call) : disc(MakeDisc(draw, call)) {
    const size_t count = draw->Size(1, draw->Rarely(4) ? 400 : 60, 96);
    const size_t rows = draw->Size(1, 4, kTimedSamples / 96);
    const size_t around = size_t(disc.size), width = count + 6 * around;
    const size_t stride = width + size_t(draw->Int(0, 4));
    out_stride = count + size_t(draw->Int(0, 7));
    const int16_t* samples =
        call->Input("in", Light((rows + 2 * around - 1) * stride + width, draw), kPadding);
    call->IgnoreRows(samples + width, rows + 2 * around - 1, stride, stride - width);
    in = {samples + around * stride + 3 * around, stride, rows, count};
  }

  template <class Sample>
  Sample* Output(KernelCall* call) const {
    auto* out = call->Output<Sample>("out", in.rows * out_stride);
    call->ResultRows(out, in.rows, out_stride, in.count);
    return out;
  }
};

}  // namespace

void FilterDisc(Draw* draw, KernelCall* call) {
  const Filtered filtered(draw, call);
  const auto encoding = AnyEncoding(draw, call);
  auto* out = filtered.Output<uint8_t>(call);
  call->Runs([=](const Kernels& kernels) {
    kernels.FilterDisc(filtered.in, filtered.disc, encoding, out, filtered.out_stride);
  });
}

void FilterDiscLayer(Draw* draw, KernelCall* call) {
  const Filtered filtered(draw, call);
  auto* out = filtered.Output<int16_t>(call);
  call->Runs([=](const Kernels& kernels) {
    kernels.FilterDiscLayer(filtered.in, filtered.disc, out, filtered.out_stride);
  });
}

// In FilterTwoDiscs, disc `less` takes most weights from disc `more`, and has a few weights where
// `more` has zeros.
void FilterTwoDiscs(Draw* draw, KernelCall* call) {
  const Filtered filtered(draw, call);
  const Disc& more = filtered.disc;
  Disc less = more;
  less.size = draw->Int(0, more.size);
  std::vector<uint16_t> weights(OctantIndex(less.size, less.size) + 1);
  for (size_t k = 0; k < weights.size(); ++k) {
    weights[k] = draw->Rarely(6) ? uint16_t(0) : more.weights[k];
    if (weights[k] == 0 && draw->Rarely(3)) weights[k] = 1;
  }
  less.bits = BitsOf(less.size, weights);
  less.weights = call->Input("weights of less", weights);
  auto *out_less = filtered.Output<int16_t>(call), *out_more = filtered.Output<int16_t>(call);
  call->Runs([=](const Kernels& kernels) {
    kernels.FilterTwoDiscs(filtered.in, less, more, out_less, out_more, filtered.out_stride);
  });
}

}  // namespace test::kernel_cases
