// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "simd/matting.h"
#include "tests/kernels/kernel_cases.h"

namespace test::depth_cases {

// Pixels with few or many colours and disparities, so that similar colours are frequent.
void SumVotes(Draw* draw, DepthCall* call) {
  const int reach = draw->Int(0, 17);
  int step = draw->timed() ? 2 : draw->Int(1, 3);
  while (2 * reach / step >= kMostVoteSide) ++step;
  const ptrdiff_t stride = ptrdiff_t(kSliceLanes) + 2 * reach + draw->Int(0, 9);
  const size_t samples = size_t(stride) * size_t(2 * reach + 1);
  const size_t own = size_t(stride) * size_t(reach) + size_t(reach);
  const int spread = draw->Int(0, 383), rarity = draw->timed() ? 1 : draw->Int(1, 9);
  std::array<const int16_t*, 3> colours;
  for (const int16_t*& colour : colours) {
    colour =
        call->Input("colour",
                    Filled<int16_t>(samples, [&] { return int16_t(draw->Int(-spread, spread)); })) +
        own;
  }
  const auto disparity = [&] { return int16_t(draw->Int(-100, 100)); };
  const int16_t* surface = call->Input("surface", Filled<int16_t>(samples, disparity)) + own;
  const int16_t* trust =
      call->Input(
          "trust",
          Filled<int16_t>(
              samples,
              [&] { return int16_t(draw->Int(1, rarity) > 1 ? 0 : draw->Int(0, kMostTrust)); })) +
      own;
  const int16_t* middle = call->Input("middle", Filled<int16_t>(kSliceLanes, disparity));
  const int16_t* closeness =
      call->Input("closeness", Filled<int16_t>(kMostVoteSide * kMostVoteSide, [&] {
                    return int16_t(draw->Int(0, kMostCloseness * kClosenessUnit));
                  }));
  auto* sums = call->Results<uint16_t>("sums", 4 * kSliceLanes);
  call->Runs([=](const DepthKernels& kernels) {
    VoteSums votes;
    kernels.SumVotes(colours.data(), surface, trust, middle, stride, reach, step, closeness,
                     &votes);
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
