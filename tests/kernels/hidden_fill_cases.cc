// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/hidden_fill.h.
#include <algorithm>

#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

constexpr size_t kTimedWidth = 192;

// Returns random sources of hidden surfaces; each source is a view or the distance of a repeated
// pixel. Most repeated pixels are at most 20 pixels away.
std::vector<uint16_t> AnySources(size_t count, Draw* draw) {
  return Filled<uint16_t>(count, [&] {
    const int distance = draw->Int(0, 2) == 0 ? 0 : draw->Int(1, draw->Rarely(5) ? 255 : 20);
    return distance << kSourceDistance | draw->Int(1, 255);
  });
}

// Returns disparities of surfaces behind the surfaces of `before`. Half of the surfaces are
// missing, and a few surfaces are wrongly in front of the surfaces of `before`.
std::vector<int16_t> Behind(const std::vector<int16_t>& before, Draw* draw) {
  std::vector<int16_t> behind(before.size(), kNoSurface);
  for (size_t n = 0; n < before.size(); ++n) {
    if (before[n] == kNoSurface || draw->Int(0, 1) == 0) continue;
    const int depth = draw->Rarely(10) ? draw->Int(-60, 0) : draw->Int(1, 700);
    behind[n] = int16_t(std::clamp(before[n] - depth, -32000, 32000));
  }
  return behind;
}

std::vector<uint8_t> Portions(size_t count, Draw* draw) {
  return Filled<uint8_t>(count, [&] {
    const int kind = draw->Int(0, 2);
    return kind == 0 ? kSliceEnd : kind == 1 ? kSliceWhole : draw->Int(1, kSliceWhole);
  });
}

// Allocates the output row of CopyFarthest or SmoothFar: the farthest surface of each pixel.
FarRow OutputOf(size_t whole, Draw* draw, KernelCall* call) {
  const size_t plane = whole + draw->Size(0, 9, 0);
  return {call->Results<int16_t>("far disparity", whole),
          call->OutputRows<int16_t>("far rgb", 3, plane, whole),
          call->Results<uint16_t>("far source", whole), plane};
}

}  // namespace

void CopyFarthest(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedWidth), whole = SliceSamples(count);
  SurfaceRow row = {};
  const uint16_t* source[kSurfaces - 1];
  row.plane = whole;
  row.hiding = draw->Next() & ((uint64_t{1} << whole / kSliceLanes) - 1);
  constexpr const char* kNames[3] = {"first", "second", "third"};
  std::vector<int16_t> disparity = Disparities(whole, draw);
  for (int k = 0; k < kSurfaces; ++k) {
    if (k > 0) disparity = Behind(disparity, draw);
    row.disparity[k] = call->Input(kNames[k], disparity);
    row.rgb[k] = call->Input("rgb", Light(3 * whole, draw));
    if (k > 0) source[k - 1] = call->Input("source", AnySources(whole, draw));
  }
  row.share = call->Input("share", Portions(whole, draw));
  const FarRow far = OutputOf(whole, draw, call);
  call->Calls(&Kernels::CopyFarthest, row, source, count, far,
              call->Results<uint64_t>("strips", 1));
}

namespace {

// Arguments of LimitFar and SmoothFar.
struct ThreeRows {
  FarRows rows;
  int16_t* out;
};

ThreeRows RowsOf(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedWidth), whole = SliceSamples(count);
  const size_t row = whole + 2 * kSliceLanes;
  const uint64_t strips = draw->Next() & ((uint64_t{1} << whole / kSliceLanes) - 1);
  ThreeRows made = {{{}, {}, row, nullptr, strips, int16_t(64 << draw->Int(0, 2))}, nullptr};
  for (int k = 0; k < 3; ++k) {
    std::vector<int16_t> values = Disparities(row, draw);
    for (int16_t& value : values) {
      if (draw->Int(0, 9) == 0) value = kNoSurface;
    }
    made.rows.disparity[k] = call->Input("disparity", values) + kSliceLanes;
    made.rows.rgb[k] = call->Input("rgb", Light(3 * row, draw)) + kSliceLanes;
  }
  made.rows.source = call->Input("source", AnySources(whole, draw));
  made.out = call->OutputRows<int16_t>("out", 3, row, whole);
  return made;
}

}  // namespace

void LimitFar(Draw* draw, KernelCall* call) {
  const ThreeRows made = RowsOf(draw, call);
  call->Calls(&Kernels::LimitFar, made.rows, made.out);
}

void SmoothFar(Draw* draw, KernelCall* call) {
  const ThreeRows made = RowsOf(draw, call);
  const int32_t step = 1 << draw->Int(0, 4);
  call->Calls(&Kernels::SmoothFar, made.rows, step, made.out);
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
  const FarRow far = {call->Input("far disparity", farthest),
                      call->Input("far rgb", Light(3 * plane, draw)),
                      call->Input("far source", sources), plane};
  const int16_t* surface = call->Input("disparity", disparity);
  auto* out = call->OutputRows<int16_t>("out", 3, plane, whole);
  call->Calls(&Kernels::PutFarthest, far, surface, hiding, plane, out);
}

}  // namespace test::kernel_cases
