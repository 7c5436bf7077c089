// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/coverage_pass.h"

#include <algorithm>
#include <cmath>

namespace starfocus {
namespace {

// A cell is mixed if the mean of 4 a (1 - a) of its pixels is above this share of 255.
constexpr int32_t kMixedMean = 64;
// A cell is thin if it and its neighbours hold so many mixed ones, and its own mean is this.
// Thin structure is near with this many thin cells among those up to so many cells away.
constexpr int32_t kNearCells = 4, kLeastNear = 16;
constexpr int32_t kLeastMixed = 2, kThinMean = 10;
// Pixels whose coverage is this far from one half decide on whether the map is exact.
constexpr int32_t kSure = 96, kTrusted = 192;
// Pixels this near to a step decide on it.
constexpr int32_t kBesideStep = 2;
// In an exact map at most one pixel of so many lies on the wrong side, or on a ramp.
constexpr int32_t kWrongParts = 20, kRampParts = 3;
// Colours are sure of a map if they decide on as many pixels as one in so many at its steps.
constexpr int32_t kSureParts = 24;

struct CoverageJob {
  const ColourMap& map;
  CoverageMemory* memory;
};

const CoverageJob& JobOf(const void* data) { return *static_cast<const CoverageJob*>(data); }

// Returns the cell of a coordinate. Cells meet at the picture's centre, so that they are the same
// in a mirrored picture.
int32_t CellOf(int32_t at, int32_t size) {
  const int32_t cells = (size / 2 + kThinCell - 1) / kThinCell + 1;
  const int32_t twice = 2 * at + 1 - size;
  return twice >= 0 ? cells + twice / (2 * kThinCell) : cells - 1 - -twice / (2 * kThinCell);
}

int32_t CellsOf(int32_t size) { return 2 * ((size / 2 + kThinCell - 1) / kThinCell + 1); }

size_t CellAt(const EstimatePlan& plan, int32_t x, int32_t y) {
  return static_cast<size_t>(CellOf(y, plan.height)) * static_cast<size_t>(CellsOf(plan.width)) +
         static_cast<size_t>(CellOf(x, plan.width));
}

void LevelTile(const void* data, int32_t index, int32_t worker) {
  const CoverageJob& job = JobOf(data);
  FindLevels(job.map, TileOf(job.map.plan, index), job.memory->level_scratch[worker],
             job.memory->levels);
}

void CoverTile(const CoverageJob& job, const Band& band, int32_t index, int32_t worker,
               const CoveragePlanes& planes) {
  FindCoverage(job.map, job.memory->levels, band, TileOf(job.map.plan, index),
               job.memory->scratch[worker], planes);
}

void WideFirst(const void* data, int32_t index, int32_t worker) {
  const CoverageJob& job = JobOf(data);
  CoverTile(job, kWideBand, index, worker,
            {nullptr, job.memory->first, job.memory->trust, nullptr});
}

void WideSecond(const void* data, int32_t index, int32_t worker) {
  const CoverageJob& job = JobOf(data);
  CoverTile(job, kWideBand, index, worker,
            {job.memory->first, job.memory->wide, job.memory->trust, nullptr});
}

EdgeCount CountEdges(const ColourMap& map, const CoverageMemory& memory, const Rect& tile) {
  EdgeCount count = {};
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = map.At(x, y);
      const int32_t distance = memory.levels.place[at] & kDistanceMask;
      if (distance > kBesideStep || memory.thin[CellAt(map.plan, x, y)] != 0 ||
          !IsInBand(memory.levels, kNarrowBand, at))
        continue;
      const bool on_ramp = (memory.levels.place[at] & kOnRamp) != 0;
      if (distance == 0) ++(on_ramp ? count.ramps : count.steps);
      count.trusted += memory.narrow_trust[at] >= kTrusted ? 1 : 0;
      if (Abs(memory.narrow[at] - kCovered / 2) < kSure) continue;
      const bool near_side = (memory.levels.place[at] & kNearSide) != 0;
      ++((memory.narrow[at] > kCovered / 2) == near_side ? count.agrees : count.differs);
    }
  }
  return count;
}

