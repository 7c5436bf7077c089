// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/repair.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/repair_map.h"
#include "lib/depth/sweep.h"
#include "lib/depth/swept.h"

namespace starfocus {
namespace {

struct RepairJob {
  Sweep sweep;
  const MapOutput& output;
};

const RepairJob& JobOf(const void* data) { return *static_cast<const RepairJob*>(data); }

// Converts a tile of the given map.
void ReadTile(const void* data, int32_t index, int32_t) {
  const Sweep& sweep = JobOf(data).sweep;
  ReadGiven(sweep.plan, sweep.light_field, TileOf(sweep.plan, index), sweep.memory);
}

void TrustTile(const void* data, int32_t index, int32_t) {
  const Sweep& sweep = JobOf(data).sweep;
  const Rect tile = TileOf(sweep.plan, index);
  FindTrusted(sweep.plan, tile, sweep.memory->given, sweep.memory->trusted);
  FindDoubts(sweep.plan, sweep.light_field, tile, sweep.memory);
}

void MarkTile(const void* data, int32_t index, int32_t worker) {
  const Sweep& sweep = JobOf(data).sweep;
  FindSwept(sweep.plan, TileOf(sweep.plan, index), sweep.memory->workers[worker].cost,
            sweep.memory);
}

void SweepFirst(const void* data, int32_t index, int32_t worker) {
  SweepOneSide(&JobOf(data).sweep, index, worker);
}

void SweepSecond(const void* data, int32_t index, int32_t worker) {
  SweepAllViews(&JobOf(data).sweep, index, worker);
}

// Writes what a tile is of by the sweeps over the first map, which is no longer needed.
void ValueTile(const void* data, int32_t index, int32_t) {
  const Sweep& sweep = JobOf(data).sweep;
  const Rect tile = TileOf(sweep.plan, index);
  EvenOut(sweep.plan, sweep.light_field.views[0], tile, *sweep.memory, sweep.memory->first);
  if (sweep.rates) RateUnswept(sweep.plan, sweep.light_field.views[0], tile, sweep.memory);
  sweep.memory->counts[index] = CountTile(sweep.plan, tile, *sweep.memory);
}

void WriteTile(const void* data, int32_t index, int32_t) {
  const RepairJob& job = JobOf(data);
  const Sweep& sweep = job.sweep;
  const MapOutput& output = job.output;
  const Rect tile = TileOf(sweep.plan, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const auto row = static_cast<size_t>(y);
    std::copy_n(GivenAt(sweep.light_field, y) + tile.x, tile.width,
                output.disparity + row * output.stride + tile.x);
    if (output.confidence == nullptr) continue;
    std::copy_n(sweep.memory->certainty + row * static_cast<size_t>(sweep.plan.width) + tile.x,
                tile.width, output.confidence + row * output.confidence_stride + tile.x);
  }
  ForSwept(sweep.plan, sweep.memory->swept, tile, [&](int32_t x, int32_t y) {
    const auto row = static_cast<size_t>(y), column = static_cast<size_t>(x);
    const size_t at = row * static_cast<size_t>(sweep.plan.width) + column;
    if (IsChanged(sweep.plan, *sweep.memory, x, y)) {
      constexpr float kPixel = 1.0F / (1 << kDisparityBits);
      output.disparity[row * output.stride + column] =
          output.Clamped(static_cast<float>(sweep.memory->first[at]) * kPixel);
    } else if (output.confidence != nullptr && Differs(*sweep.memory, at)) {
      // What was gainsaid too weakly to be changed nobody is sure of.
      output.confidence[row * output.confidence_stride + column] = 0;
    }
  });
}

}  // namespace

sf_status Repair(const EstimatePlan& plan, const sf_light_field& light_field,
                 const simd::DepthKernels& kernels, const Runner& runner, const MapOutput& output,
                 EstimateMemory* memory) {
  const RepairJob job = {{plan, light_field, kernels, memory, output.confidence != nullptr},
                         output};
  constexpr JobFunction kPhases[] = {ReadTile,    TrustTile, MarkTile, SweepFirst,
                                     SweepSecond, ValueTile, WriteTile};
  int32_t done = 0;
  for (const JobFunction phase : kPhases) {
    memory->jobs.watch.SetPart(done++, static_cast<int32_t>(sizeof kPhases / sizeof *kPhases));
    if (phase == WriteTile) memory->least_evidence = LeastEvidence(plan, *memory);
    const sf_status status =
        RunJobSet(phase, &job, plan.columns * plan.rows, runner, &memory->jobs);
    if (status != SF_OK) return status;
  }
  return SF_OK;
}

}  // namespace starfocus
