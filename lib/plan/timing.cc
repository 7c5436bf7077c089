// SPDX-License-Identifier: Apache-2.0
#include "lib/plan/timing.h"

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// Returns the number of taps in one quarter of the gathering filter of blur radius `radius`
// (kDisparityBits). A disc covers pi / 4 = 0.785 of its square. The factor is 51/64 = 0.797,
// because pixels at the rim count although the disc covers them only in part.
uint64_t GatherTaps(int32_t radius) {
  const int32_t size = (radius + (3 << kDisparityBits) / 2) >> kDisparityBits;
  return static_cast<uint64_t>((size + 1) * (size + 1) * 51 / 64);
}

}  // namespace

void AddScans(uint64_t views, uint64_t lines, const Content& content, int32_t layer,
              BlockWork* work) {
  // Layer L has 1 / 2^L as many lines as layer 0. Along a line of layer L, slopes start 1 / 2^L as
  // many runs, and gaps are 1 / 2^L as wide. The number of depth edges along a line is equal at all
  // layers.
  const uint64_t runs = (content.slopes >> 2 * layer) + (content.edges >> layer);
  work->span += views * lines + views * runs / kContentOne;
  work->hole += views * (content.gaps >> 2 * layer) / kContentOne;
}

uint64_t PredictTime(const starfocus_timing& timing, const BlockWork& work) {
  return timing.block + timing.field * work.field + timing.a * work.a + timing.b * work.b +
         timing.c * work.c + timing.upsample * work.upsample + timing.span * work.span +
         timing.hole * work.hole;
}

uint64_t PredictGather(const starfocus_timing& timing, uint64_t pixels, int32_t radius) {
  // The estimate assumes that each pixel costs 16 taps in addition to the taps of its radius. A tap
  // costs 1/64 of an upsampled pixel.
  return timing.upsample * pixels * (GatherTaps(radius) + 16) / 64;
}

// Coefficients block, field, a, b, c, upsample, span and hole, measured by `starfocus-lab
// calibrate` on an x86-64 processor with AVX-512. Separate coefficients for boards were tried,
// fitted to instruction counts of AArch64 and ARMv6. With the separate coefficients, block mode
// took between 1.7 % more and 0.4 % fewer instructions on these processors.
starfocus_timing DefaultTiming() { return {5659266, 0, 2354, 0, 106, 3266, 720, 507}; }

}  // namespace starfocus
