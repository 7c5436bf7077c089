// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_repair.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "lib/base/arena.h"
#include "lib/base/fixed.h"
#include "lib/depth/outlines.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Largest difference between a candidate disparity and the map's disparity at which both
// disparities count as one surface.
constexpr int32_t kSameSurface = kPixel;
// A pixel changes only if the changes within kGainRadius have a large enough total gain, which is
// the cost that they save. One or two contradicted pixels are more likely a speckle on their
// surface than the edge of another surface. In maps that are mostly right, a much larger gain is
// required. Maps that are mostly right are wrong only at objects with the colour of the background,
// and colours are unreliable at such objects.
constexpr int32_t kGainRadius = 3;
constexpr EvidenceScale kGains = {18, 22, 1000, 60};
// Number of directions of the paths along which costs are summed.
constexpr int32_t kPaths = 4;
constexpr int32_t kReadPhases = 2, kColourPhases = 9;
// Changed pixels get the mean disparity of the chosen surface within kMeanRadius. In this mean,
// pixels far from steps have weight kSureWeight, and pixels near steps have weight 1.
constexpr int32_t kMeanRadius = 5, kSureWeight = 4;

struct ColourJob {
  const ColourMap& map;
  const MapOutput& output;
  const Smoothing& smoothing;
  int16_t* to;      // map that the phase writes
  int16_t* chosen;  // result of Choose; only doubtful pixels are written
  ColourMemory* memory;
  const simd::DepthKernels& kernels;
};

const ColourJob& JobOf(const void* data) { return *static_cast<const ColourJob*>(data); }

// Returns the rows of job `index` of a phase that divides the picture into as many ranges of rows
// as the plan has tiles.
Range RowsOfJob(const EstimatePlan& plan, int32_t index) {
  return PartOf({0, plan.height}, index, plan.columns * plan.rows);
}

void ReadPart(const void* data, int32_t index, int32_t) {
  const ColourJob& job = JobOf(data);
  ReadRows(job.map.plan, job.map.light_field, RowsOfJob(job.map.plan, index), job.to);
}

void CountPart(const void* data, int32_t index, int32_t worker) {
  const ColourJob& job = JobOf(data);
  CountNoise(job.map.plan, job.map.disparity, RowsOfJob(job.map.plan, index),
             job.memory->workers[worker].noise);
}

void SmoothMap(const void* data, int32_t index, int32_t worker) {
  const ColourJob& job = JobOf(data);
  SmoothTile(job.map, job.smoothing, TileOf(job.map.plan, index), job.kernels,
             job.memory->workers[worker].smooth, job.to);
}

void DoubtTile(const void* data, int32_t index, int32_t worker) {
  const ColourJob& job = JobOf(data);
  MeasureDoubt(job.map, TileOf(job.map.plan, index), job.memory->workers[worker].doubt,
               job.memory->doubt);
}

// Chooses the disparity with the smallest sum for a doubtful pixel, and computes the pixel's gain.
// On ramps, the map's disparity lies between two surfaces and is never chosen.
// Returns the cost of the best other surface minus the cost of the chosen surface, divided by the
// number of paths.
uint8_t Choose(const ColourJob& job, size_t at, const Choices& choices) {
  const int32_t given = job.map.disparity[at];
  int32_t best = 0, own = 0;
  for (int32_t k = 1; k < choices.count; ++k) {
    if (choices.sum[k] < choices.sum[best]) best = k;
    if (Abs(choices.disparity[k] - given) < Abs(choices.disparity[own] - given)) own = k;
  }
  int32_t margin = kPaths * UINT8_MAX;
  for (int32_t k = 0; k < choices.count; ++k) {
    if (Abs(choices.disparity[k] - choices.disparity[best]) <= kSurfaceStep) continue;
    margin = Min(margin, choices.sum[k] - choices.sum[best]);
  }
  const bool same = Abs(choices.disparity[best] - given) <= kSameSurface;
  const bool keeps = same && job.memory->doubt[at] != 0;
  job.chosen[at] = keeps ? static_cast<int16_t>(given) : choices.disparity[best];
  job.memory->gain[at] =
      same ? int16_t{0} : static_cast<int16_t>(choices.cost[own] - choices.cost[best]);
  return static_cast<uint8_t>(margin / kPaths);
}

// Returns the confidence of pixel (x, y), or null if no confidence is requested.
uint8_t* ConfidenceAt(const ColourJob& job, int32_t x, int32_t y) {
  return job.output.confidence.data == nullptr ? nullptr : job.output.confidence.Row(y) + x;
}

