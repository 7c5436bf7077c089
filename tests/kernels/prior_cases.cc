// SPDX-License-Identifier: Apache-2.0
#include "simd/paths.h"
#include "tests/kernels/kernel_cases.h"

namespace test::depth_cases {
namespace {

std::vector<uint8_t> Priors(size_t count, Draw* draw) {
  return Filled<uint8_t>(
      count, [&] { return draw->Int(0, 3) == 0 ? draw->Int(0, kMostPrior) : kMostPrior; });
}

}  // namespace

void PropagatePrior(Draw* draw, DepthCall* call) {
  const size_t places = kSliceLanes * draw->Size(1, 4, 4), count = draw->Length(1, 40, 200);
  const size_t size = places * count;
  const ptrdiff_t step = draw->Int(0, 1) == 0 ? 1 : -1;
  const size_t first = step > 0 ? 0 : size - places;
  auto* prior = call->Results<uint8_t>("prior", size);
  const std::vector<uint8_t> own = Priors(size, draw);
  std::copy(own.begin(), own.end(), prior);
  const uint8_t* before = nullptr;
  if (!draw->Rarely(4)) before = call->Input("before", Priors(size, draw)) + first;
  call->Runs([=](const DepthKernels& kernels) {
    kernels.PropagatePrior(prior + first, before, places, step, count);
  });
  // PropagatePrior must not increase the cost of any label.
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(size, [&](size_t k) {
      ++(*met)[prior[k] < own[k] ? "lessened" : "as it was"];
      return prior[k] <= own[k];
    });
  };
}

void AddPrior(Draw* draw, DepthCall* call) {
  const size_t count = kSliceLanes * draw->Length(1, 9, 64);
  const uint8_t* prior = call->Input("prior", Priors(count, draw));
  auto* cost = call->Results<uint8_t>("cost", count);
  call->Runs([=](const DepthKernels& kernels) { kernels.AddPrior(prior, count, cost); });
}

}  // namespace test::depth_cases
