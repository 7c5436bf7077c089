// SPDX-License-Identifier: Apache-2.0
// The case of the kernel of simd/transpose.h.
#include <algorithm>

#include "tests/simd/kernel_cases.h"

namespace test::kernel_cases {

using starfocus::simd::Kernels;
using starfocus::simd::kTransposePadding;

void Transpose(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Length(1, 70, 32), columns = draw->Size(1, 40, 32);
  const size_t strip = draw->Rarely(2) ? 4 * size_t(draw->Int(1, 5)) : rows;  // rows at once
  const size_t in_stride = 3 * columns + size_t(draw->Int(0, 5));
  const size_t out_stride = 3 * rows + kTransposePadding + size_t(draw->Int(0, 5));
  const auto pixels = Bytes((rows - 1) * in_stride + 3 * columns, draw);
  const uint8_t* in = call->Input("in", pixels, starfocus::simd::kPadding);
  for (size_t y = 0; y + 1 < rows; ++y) {
    call->Ignore(in + y * in_stride + 3 * columns, in_stride - 3 * columns);
  }
  auto* out = call->Output<uint8_t>("out", columns * out_stride);
  for (size_t x = 0; x < columns; ++x) {
    call->Result(out + x * out_stride, 3 * rows);
    call->Free(out + x * out_stride + 3 * rows, kTransposePadding);
  }
  call->run = [=](const Kernels& kernels) -> uint64_t {
    for (size_t y = 0; y < rows; y += strip) {
      kernels.Transpose(in + y * in_stride, in_stride, std::min(strip, rows - y), columns,
                        out + 3 * y, out_stride);
    }
    return 0;
  };
  call->is_right = [=](uint64_t, Met* met) {
    (*met)["strips"] += strip < rows;
    bool right = true;
    for (size_t i = 0; i < 3 * rows * columns; ++i) {
      const size_t c = i % 3, x = i / 3 % columns, y = i / 3 / columns;
      right = right && out[x * out_stride + 3 * y + c] == in[y * in_stride + 3 * x + c];
    }
    return right;
  };
}

}  // namespace test::kernel_cases
