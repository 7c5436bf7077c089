// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/layered_depth.h.
#include <algorithm>
#include <cmath>

#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

constexpr int16_t kStep = 48;
constexpr int kTimedFieldWidth = 192;

// Returns `rows` rows of disparities. Each row is the previous row with some disparities changed,
// either by any amount or by multiples of `step`.
std::vector<int16_t> MovedRows(size_t rows, size_t whole, int step, Draw* draw) {
  std::vector<int16_t> all = Disparities(whole, draw);
  for (size_t n = 0; n < (rows - 1) * whole; ++n) {
    const int anyhow = draw->Int(-300, 600), steps = step * draw->Int(-2, 3);
    const bool moves = draw->Int(0, draw->timed() ? 30 : 3) == 0;
    const int move = !moves ? 0 : draw->Int(0, 1) == 0 ? anyhow : steps;
    all.push_back(int16_t(std::clamp(all[n] + move, -32000, 32000)));
  }
  return all;
}

}  // namespace

void Deinterleave(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedSamples / 3), plane = count + draw->Size(0, 9, 0);
  const int16_t* rgb = call->Input("rgb", Light(3 * count, draw), kPadding);
  auto* out = call->OutputRows<int16_t>("out", 3, plane, count);
  call->Calls(&Kernels::Deinterleave, rgb, count, plane, out);
}

// Each call of FindEdges finds the edges of a row from the edges of the previous row.
void FindEdges(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 50, kTimedFieldWidth), whole = SliceSamples(count);
  const size_t rows = draw->Size(2, 20, kTimedSamples / kTimedFieldWidth + 1);
  const int16_t step = draw->Rarely(2) ? int16_t(draw->Int(1, 300)) : kStep;
  const int unit_bits = draw->Int(6, 8);
  const auto farthest =
      int16_t(draw->Rarely(2) ? draw->Int(0, FarthestEdge(unit_bits)) : FarthestEdge(unit_bits));
  const int16_t* disparity = call->Input("disparity", MovedRows(rows, whole, step, draw));
  auto* moved = call->Results<int16_t>("moved", whole);
  auto* behind = call->Results<int16_t>("behind", whole);
  auto* distance = call->Results<uint8_t>("distance", (rows - 1) * whole);
  std::fill_n(moved, whole, int16_t{INT16_MAX});
  call->RunsEach(rows - 1, [=](const Kernels& kernels, size_t row) {
    const int16_t* before = disparity + row * whole;
    kernels.FindEdges(before + whole, before, step, unit_bits, farthest, count, moved, behind,
                      distance + row * whole);
  });
}

void FindSteps(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedSamples),
               strips = SliceSamples(count) / kSliceLanes;
  const int16_t* row = call->Input("row", Disparities(count + 1, draw), kPadding);
  auto* steps = call->Results<StepBits>("steps", strips);
  call->Calls(&Kernels::FindSteps, row, count, kStep, steps);
}

void FindCopies(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, 96), samples = SliceSamples(count);
  const size_t rows = draw->Size(1, 3, kTimedSamples / 96);
  const size_t stride = count + 2 + draw->Size(0, 7, 0);
  std::vector<int16_t> disparities = Disparities((rows + 2) * stride, draw);
  for (int16_t& d : disparities) d = int16_t(std::clamp(d + draw->Int(-9, 9), -32000, 32000));
  const int16_t* field = call->Input("field", disparities, kPadding);
  const auto least = int16_t(draw->Int(1, 20)), most = int16_t(draw->Int(20, 100));
  auto* copies = call->Results<int16_t>("copies", rows * samples);
  auto* strips = call->Results<uint64_t>("strips", rows);
  const int16_t* first = field + stride + 1;
  call->RunsEach(rows, [=](const Kernels& kernels, size_t y) {
    strips[y] = kernels.FindCopies(first + y * stride, ptrdiff_t(stride), count, least, most,
                                   copies + y * samples);
  });
}

