// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/repair.h"

#include <cmath>
#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/depth/repair_map.h"
#include "lib/depth/sweep.h"

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
  ReadGiven(sweep.plan, sweep.light_field, TileOf(sweep.plan, index), sweep.memory->given);
}

void TrustTile(const void* data, int32_t index, int32_t) {
  const Sweep& sweep = JobOf(data).sweep;
  FindTrusted(sweep.plan, TileOf(sweep.plan, index), sweep.memory->given, sweep.memory->trusted);
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
  sweep.memory->counts[index] = CountTile(sweep.plan, tile, *sweep.memory);
}

void WriteTile(const void* data, int32_t index, int32_t) {
  const RepairJob& job = JobOf(data);
  const Sweep& sweep = job.sweep;
  const MapOutput& output = job.output;
  const Rect tile = TileOf(sweep.plan, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const auto row = static_cast<size_t>(y);
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const auto column = static_cast<size_t>(x);
      constexpr float kPixel = 1.0F / (1 << kDisparityBits);
      const bool changes = IsChanged(sweep.plan, *sweep.memory, x, y);
      const size_t at = row * static_cast<size_t>(sweep.plan.width) + column;
      output.disparity[row * output.stride + column] =
          changes ? output.Clamped(static_cast<float>(sweep.memory->first[at]) * kPixel)
                  : GivenAt(sweep.light_field, y)[column];
      if (output.confidence == nullptr) continue;
      // What was gainsaid too weakly to be changed nobody is sure of.
      const bool doubted = !changes && Differs(*sweep.memory, at);
      output.confidence[row * output.confidence_stride + column] =
          doubted ? 0 : sweep.memory->certainty[at];
    }
  }
}

}  // namespace

sf_status Repair(const EstimatePlan& plan, const sf_light_field& light_field,
                 const simd::DepthKernels& kernels, const Runner& runner, const MapOutput& output,
                 EstimateMemory* memory) {
  const RepairJob job = {{plan, light_field, kernels, memory}, output};
  constexpr JobFunction kPhases[] = {ReadTile,    TrustTile, SweepFirst,
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
