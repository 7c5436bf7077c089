// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/repair.h"

#include <algorithm>
#include <cmath>

#include "lib/base/fixed.h"
#include "lib/depth/coverage_pass.h"
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

// Returns whether the map stays as it is: its steps are those of the picture.
bool IsRight(const CoverageMemory& memory) { return memory.exact && memory.sure; }

// Writes the disparity and coverage of a pixel near an edge whose disparity is known.
void WriteCovered(const RepairJob& job, int32_t x, int32_t y, const PixelCoverage& pixel) {
  const MapOutput& output = job.output;
  const CoverageMemory& memory = job.sweep.memory->coverage;
  const auto row = static_cast<size_t>(y), column = static_cast<size_t>(x);
  float* disparity = output.disparity + row * output.stride + column;
  const size_t at = row * static_cast<size_t>(job.sweep.plan.width) + column;
  constexpr float kPixel = 1.0F / (1 << kDisparityBits);
  if (pixel.is_thin || IsRight(memory)) *disparity = GivenAt(job.sweep.light_field, y)[x];
  if (output.coverage == nullptr) return;
  const int32_t front = memory.levels.near_level[at], back = memory.levels.far_level[at];
  int32_t coverage = pixel.coverage;
  if (pixel.is_thin && !memory.exact) {
    const int32_t level = coverage > kCovered / 2 ? front : back;
    *disparity = output.Clamped(static_cast<float>(level) * kPixel);
  } else {
    const bool is_near = 2 * *disparity > static_cast<float>(front + back) * kPixel;
    coverage = is_near ? Max(coverage, kCovered / 2 + 1) : Min(coverage, kCovered / 2);
  }
  output.coverage[row * output.coverage_stride + column] = static_cast<uint8_t>(coverage);
}

// Writes coverage over the result of the sweeps, which erase thin structure.
void CoverTile(const void* data, int32_t index, int32_t) {
  const RepairJob& job = JobOf(data);
  const Sweep& sweep = job.sweep;
  const MapOutput& output = job.output;
  const Rect tile = TileOf(sweep.plan, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const auto row = static_cast<size_t>(y);
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const PixelCoverage pixel = CoverageAt(sweep.plan, sweep.memory->coverage, x, y);
      if (output.coverage != nullptr) {
        output.coverage[row * output.coverage_stride + static_cast<size_t>(x)] = pixel.coverage;
      }
      const float given = GivenAt(sweep.light_field, y)[x];
      if (!std::isfinite(given)) continue;
      float* disparity = output.disparity + row * output.stride + static_cast<size_t>(x);
      // Sweeps find the wall between strands and take the strands for noise.
      if (*disparity < given && IsNearThin(sweep.plan, sweep.memory->coverage, x, y)) {
        *disparity = given;
      }
      if (pixel.is_mixed) {
        WriteCovered(job, x, y, pixel);
      } else if (IsRight(sweep.memory->coverage)) {
        *disparity = given;
      }
    }
  }
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
  constexpr JobFunction kPhases[] = {ReadTile,    TrustTile, MarkTile,  SweepFirst,
                                     SweepSecond, ValueTile, WriteTile, CoverTile};
  constexpr int32_t kParts =
      kCoverageParts + static_cast<int32_t>(sizeof kPhases / sizeof *kPhases);
  ReadMap(plan, light_field, memory->filled);
  const sf_status found = FindAllCoverage({plan, light_field, memory->filled}, runner, 0, kParts,
                                          &memory->jobs, &memory->coverage);
  if (found != SF_OK) return found;
  int32_t done = kCoverageParts;
  for (const JobFunction phase : kPhases) {
    memory->jobs.watch.SetPart(done++, kParts);
    if (phase == WriteTile) memory->least_evidence = LeastEvidence(plan, *memory);
    const sf_status status =
        RunJobSet(phase, &job, plan.columns * plan.rows, runner, &memory->jobs);
    if (status != SF_OK) return status;
  }
  return SF_OK;
}

}  // namespace starfocus