// Returns true if a doubtful pixel would move to another surface.
bool Differs(const ColourJob& job, size_t at) {
  return Abs(job.chosen[at] - job.map.disparity[at]) > kSameSurface;
}

TileCount CountTile(const ColourJob& job, const Rect& tile) {
  TileCount count = {};
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    ForDoubtful(job.memory->doubt + job.map.plan.At(tile.x, y), tile.width, [&](int32_t k) {
      const size_t at = job.map.plan.At(tile.x + k, y);
      const int32_t doubt = job.memory->doubt[at];
      // Pixels on ramps count as edge pixels.
      if (doubt > kThinDoubt || (doubt != 0 && !IsBesideStep(job.map, tile, tile.x + k, y))) return;
      ++count.rough;
      count.differs += Differs(job, at) ? 1 : 0;
    });
  }
  return count;
}

void ChooseTile(const void* data, int32_t index, int32_t worker) {
  const ColourJob& job = JobOf(data);
  const ColourTileMemory& memory = job.memory->workers[worker];
  const Rect tile = TileOf(job.map.plan, index);
  if (tile.width == 0 || tile.height == 0) return;
  const Rect region = Widened(job.map.plan, tile, kTileMargin);
  WeighChoices(job.map, job.memory->doubt, region, job.kernels, memory.choices);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const Choices* row = memory.choices.choices + (y - region.y) * region.width + tile.x - region.x;
    const size_t at = job.map.plan.At(tile.x, y);
    uint8_t* confidence = ConfidenceAt(job, tile.x, y);
    std::fill_n(job.memory->gain + at, tile.width, int16_t{0});
    if (confidence != nullptr) std::fill_n(confidence, tile.width, uint8_t{UINT8_MAX});
    ForDoubtful(job.memory->doubt + at, tile.width, [&](int32_t k) {
      const uint8_t certainty = Choose(job, at + static_cast<size_t>(k), row[k]);
      if (confidence != nullptr) confidence[k] = certainty;
    });
  }
  job.memory->counts[index] = CountTile(job, tile);
  const ThinGrid grid = GridOf(job.map.plan);
  CountBeside(grid, job.map.disparity, tile, index, job.memory->thin);
}

// Computes the gain (saved cost) that a change requires, from the counts of all tiles. Marks the
// cells that must not change, which are the cells with thin structure or hair.
void JudgeMap(const EstimatePlan& plan, ColourMemory* memory) {
  memory->least_gain = LeastEvidence(kGains, memory->counts, plan.columns * plan.rows);
  const ThinGrid grid = GridOf(plan);
  FindThin(grid, kThinGiven, memory->thin);
  if (!memory->has_coverage) return;
  for (int32_t number = 0; number < grid.Cells(); ++number) {
    const Rect cell = grid.CellAt(number % grid.columns, number / grid.columns);
    if (HasHair(memory->hair_cells, cell)) memory->thin.thin[number] = 1;
  }
}

// Returns true if the total gain of the changes around a pixel is large enough to contradict the
// map.
bool IsGainsaid(const ColourJob& job, int32_t x, int32_t y) {
  const Rect around = Widened(job.map.plan, {x, y, 1, 1}, kGainRadius);
  int32_t gain = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      gain += job.memory->gain[job.map.plan.At(column, row)];
    }
  }
  return gain >= job.memory->least_gain;
}

// Returns the weighted mean of the map's disparities around pixel (x, y) that belong to the surface
// chosen for this pixel.
float MeanOfSurface(const ColourJob& job, int32_t x, int32_t y) {
  const int32_t own = job.chosen[job.map.plan.At(x, y)];
  const Rect around = Widened(job.map.plan, {x, y, 1, 1}, kMeanRadius);
  int32_t sum = 0, weights = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const size_t at = job.map.plan.At(column, row);
      const int32_t doubt = job.memory->doubt[at];
      if (doubt == 0 || Abs(job.map.disparity[at] - own) > kPixel) continue;
      const int32_t weight = doubt > kDisplacement ? kSureWeight : 1;
      sum += weight * job.map.disparity[at];
      weights += weight;
    }
  }
  if (weights == 0) return static_cast<float>(own) / kPixel;
  return static_cast<float>(sum) / static_cast<float>(weights * kPixel);
}