void NarrowTile(const void* data, int32_t index, int32_t worker) {
  const CoverageJob& job = JobOf(data);
  CoverTile(job, kNarrowBand, index, worker,
            {nullptr, job.memory->narrow, job.memory->narrow_trust, job.memory->alike});
  job.memory->counts[index] = CountEdges(job.map, *job.memory, TileOf(job.map.plan, index));
}

// Measures how mixed the cells are whose first pixel lies in a tile.
void MixTile(const void* data, int32_t index, int32_t) {
  const CoverageJob& job = JobOf(data);
  const EstimatePlan& plan = job.map.plan;
  const Rect tile = TileOf(plan, index);
  const auto starts = [](int32_t at, int32_t size) {
    return at == 0 || CellOf(at, size) != CellOf(at - 1, size);
  };
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    if (!starts(y, plan.height)) continue;
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      if (!starts(x, plan.width)) continue;
      const size_t cell = CellAt(plan, x, y);
      int32_t sum = 0;
      for (int32_t row = y; row < Min(y + kThinCell, plan.height); ++row) {
        for (int32_t column = x; column < Min(x + kThinCell, plan.width); ++column) {
          const size_t at = job.map.At(column, row);
          if (!IsInBand(job.memory->levels, kWideBand, at)) continue;
          const int32_t a = job.memory->wide[at];
          sum += 4 * a * (kCovered - a) / kCovered * job.memory->trust[at] / 255;
        }
      }
      job.memory->mixed[cell] = static_cast<uint8_t>(sum / (kThinCell * kThinCell));
    }
  }
}

// Marks the mixed cells and neighbours of the same kind as thin.
void MarkThin(const EstimatePlan& plan, CoverageMemory* memory) {
  const int32_t columns = CellsOf(plan.width), rows = CellsOf(plan.height);
  for (int32_t y = 0; y < rows; ++y) {
    for (int32_t x = 0; x < columns; ++x) {
      int32_t mixed = 0;
      for (int32_t row = Max(y - 1, 0); row <= Min(y + 1, rows - 1); ++row) {
        for (int32_t column = Max(x - 1, 0); column <= Min(x + 1, columns - 1); ++column) {
          mixed += memory->mixed[row * columns + column] > kMixedMean ? 1 : 0;
        }
      }
      const bool thin = mixed >= kLeastMixed && memory->mixed[y * columns + x] >= kThinMean;
      memory->thin[y * columns + x] = thin ? 1 : 0;
    }
  }
}

// Decides whether the map is exact.
void Conclude(const EstimatePlan& plan, CoverageMemory* memory) {
  int64_t agrees = 0, differs = 0, steps = 0, ramps = 0, trusted = 0;
  for (int32_t tile = 0; tile < plan.columns * plan.rows; ++tile) {
    agrees += memory->counts[tile].agrees;
    differs += memory->counts[tile].differs;
    steps += memory->counts[tile].steps;
    ramps += memory->counts[tile].ramps;
    trusted += memory->counts[tile].trusted;
  }
  memory->exact = kWrongParts * differs <= agrees + differs && kRampParts * ramps <= steps + ramps;
  memory->sure = kSureParts * trusted >= steps;
}

}  // namespace

