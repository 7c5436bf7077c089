// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/repair.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/phases.h"
#include "lib/depth/repair_map.h"
#include "lib/depth/sweep.h"
#include "lib/depth/swept.h"
#include "lib/depth/thin_cells.h"
#include "lib/io/rows.h"
#include "simd/disparities.h"

namespace starfocus {
namespace {

struct RepairJob {
  Sweep sweep;
  const MapOutput& output;
};

const RepairJob& JobOf(const void* data) { return *static_cast<const RepairJob*>(data); }

// Converts a tile of the given map to fixed point.
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

// Writes the result of EvenOut to memory->first, whose previous content is no longer used, and
// counts the edge pixels of the tile.
void ValueTile(const void* data, int32_t index, int32_t) {
  const Sweep& sweep = JobOf(data).sweep;
  const Rect tile = TileOf(sweep.plan, index);
  EvenOut(sweep.plan, RowsOf(sweep.light_field.views[0]), tile, *sweep.memory, sweep.memory->first);
  if (sweep.rates) RateUnswept(sweep.plan, RowsOf(sweep.light_field.views[0]), tile, sweep.memory);
  sweep.memory->counts[index] = CountTile(sweep.plan, tile, *sweep.memory);
  const ThinGrid grid = GridOf(sweep.plan);
  CountBeside(grid, sweep.memory->given, tile, index, sweep.memory->given_cells);
  CountBeside(grid, sweep.memory->first, tile, index, sweep.memory->found_cells);
}

// Determines from the counts of all tiles how much evidence a change of the map requires, and which
// cells contain thin structures such as hair.
void JudgeMaps(const Sweep& sweep) {
  EstimateMemory& memory = *sweep.memory;
  const EstimatePlan& plan = sweep.plan;
  memory.least_evidence = LeastEvidence(kSweepEvidence, memory.counts, plan.columns * plan.rows);
  FindThin(GridOf(plan), kThinGiven, memory.given_cells);
  FindThin(GridOf(plan), kThinFound, memory.found_cells);
}

void WritePixel(const RepairJob& job, int32_t x, int32_t y, int16_t disparity) {
  const EstimateMemory& memory = *job.sweep.memory;
  const MapOutput& output = job.output;
  const auto row = static_cast<size_t>(y), column = static_cast<size_t>(x);
  const size_t at = row * static_cast<size_t>(job.sweep.plan.width) + column;
  if (disparity != memory.given[at]) {
    constexpr float kPixel = 1.0F / (1 << kDisparityBits);
    output.disparity[row * output.stride + column] =
        output.Clamped(static_cast<float>(disparity) * kPixel);
  }
  if (output.confidence != nullptr && disparity != memory.first[at] && Differs(memory, at)) {
    // The confidence of a pixel is 0 if the estimate from the views contradicts the map, but the
    // estimate is not used.
    output.confidence[row * output.confidence_stride + column] = 0;
  }
}

// Writes the disparities of a cell with thin structure that the given map lacks.
void WriteParted(const RepairJob& job, const Rect& cell) {
  const Sweep& sweep = job.sweep;
  for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
    int16_t nearest[kMostCellSide];
    FindNearest(sweep.plan, sweep.memory->trusted, cell, y, nearest);
    ForSwept(sweep.plan, sweep.memory->swept, {cell.x, y, cell.width, 1}, [&](int32_t x, int32_t) {
      const size_t at =
          static_cast<size_t>(y) * static_cast<size_t>(sweep.plan.width) + static_cast<size_t>(x);
      WritePixel(job, x, y, PartedAt(*sweep.memory, at, nearest[x - cell.x]));
    });
  }
}

void WriteCell(const RepairJob& job, const Rect& cell, int32_t number) {
  const EstimateMemory& memory = *job.sweep.memory;
  const bool keeps = memory.given_cells.thin[number] != 0;
  if (!keeps && memory.found_cells.thin[number] != 0) return WriteParted(job, cell);
  ForSwept(job.sweep.plan, memory.swept, cell, [&](int32_t x, int32_t y) {
    const size_t at =
        static_cast<size_t>(y) * static_cast<size_t>(job.sweep.plan.width) + static_cast<size_t>(x);
    const int16_t given = memory.given[at];
    const bool kept = keeps && given != simd::kNoSurface;
    WritePixel(job, x, y, kept ? given : RepairedAt(job.sweep.plan, memory, x, y));
  });
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
  ForCells(GridOf(sweep.plan), index,
           [&](const Rect& cell, int32_t number) { WriteCell(job, cell, number); });
}

}  // namespace

starfocus_status Repair(const EstimatePlan& plan, const starfocus_light_field& light_field,
                        const simd::DepthKernels& kernels, const MapOutput& output,
                        EstimateMemory* memory) {
  const RepairJob job = {
      {plan, light_field, kernels, memory, memory->first, output.confidence != nullptr}, output};
  constexpr JobFunction kPhases[] = {ReadTile,    TrustTile, MarkTile, SweepFirst,
                                     SweepSecond, ValueTile, WriteTile};
  Phases phases(plan, sizeof kPhases / sizeof *kPhases, &memory->jobs);
  for (const JobFunction phase : kPhases) {
    if (phase == WriteTile) JudgeMaps(job.sweep);
    const starfocus_status status = phases.Run(phase, &job);
    if (status != STARFOCUS_OK) return status;
  }
  return STARFOCUS_OK;
}

}  // namespace starfocus