// Writes a doubtful pixel of the result, to which WriteRow has written the map's disparity. If
// `keeps` is true, known disparities are not changed.
void WritePixel(const ColourJob& job, bool keeps, int32_t x, int32_t y) {
  const size_t at = job.map.plan.At(x, y);
  const bool known = std::isfinite(GivenAt(job.map.light_field, y)[x]), differs = Differs(job, at);
  const bool moves = differs ? IsGainsaid(job, x, y) : job.chosen[at] != job.map.disparity[at];
  const bool changes = !known || (moves && !keeps);
  if (changes) {
    const float written = job.output.Clamped(MeanOfSurface(job, x, y));
    job.output.disparity.Row(y)[x] = written;
    job.to[at] = ToFixed(written);
  }
  if (differs && !changes) job.output.WriteConfidence(x, y, 0);
}

// Writes the disparities of the map to the pixels [x, x + count) of row y.
void WriteRow(const ColourJob& job, int32_t x, int32_t y, int32_t count) {
  const size_t at = job.map.plan.At(x, y);
  float* disparity = job.output.disparity.Row(y) + x;
  const bool noisy = job.map.disparity != job.memory->maps[0];
  for (int32_t k = 0; noisy && k < count; ++k) {
    disparity[k] = job.output.Clamped(static_cast<float>(job.map.disparity[at + k]) / kPixel);
    job.to[at + k] = ToFixed(disparity[k]);
  }
  if (!noisy) {
    std::copy_n(GivenAt(job.map.light_field, y) + x, count, disparity);
    std::copy_n(job.map.disparity + at, count, job.to + at);
  }
}

// Writes `disparity` to the output if `disparity` differs from the pixel's disparity in the job's
// map. The confidence of a changed pixel is set to 0, because the colour of the pixel alone does
// not support the change.
void Change(const ColourJob& job, int32_t x, int32_t y, int16_t disparity) {
  if (disparity == job.map.disparity[job.map.plan.At(x, y)]) return;
  job.output.Write(x, y, disparity);
  job.output.WriteConfidence(x, y, 0);
}

void WriteTile(const void* data, int32_t index, int32_t) {
  const ColourJob& job = JobOf(data);
  const ColourMemory& memory = *job.memory;
  const Rect tile = TileOf(job.map.plan, index);
  const ThinGrid grid = GridOf(job.map.plan);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) WriteRow(job, tile.x, y, tile.width);
  ForCells(grid, index, [&](const Rect& cell, int32_t number) {
    const bool keeps = memory.thin.thin[number] != 0;
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      ForDoubtful(memory.doubt + job.map.plan.At(cell.x, y), cell.width,
                  [&](int32_t k) { WritePixel(job, keeps, cell.x + k, y); });
    }
  });
  MeasureCells(grid, job.to, index, memory.ranges);
}

// Calls act(cell) for each cell of a tile that has a step larger than `step` in the cell or within
// `margin` pixels of the cell. Cells of thin structure are skipped if `skips_thin` is true.
// WidenTile writes disparities from up to kMostSoft + 1 pixels away, so the ranges of the cells of
// the repaired map exclude steps of the widened map as well.
template <class Act>
void ForSteps(const ColourJob& job, int32_t index, int32_t margin, int32_t step, bool skips_thin,
              const Act& act) {
  static_assert(kMajorityReach + kMostSoft + 1 <= kLeastCellSide, "MayHaveStep reads enough cells");
  const ThinGrid grid = GridOf(job.map.plan);
  ForCells(grid, index, [&](const Rect& cell, int32_t number) {
    if (skips_thin && job.memory->thin.thin[number] != 0) return;
    if (!MayHaveStep(grid, job.memory->ranges, number, step)) return;
    if (HasStep(job.map, cell, margin, step)) act(cell);
  });
}

void CountSoftEdges(const void* data, int32_t index, int32_t) {
  const ColourJob& job = JobOf(data);
  SoftCount count = {};
  ForSteps(job, index, 1, kSoftStep, false,
           [&](const Rect& cell) { CountSoft(job.map, cell, &count); });
  job.memory->soft[index] = count;
}

// Widens nearer surfaces by the number of pixels over which the picture's edges are soft.
void WidenTile(const void* data, int32_t index, int32_t) {
  const ColourJob& job = JobOf(data);
  const EstimatePlan& plan = job.map.plan;
  const Rect tile = TileOf(plan, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t at = job.map.plan.At(tile.x, y);
    std::copy_n(job.map.disparity + at, tile.width, job.to + at);
  }
  const int32_t softness = job.memory->softness;
  ForSteps(job, index, softness, kSoftStep, true, [&](const Rect& cell) {
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      if (!HasStep(job.map, {cell.x, y, cell.width, 1}, softness, kSoftStep)) continue;
      for (int32_t x = cell.x; x < cell.x + cell.width; ++x) {
        const int16_t widened = WidenedAt(job.map, softness, x, y);
        Change(job, x, y, widened);
        job.to[job.map.plan.At(x, y)] = widened;
      }
    }
  });
}

