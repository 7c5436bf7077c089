// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernel in simd/composite.h.
#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {

// The coverage of a pixel mostly equals the coverage of the previous pixel; otherwise it is full,
// zero, arbitrary or near the limit. In the benchmark, coverage changes from pixel to pixel as
// seldom as in pictures.
void FinishComposite(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedSamples / 3), whole = SliceSamples(count);
  const size_t plane = whole + draw->Size(0, 5, 0);
  const auto least = uint32_t(draw->Int(1, 90000));
  const int bits = draw->Int(kLightBits, 24);
  const uint32_t all = 4 * least + uint32_t(draw->Int(0, 5));
  std::vector<uint32_t> values(3 * plane + whole);
  uint32_t covered = all;
  for (size_t n = 0; n < whole; ++n) {
    const int kind = draw->Int(0, draw->timed() ? 199 : 19);
    if (kind < 2) covered = all;
    if (kind == 2) covered = 0;
    if (kind == 3) covered = uint32_t(draw->Int(0, int(all)));
    if (kind == 4) covered = least - uint32_t(draw->Int(0, 1));
    values[3 * plane + n] = covered;
    for (size_t c = 0; c < 3; ++c) {
      const int colour = kind == 5 ? 256 : kind == 6 ? 255 : draw->Int(0, 255);
      values[c * plane + n] = uint32_t(uint64_t{covered} * uint64_t(colour) / 256);
    }
  }
  const uint32_t* sums = call->Input("sums", values);
  for (size_t c = 0; c < 4; ++c) {
    call->Ignore(sums + c * plane + count, (c < 3 ? plane : whole) - count);
  }
  const int16_t* centre = call->Input("centre", Light(3 * count, draw), kPadding);
  auto* out = call->Results<uint32_t>("out", 3 * count);
  call->Runs([=](const Kernels& kernels) {
    kernels.FinishComposite(sums, plane, centre, least, bits, count, out);
  });
  call->is_right = [=](uint64_t, Met* met) {
    for (size_t n = 0; n < count; ++n) {
      (*met)[sums[3 * plane + n] < least ? "missing" : "covered"] += 1;
    }
    return true;
  };
}

}  // namespace test::kernel_cases
