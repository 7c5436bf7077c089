// SPDX-License-Identifier: Apache-2.0
// Cases of the kernels of simd/hidden_fill.h.
#include <algorithm>

#include "tests/simd/kernel_cases.h"

namespace test::kernel_cases {
namespace {

constexpr size_t kTimedWidth = 192;

// Where a hidden surface was found: by views, or repeated from any distance, a short one as a rule.
uint16_t AnySource(Draw* draw) {
  const int distance = draw->Int(0, 2) == 0 ? 0 : draw->Int(1, draw->Rarely(5) ? 255 : 20);
  return uint16_t(distance << kSourceDistance | draw->Int(1, 255));
}

std::vector<uint16_t> AnySources(size_t count, Draw* draw) {
  std::vector<uint16_t> sources(count);
  for (uint16_t& source : sources) source = AnySource(draw);
  return sources;
}

// Surfaces behind those of `before`, some of which are not there; rarely in another order.
std::vector<int16_t> Behind(const std::vector<int16_t>& before, Draw* draw) {
  std::vector<int16_t> behind(before.size(), kNoSurface);
  for (size_t n = 0; n < before.size(); ++n) {
    if (before[n] == kNoSurface || draw->Int(0, 1) == 0) continue;
    const int depth = draw->Rarely(10) ? draw->Int(-60, 0) : draw->Int(1, 700);
    behind[n] = int16_t(std::clamp(before[n] - depth, -32000, 32000));
  }
  return behind;
}

std::vector<uint8_t> Shares(size_t count, Draw* draw) {
  std::vector<uint8_t> shares(count);
  for (uint8_t& share : shares) {
    const int kind = draw->Int(0, 2);
    share = kind == 0 ? kSliceEnd : uint8_t(kind == 1 ? kSliceWhole : draw->Int(1, kSliceWhole));
  }
  return shares;
}

// A row of farthest surfaces that is written.
FarRow OutputOf(size_t whole, Draw* draw, KernelCall* call) {
  const size_t plane = whole + draw->Size(0, 9, 0);
  const FarRow far = {call->Output<int16_t>("far disparity", whole),
                      call->Output<int16_t>("far rgb", 3 * plane),
                      call->Output<uint16_t>("far source", whole), plane};
  call->Result(far.disparity, whole);
  call->Result(far.source, whole);
  for (size_t c = 0; c < 3; ++c) call->Result(far.rgb + c * plane, whole);
  return far;
}

}  // namespace

void TakeFarthest(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedWidth), whole = SliceSamples(count);
  SourcedRow row = {};
  row.surfaces.plane = whole;
  row.surfaces.hiding = draw->Next() & ((uint64_t{1} << whole / kSliceLanes) - 1);
  constexpr const char* kNames[3] = {"first", "second", "third"};
  std::vector<int16_t> disparity = Disparities(whole, draw);
  for (int k = 0; k < kSurfaces; ++k) {
    if (k > 0) disparity = Behind(disparity, draw);
    row.surfaces.disparity[k] = call->Input(kNames[k], disparity);
    row.surfaces.rgb[k] = call->Input("rgb", Light(3 * whole, draw));
    if (k > 0) row.source[k - 1] = call->Input("source", AnySources(whole, draw));
  }
  row.surfaces.share = call->Input("share", Shares(whole, draw));
  const FarRow far = OutputOf(whole, draw, call);
  call->run = [=](const Kernels& kernels) -> uint64_t {
    return uint64_t(kernels.TakeFarthest(row, count, far));
  };
  call->is_right = [=](uint64_t returned, Met* met) {
    int most = 0;
    bool right = true;
    for (size_t n = 0; n < whole; ++n) {
      const int distance = far.source[n] >> kSourceDistance;
      most = std::max(most, distance);
      right = right && far.disparity[n] <= row.surfaces.disparity[0][n];
      right = right && (distance != 0) == (far.source[n] != 0);
      (*met)["repeated"] += distance != 0;
      (*met)["hidden"] += far.disparity[n] < row.surfaces.disparity[0][n];
    }
    return right && returned == uint64_t(most);
  };
}

// Three rows that a step keeps apart, each between pixels that may be read.
void SmoothFar(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedWidth), whole = SliceSamples(count);
  const size_t row = whole + 2 * kSliceLanes;
  const int32_t step = 1 << draw->Int(0, 4);
  const auto unit = int16_t(64 << draw->Int(0, 2));
  FarRows rows = {};
  rows.plane = row;
  for (int k = 0; k < 3; ++k) {
    std::vector<int16_t> disparity = Disparities(row, draw);
    for (int16_t& value : disparity) {
      if (draw->Int(0, 9) == 0) value = kNoSurface;
    }
    rows.disparity[k] = call->Input("disparity", disparity) + kSliceLanes;
    rows.rgb[k] = call->Input("rgb", Light(3 * row, draw)) + kSliceLanes;
  }
  rows.source = call->Input("source", AnySources(whole, draw));
  auto* out = call->Output<int16_t>("out", 3 * row);
  std::fill_n(out, 3 * row, int16_t{77});
  for (size_t c = 0; c < 3; ++c) call->Result(out + c * row, whole);
  call->Runs([=](const Kernels& kernels) { kernels.SmoothFar(rows, unit, step, count, out); });
  call->is_right = [=](uint64_t, Met* met) {
    bool right = true;
    for (size_t n = 0; n < whole; ++n) {
      const bool takes = 2 * (rows.source[n] >> kSourceDistance) >= step;
      right = right && (takes || out[n] == 77);
      (*met)["smoothed"] += takes;
      (*met)["left"] += !takes;
    }
    return right;
  };
}

void PutFarthest(Draw* draw, KernelCall* call) {
  const size_t whole = SliceSamples(draw->Length(1, 70, kTimedWidth));
  const size_t plane = whole + draw->Size(0, 9, 0);
  const uint64_t hiding = draw->Next() & ((uint64_t{1} << whole / kSliceLanes) - 1);
  const std::vector<int16_t> disparity = Disparities(whole, draw);
  std::vector<int16_t> farthest = disparity;
  for (int16_t& value : farthest) value = int16_t(value - (draw->Int(0, 2) == 0 ? 50 : 0));
  std::vector<uint16_t> sources = AnySources(whole, draw);
  for (uint16_t& source : sources) source = source >> kSourceDistance == 0 ? 0 : source;
  int16_t* const far_disparity = call->Input("far disparity", farthest);
  int16_t* const far_rgb = call->Input("far rgb", Light(3 * plane, draw));
  uint16_t* const far_source = call->Input("far source", sources);
  const FarRow far = {far_disparity, far_rgb, far_source, plane};
  const int16_t* surface = call->Input("disparity", disparity);
  auto* out = call->Output<int16_t>("out", 3 * plane);
  std::fill_n(out, 3 * plane, int16_t{-1});
  for (size_t c = 0; c < 3; ++c) call->Result(out + c * plane, whole);
  call->Runs(
      [=](const Kernels& kernels) { kernels.PutFarthest(far, surface, hiding, plane, out); });
  call->is_right = [=](uint64_t, Met* met) {
    bool right = true;
    for (size_t n = 0; n < whole; ++n) {
      const bool puts = (hiding >> n / kSliceLanes & 1) != 0 && far.source[n] != 0 &&
                        far.disparity[n] == surface[n];
      right = right && out[n] == (puts ? far.rgb[n] : -1);
      (*met)["put"] += puts;
      (*met)["left"] += !puts;
    }
    return right;
  };
}

}  // namespace test::kernel_cases