void InsertCopies(Draw* draw, KernelCall* call) {
  const size_t groups = draw->Size(1, 4, kTimedSamples / kSliceLanes);
  const size_t whole = groups * kSliceLanes, stride = whole + 2;
  const size_t plane = 3 * stride + draw->Size(0, 7, 0);
  const int16_t* row =
      call->Input("field", Ints<int16_t>(3 * stride, -2, 2, draw), kPadding) + stride + 1;
  const int16_t* rgb =
      call->Input("rgb", Ints<int16_t>(3 * plane, 0, INT16_MAX, draw), kPadding) + stride + 1;
  std::vector<int16_t> lower = Ints<int16_t>(whole, -2, 2, draw);
  for (int16_t& copy : lower) copy = draw->Int(0, 3) == 0 ? kNoSurface : copy;
  const int16_t* copies = call->Input("copies", lower, kPadding);
  const int before = draw->Int(-4, 1);
  const uint8_t* share = call->Input("share", Filled<uint8_t>(whole, [&] {
                                       return draw->Int(0, 4) == 0 ? kSliceEnd : kSliceWhole;
                                     }));
  HiddenGroup hidden = {};
  hidden.plane = plane;
  for (int k = 0; k < kSurfaces - 1; ++k) {
    hidden.disparity[k] = call->Results<int16_t>("disparity", whole);
    hidden.source[k] = call->Results<uint16_t>("source", whole);
    hidden.rgb[k] = call->OutputRows<int16_t>("out", 3, plane, whole);
    for (size_t n = 0; n < whole; ++n) {
      hidden.disparity[k][n] = draw->Int(0, 1) == 0 ? kNoSurface : int16_t(before - k);
      hidden.source[k][n] = uint16_t(draw->Int(0, UINT16_MAX));
    }
  }
  call->RunsEach(groups, [=](const Kernels& kernels, size_t group) {
    const size_t n = group * kSliceLanes;
    HiddenGroup to = hidden;
    for (int k = 0; k < kSurfaces - 1; ++k) {
      to.disparity[k] += n, to.source[k] += n, to.rgb[k] += n;
    }
    to.share = share + n;
    kernels.InsertCopies(row + n, ptrdiff_t(stride), copies + n, rgb + n, to);
  });
}

void BesideSteps(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, 96), strips = SliceSamples(count) / kSliceLanes;
  const size_t rows = draw->Size(1, 3, kTimedSamples / 96);
  const size_t stride = count + 2 + draw->Size(0, 7, 0);
  const int16_t* field = call->Input("field", Disparities((rows + 2) * stride, draw), kPadding);
  auto* beside = call->Results<uint16_t>("beside", rows * strips);
  const int16_t* first = field + stride + 1;
  call->RunsEach(rows, [=](const Kernels& kernels, size_t y) {
    kernels.BesideSteps(first + y * stride, ptrdiff_t(stride), count, kStep, beside + y * strips);
  });
}

namespace {

// A rectangle of random disparities, with edges in four directions. Some edges are at the largest
// possible distance.
struct DepthField {
  int width, height;
  size_t stride;
  DepthRow row;  // the values that are equal for all rows
  const int16_t* samples;
  const uint8_t* edges[4];

  DepthRow Row(int y) const {
    DepthRow one = row;
    one.disparity = samples + kSliceLanes + stride * size_t(y);
    one.above = y;
    one.below = height - 1 - y;
    for (int side = 0; side < 4; ++side) one.edges[side] = edges[side] + stride * size_t(y);
    return one;
  }
};

struct Patch {
  int x, y, right, bottom;
};

// Returns the disparities of the field: rectangles of one disparity each. The first rectangle is
// the background and covers the whole field.
std::vector<int16_t> FieldSamples(DepthField* field, Draw* draw) {
  const int width = field->width, height = field->height;
  const int limit = draw->Rarely(4) ? 32000 : 12 << field->row.unit_bits;
  std::vector<int16_t> samples(field->stride * size_t(height) + 2 * kSliceLanes, kNoSurface);
  field->row.high = int16_t(-limit);
  const auto paint = [&](const Patch& patch) {
    const auto value = int16_t(draw->Int(-limit, limit));
    for (int v = patch.y; v < patch.bottom; ++v) {
      std::fill_n(samples.begin() + int64_t(kSliceLanes + field->stride * size_t(v)) + patch.x,
                  patch.right - patch.x, value);
    }
  };
  paint({0, 0, width, height});
  for (int patch = 0; patch < width * height / 24; ++patch) {
    const int x = draw->Int(0, width - 1), y = draw->Int(0, height - 1);
    paint({x, y, std::min(width, x + draw->Int(1, 9)), std::min(height, y + draw->Int(1, 9))});
  }
  for (const int16_t sample : samples) field->row.high = std::max(field->row.high, sample);
  return samples;
}

// Returns random distances to edges; the disparities need not have edges at these distances. All
// distances end inside the field. In the benchmark, most distances are 0.
std::vector<uint8_t> FieldEdges(const DepthField& field, int side, Draw* draw) {
  std::vector<uint8_t> distances(field.stride * size_t(field.height));
  for (int y = 0; y < field.height; ++y) {
    for (int x = 0; x < field.width; ++x) {
      const int rooms[4] = {field.width - 1 - x, x, field.height - 1 - y, y};
      const int most = std::min(rooms[side], draw->Rarely(20) ? 255 : 20);
      if (most == 0 || draw->Int(0, draw->timed() ? 60 : 2) != 0) continue;
      distances[field.stride * size_t(y) + size_t(x)] = uint8_t(draw->Int(1, most));
    }
  }
  return distances;
}

// Sets the views that see behind edges: none, views of a star set at one or two distances, or views
// at any positions.
void SetLooks(Draw* draw, DepthRow* row) {
  const bool none = draw->Rarely(5), second = draw->Int(0, 1) == 0;
  const bool anywhere = !draw->timed() && draw->Int(0, 2) == 0;
  const int unit = 1 << row->unit_bits;
  for (int side = 0; side < 4; ++side) {
    if (none) break;
    row->views[side][0] = {int16_t(unit), int8_t(side), 0};
    if (second) row->views[side][1] = {int16_t(2 * unit), int8_t(side), 0};
    for (HiddenView& view : row->views[side]) {
      if (!anywhere || draw->Rarely(4)) continue;
      const int most = 1 << kSlantBits;
      view = {int16_t(draw->Int(unit, kMostUnit)), int8_t(draw->Int(0, 3)),
              int16_t(draw->Rarely(3) ? 0 : draw->Int(-most, most))};
    }
  }
}

DepthField MakeField(Draw* draw, KernelCall* call) {
  DepthField field = {};
  field.width = int(draw->Length(1, 70, kTimedFieldWidth));
  field.height = int(draw->Size(1, 20, kTimedSamples / kTimedFieldWidth));
  field.stride = SliceSamples(size_t(field.width));
  field.row.stride = ptrdiff_t(field.stride);
  field.row.width = field.width;
  field.row.unit_bits = draw->Int(6, 8);
  SetLooks(draw, &field.row);
  field.samples = call->Input("disparity", FieldSamples(&field, draw));
  constexpr const char* kNames[4] = {"right", "left", "bottom", "top"};
  for (int side = 0; side < 4; ++side) {
    field.edges[side] = call->Input(kNames[side], FieldEdges(field, side, draw));
  }
  return field;
}

// The output of FindHidden for all rows of a field.
struct HiddenField {
  int16_t* disparity[kSurfaces - 1];
  uint16_t* source[kSurfaces - 1];
  uint16_t* found[kSurfaces - 1];
  uint8_t* share;
  uint64_t* strips;  // return value of FindHidden for each row

