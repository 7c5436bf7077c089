// SPDX-License-Identifier: Apache-2.0
#include "simd/matting.h"
#include "tests/simd/kernel_cases.h"

namespace test::depth_cases {

// Pixels with few or many colours and disparities, so that similar colours are frequent.
void SumVotes(Draw* draw, DepthCall* call) {
  VoteRows rows = {};
  rows.reach = draw->Int(0, 17);
  rows.step = draw->timed() ? 2 : draw->Int(1, 3);
  while (2 * rows.reach / rows.step >= kMostVoteSide) ++rows.step;
  rows.stride = ptrdiff_t(kSliceLanes) + 2 * rows.reach + draw->Int(0, 9);
  const size_t samples = size_t(rows.stride) * size_t(2 * rows.reach + 1);
  const size_t own = size_t(rows.stride) * size_t(rows.reach) + size_t(rows.reach);
  const int spread = draw->Int(0, 383), rarity = draw->timed() ? 1 : draw->Int(1, 9);
  for (const int16_t*& colour : rows.colour) {
    colour =
        call->Input("colour",
                    Filled<int16_t>(samples, [&] { return int16_t(draw->Int(-spread, spread)); })) +
        own;
  }
  const auto disparity = [&] { return int16_t(draw->Int(-100, 100)); };
  rows.surface = call->Input("surface", Filled<int16_t>(samples, disparity)) + own;
  rows.trust =
      call->Input(
          "trust",
          Filled<int16_t>(
              samples,
              [&] { return int16_t(draw->Int(1, rarity) > 1 ? 0 : draw->Int(0, kMostTrust)); })) +
      own;
  rows.middle = call->Input("middle", Filled<int16_t>(kSliceLanes, disparity));
  rows.closeness = call->Input("closeness", Filled<int16_t>(kMostVoteSide * kMostVoteSide, [&] {
                                 return int16_t(draw->Int(0, kMostCloseness * kClosenessUnit));
                               }));
  auto* sums = call->Results<uint16_t>("sums", 4 * kSliceLanes);
  call->Runs([=](const DepthKernels& kernels) {
    VoteSums votes;
    kernels.SumVotes(rows, &votes);
    for (size_t n = 0; n < kSliceLanes; ++n) {
      for (size_t side = 0; side < 2; ++side) {
        sums[2 * side * kSliceLanes + n] = votes.similar[side][n];
        sums[(2 * side + 1) * kSliceLanes + n] = votes.weight[side][n];
      }
    }
  });
  // No sample counts more than with equal colours.
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(2 * kSliceLanes, [&](size_t k) {
      const size_t at = k / kSliceLanes * 2 * kSliceLanes + k % kSliceLanes;
      ++(*met)[sums[at] == 0 ? "none" : "similar"];
      return 16 * sums[at] <= kMostSimilar * sums[at + kSliceLanes];
    });
  };
}

}  // namespace test::depth_cases
