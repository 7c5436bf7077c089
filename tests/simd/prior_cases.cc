// SPDX-License-Identifier: Apache-2.0
#include "simd/prior.h"
#include "tests/simd/depth_cases.h"

namespace test::depth_cases {
namespace {

std::vector<uint8_t> Priors(size_t count, Draw* draw) {
  std::vector<uint8_t> priors(count);
  for (uint8_t& prior : priors) {
    prior = draw->Int(0, 3) == 0 ? uint8_t(draw->Int(0, kMostPrior)) : kMostPrior;
  }
  return priors;
}

}  // namespace

void SpreadPrior(Draw* draw, DepthCall* call) {
  const size_t places = kSliceLanes * draw->Size(1, 4, 4), count = draw->Length(1, 40, 200);
  const size_t size = places * count;
  PriorRow row = {};
  row.places = places;
  row.count = count;
  row.step = draw->Int(0, 1) == 0 ? 1 : -1;
  const size_t first = row.step > 0 ? 0 : size - places;
  uint8_t* prior = call->Output<uint8_t>("prior", size);
  call->Result(prior, size);
  const std::vector<uint8_t> own = Priors(size, draw);
  std::copy(own.begin(), own.end(), prior);
  row.prior = prior + first;
  if (!draw->Rarely(4)) row.before = call->Input("before", Priors(size, draw)) + first;
  call->Runs([=](const DepthKernels& kernels) { kernels.SpreadPrior(row); });
  // No label costs more than it did, nor more than it costs the pixel before it, and the way.
  call->is_right = [=](uint64_t, Met* met) {
    for (size_t k = 0; k < size; ++k) {
      if (prior[k] > own[k]) return false;
      ++(*met)[prior[k] < own[k] ? "lessened" : "as it was"];
    }
    return true;
  };
}

void AddPrior(Draw* draw, DepthCall* call) {
  const size_t count = kSliceLanes * draw->Length(1, 9, 64);
  const uint8_t* prior = call->Input("prior", Priors(count, draw));
  uint8_t* cost = call->Output<uint8_t>("cost", count);
  call->Result(cost, count);
  call->Runs([=](const DepthKernels& kernels) { kernels.AddPrior(prior, count, cost); });
}

}  // namespace test::depth_cases