// Assigns pixels near outlines to the surface of most surrounding pixels. Unless the map is assumed
// to be right, also removes rests of ramps from the surfaces.
void EvenTile(const void* data, int32_t index, int32_t) {
  static_assert(kMostCellSide <= kMostMajority, "rows of cells");
  const ColourJob& job = JobOf(data);
  const bool right = job.memory->least_gain == kGains.right;
  ForSteps(job, index, kMajorityReach, kMajorityStep, true, [&](const Rect& cell) {
    int16_t even[kMostMajority];
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      TakeMajority(job.map, {cell.x, y, cell.width, 1}, even);
      const size_t at = job.map.plan.At(cell.x, y);
      ForDoubtful(job.memory->doubt + at, cell.width, [&](int32_t k) {
        if (!right && even[k] == job.map.disparity[at + static_cast<size_t>(k)]) {
          even[k] = MedianOfSurface(job.map, cell.x + k, y);
        }
      });
      for (int32_t k = 0; k < cell.width; ++k) Change(job, cell.x + k, y, even[k]);
    }
  });
}

void CompleteTile(const void* data, int32_t index, int32_t) {
  const ColourJob& job = JobOf(data);
  CompleteCoverage(job.map, job.output, job.memory->hair_cells, TileOf(job.map.plan, index));
}

// Converts the given map to fixed point (maps[0]) and measures its noise.
starfocus_status ReadMap(const ColourMap& given, const MapOutput& output,
                         const simd::DepthKernels& kernels, Phases* phases, ColourMemory* memory) {
  const Smoothing unused = {};
  const ColourJob job = {given, output, unused, memory->maps[0], nullptr, memory, kernels};
  starfocus_status status = phases->Run(ReadPart, &job);
  if (status != STARFOCUS_OK) return status;
  FillUnknownRows(given.plan, memory->maps[0]);
  const int32_t workers = memory->jobs.max_workers;
  for (int32_t k = 0; k < workers; ++k) *memory->workers[k].noise = {};
  status = phases->Run(CountPart, &job);
  NoiseCounts* all = memory->workers[0].noise;
  for (int32_t k = 1; k < workers; ++k) all->Add(*memory->workers[k].noise);
  memory->noise = NoiseOf(*all);
  return status;
}

// Repairs the map, except where hair was found.
starfocus_status ChooseByColour(const ColourMap& given, const simd::DepthKernels& kernels,
                                const MapOutput& output, Phases* phases, ColourMemory* memory) {
  const EstimatePlan& plan = given.plan;
  const starfocus_light_field& light_field = given.light_field;
  int16_t* const* maps = memory->maps;
  const int32_t noise = memory->noise;
  const ColourMap half = {plan, light_field, maps[1]};
  const ColourMap map = {plan, light_field, maps[noise > 0 ? 2 : 0]};
  int16_t* const written = maps[noise > 0 ? 0 : 2];
  const ColourMap repaired = {plan, light_field, written};
  ColourMap wide = {plan, light_field, maps[1]};
  // The first pass averages disparities within three standard deviations, which reduces the noise
  // to a third.
  const Smoothing first = {3, 1, 3 * noise}, second = {4, 2, 3 * noise / 2};
  const struct {
    JobFunction function;
    ColourJob job;
  } all[kColourPhases] = {
      {SmoothMap, {given, output, first, maps[1], nullptr, memory, kernels}},
      {SmoothMap, {half, output, second, maps[2], nullptr, memory, kernels}},
      {DoubtTile, {map, output, second, nullptr, nullptr, memory, kernels}},
      {ChooseTile, {map, output, second, nullptr, maps[1], memory, kernels}},
      {WriteTile, {map, output, second, written, maps[1], memory, kernels}},
      {CountSoftEdges, {repaired, output, second, nullptr, nullptr, memory, kernels}},
      {WidenTile, {repaired, output, second, maps[1], nullptr, memory, kernels}},
      {EvenTile, {wide, output, second, nullptr, nullptr, memory, kernels}},
      {CompleteTile, {map, output, second, nullptr, nullptr, memory, kernels}},
  };
  for (const auto& phase : all) {
    if (phase.function == WidenTile) {
      memory->softness = SoftnessOf(memory->soft, plan.columns * plan.rows);
      if (memory->softness == 0) wide.disparity = repaired.disparity;
    }
    const bool skips = phase.function == SmoothMap      ? noise == 0
                       : phase.function == WidenTile    ? memory->softness == 0
                       : phase.function == CompleteTile ? !memory->has_coverage
                                                        : false;
    if (skips) {
      phases->Skip();
      continue;
    }
    if (phase.function == WriteTile) JudgeMap(plan, memory);
    const starfocus_status status = phases->Run(phase.function, &phase.job);
    if (status != STARFOCUS_OK) return status;
  }
  return STARFOCUS_OK;
}