CoverageMemory TakeCoverage(const EstimatePlan& plan, int32_t max_workers, Carver* carver) {
  CoverageMemory memory = {};
  const auto width = static_cast<size_t>(plan.width), height = static_cast<size_t>(plan.height);
  memory.levels.near_level = carver->Take<int16_t>(width, height);
  memory.levels.far_level = carver->Take<int16_t>(width, height);
  memory.levels.place = carver->Take<uint8_t>(width, height);
  for (uint8_t** plane :
       {&memory.first, &memory.wide, &memory.narrow, &memory.trust, &memory.narrow_trust}) {
    *plane = carver->Take<uint8_t>(width, height);
  }
  for (int16_t*& plane : memory.alike) plane = carver->Take<int16_t>(width, height);
  const auto columns = static_cast<size_t>(CellsOf(plan.width));
  const auto rows = static_cast<size_t>(CellsOf(plan.height));
  memory.thin = carver->Take<uint8_t>(columns, rows);
  memory.mixed = carver->Take<uint8_t>(columns, rows);
  const auto tiles = static_cast<size_t>(plan.columns) * static_cast<size_t>(plan.rows);
  memory.counts = carver->Take<EdgeCount>(tiles);
  const auto workers = static_cast<size_t>(max_workers);
  memory.level_scratch = carver->Take<LevelsScratch>(workers);
  memory.scratch = carver->Take<CoverageScratch>(workers);
  Rect largest[2] = {};
  for (int32_t tile = 0; tile < plan.columns * plan.rows; ++tile) {
    const int32_t margins[2] = {kLevelsMargin, kCoverageMargin};
    for (int k = 0; k < 2; ++k) {
      const Rect region = Widened(plan, TileOf(plan, tile), margins[k]);
      largest[k].width = Max(largest[k].width, region.width);
      largest[k].height = Max(largest[k].height, region.height);
    }
  }
  for (size_t worker = 0; worker < workers; ++worker) {
    // Levels and coverage are found one after the other.
    const LevelsScratch of_levels = TakeLevelsScratch(
        static_cast<size_t>(largest[0].width), static_cast<size_t>(largest[0].height), carver);
    const CoverageScratch scratch = TakeCoverageScratch(
        static_cast<size_t>(largest[1].width), static_cast<size_t>(largest[1].height), carver);
    if (of_levels.high == nullptr) continue;
    memory.level_scratch[worker] = of_levels;
    memory.scratch[worker] = scratch;
  }
  return memory;
}

bool IsNearThin(const EstimatePlan& plan, const CoverageMemory& memory, int32_t x, int32_t y) {
  const int32_t columns = CellsOf(plan.width), rows = CellsOf(plan.height);
  int32_t count = 0;
  const int32_t across = CellOf(x, plan.width), down = CellOf(y, plan.height);
  for (int32_t row = Max(down - kNearCells, 0); row <= Min(down + kNearCells, rows - 1); ++row) {
    const uint8_t* cells = memory.thin + row * columns;
    for (int32_t cell = Max(across - kNearCells, 0); cell <= Min(across + kNearCells, columns - 1);
         ++cell) {
      count += cells[cell];
    }
  }
  return count >= (memory.exact ? 1 : kLeastNear);
}

PixelCoverage CoverageAt(const EstimatePlan& plan, const CoverageMemory& memory, int32_t x,
                         int32_t y) {
  const size_t at =
      static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(x);
  if (memory.levels.place[at] == kNoEdge) return {false, false, kCovered, 255};
  if (IsInBand(memory.levels, kWideBand, at) && memory.thin[CellAt(plan, x, y)] != 0) {
    return {true, true, memory.wide[at], memory.trust[at]};
  }
  if (IsInBand(memory.levels, kNarrowBand, at)) {
    return {true, false, memory.narrow[at], memory.narrow_trust[at]};
  }
  const bool near_side = (memory.levels.place[at] & kNearSide) != 0;
  return {false, false, near_side ? uint8_t{kCovered} : uint8_t{0}, 255};
}

sf_status FindAllCoverage(const ColourMap& map, const Runner& runner, int32_t first_part,
                          int32_t parts, JobSet* jobs, CoverageMemory* memory) {
  const CoverageJob job = {map, memory};
  constexpr JobFunction kPhases[kCoverageParts] = {LevelTile, WideFirst, WideSecond, MixTile,
                                                   NarrowTile};
  std::fill_n(memory->mixed, CellsOf(map.plan.width) * CellsOf(map.plan.height), uint8_t{0});
  for (int32_t k = 0; k < kCoverageParts; ++k) {
    jobs->watch.SetPart(first_part + k, parts);
    const sf_status status =
        RunJobSet(kPhases[k], &job, map.plan.columns * map.plan.rows, runner, jobs);
    if (status != SF_OK) return status;
    if (kPhases[k] == MixTile) MarkThin(map.plan, memory);
  }
  Conclude(map.plan, memory);
  return SF_OK;
}

}  // namespace starfocus