  HiddenField(const DepthField& field, KernelCall* call) {
    const auto rows = size_t(field.height), samples = field.stride * rows;
    for (int k = 0; k < kSurfaces - 1; ++k) {
      disparity[k] = call->Results<int16_t>(k == 0 ? "first" : "second", samples);
      source[k] = call->Results<uint16_t>(k == 0 ? "first source" : "second source", samples);
      found[k] = call->Results<uint16_t>("found", samples / kSliceLanes);
    }
    share = call->Results<uint8_t>("share", samples);
    strips = call->Results<uint64_t>("returned", rows);
  }

  HiddenRow Row(size_t first) const {
    HiddenRow row;
    for (int k = 0; k < kSurfaces - 1; ++k) {
      row.disparity[k] = disparity[k] + first;
      row.source[k] = source[k] + first;
      row.found[k] = found[k] + first / kSliceLanes;
    }
    row.share = share + first;
    return row;
  }

  // Returns true if the output for group n of the field is right. If `hidden` is true, the group
  // has hidden surfaces, and the bits of `found` must match the sources. The output of groups
  // without hidden surfaces may be arbitrary.
  bool IsRight(size_t n, bool hidden, KernelCall* call, Met* met) const {
    bool right = true;
    for (int k = 0; k < kSurfaces - 1; ++k) {
      if (!hidden) {
        call->Free(source[k] + n * kSliceLanes, kSliceLanes);
        call->Free(found[k] + n, 1);
        continue;
      }
      for (size_t i = 0; i < kSliceLanes; ++i) {
        const int value = source[k][n * kSliceLanes + i], sides = value & 15;
        right = right && (found[k][n] >> i & 1) == int(value != 0);
        right = right && (disparity[k][n * kSliceLanes + i] != kNoSurface) == (value != 0);
        const bool unseen = value >> kSourceDistance != 0;
        (*met)["seen"] += sides != 0 && !unseen;
        (*met)["unseen"] += unseen;
        (*met)["second view"] += (value >> kSourceSecond & 15) != 0;
        (*met)["tied"] += (sides & (sides - 1)) != 0;
        if (k > 0) (*met)["second"] += value != 0;
      }
    }
    return right;
  }
};

}  // namespace

void FindHidden(Draw* draw, KernelCall* call) {
  const DepthField field = MakeField(draw, call);
  const HiddenField hidden(field, call);
  call->RunsEach(size_t(field.height), [=](const Kernels& kernels, size_t y) {
    hidden.strips[y] = kernels.FindHidden(field.Row(int(y)), hidden.Row(field.stride * y));
  });
  call->is_right = [=](uint64_t, Met* met) {
    const size_t groups = field.stride / kSliceLanes;
    return AllRight(groups * size_t(field.height), [&](size_t n) {
      const bool any = (hidden.strips[n / groups] >> n % groups & 1) != 0;
      return hidden.IsRight(n, any, call, met);
    });
  };
}

}  // namespace test::kernel_cases