ColourTileMemory TakeTile(const EstimatePlan& plan, Arena* arena) {
  size_t width = 0, area = 0;
  for (int32_t tile = 0; tile < plan.columns * plan.rows; ++tile) {
    const Rect region = Widened(plan, TileOf(plan, tile), kTileMargin);
    const auto columns = static_cast<size_t>(region.width);
    width = columns > width ? columns : width;
    const size_t pixels = columns * static_cast<size_t>(region.height);
    area = pixels > area ? pixels : area;
  }
  ColourTileMemory memory;
  memory.choices.choices = arena->Take<Choices>(area);
  memory.choices.paths = arena->Take<ChoicePath>(width);
  memory.choices.cell = arena->Take<ColourCell>(1);
  memory.doubt = arena->Take<uint8_t>(area);
  memory.smooth = arena->Take<SmoothMemory>(1);
  memory.noise = arena->Take<NoiseCounts>(1);
  return memory;
}

}  // namespace

size_t LayOutColourRepair(const EstimatePlan& plan, int32_t max_workers, void* base,
                          ColourMemory** memory) {
  Arena arena(base);
  const auto width = static_cast<size_t>(plan.width), height = static_cast<size_t>(plan.height);
  *memory = arena.Take<ColourMemory>(1);
  const auto tiles = static_cast<size_t>(plan.columns) * static_cast<size_t>(plan.rows);
  auto* progress = arena.Take<std::atomic<uint32_t>>(ProgressWords(tiles));
  int16_t* maps[3];
  maps[0] = arena.Take<int16_t>(width, height);
  const HairCells hair_cells = TakeHairCells(plan.width, plan.height, &arena);
  const size_t mark = arena.Mark();
  for (int k = 1; k < 3; ++k) maps[k] = arena.Take<int16_t>(width, height);
  auto* gain = arena.Take<int16_t>(width, height);
  auto* doubt = arena.Take<uint8_t>(width, height);
  auto* counts = arena.Take<TileCount>(tiles);
  auto* soft = arena.Take<SoftCount>(tiles);
  const ThinCells thin = TakeThinCells(GridOf(plan), &arena);
  const CellRanges ranges = TakeCellRanges(GridOf(plan), &arena);
  // The search for coverage runs first, so the memory of the search may overlap the memory of all
  // later phases.
  arena.Reuse(mark);
  const HairMemory hair = TakeHairMemory(plan, &arena);
  arena.GoOn();
  auto* workers = arena.Take<ColourTileMemory>(static_cast<size_t>(max_workers));
  if (base != nullptr) {
    ColourMemory& made = *new (*memory) ColourMemory();
    made.jobs.max_workers = max_workers;
    made.jobs.progress = progress;
    for (int k = 0; k < 3; ++k) made.maps[k] = maps[k];
    made.gain = gain;
    made.doubt = doubt;
    made.counts = counts;
    made.soft = soft;
    made.thin = thin;
    made.ranges = ranges;
    made.hair_cells = hair_cells;
    made.hair = hair;
    made.workers = workers;
  }
  for (int32_t worker = 0; worker < max_workers; ++worker) {
    const ColourTileMemory tile = TakeTile(plan, &arena);
    if (base != nullptr) workers[worker] = tile;
  }
  return arena.Bytes();
}

starfocus_status RepairByColour(const EstimatePlan& plan, const starfocus_light_field& light_field,
                                const simd::DepthKernels& kernels, const MapOutput& output,
                                ColourMemory* memory) {
  const ColourMap given = {plan, light_field, memory->maps[0]};
  const int32_t before = kReadPhases + (output.coverage.data == nullptr ? 0 : kHairPhases);
  Phases phases(plan, before + kColourPhases, &memory->jobs);
  memory->has_coverage = false;
  starfocus_status status = ReadMap(given, output, kernels, &phases, memory);
  if (status == STARFOCUS_OK && output.coverage.data != nullptr) {
    status = FindHairCoverage(given, output, memory->hair_cells, memory->hair, &phases,
                              &memory->has_coverage);
  }
  if (status != STARFOCUS_OK) return status;
  return ChooseByColour(given, kernels, output, &phases, memory);
}

}  // namespace starfocus
