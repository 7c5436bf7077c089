// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_repair.h"

#include <algorithm>
#include <cmath>

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
constexpr int32_t kRightGain = 1000, kWrongGain = 60;
// Number of directions of the paths along which costs are summed.
constexpr int32_t kPaths = 4;
// Number of phases, without the phases of FindHairCoverage.
constexpr int32_t kPhases = 11;
// Changed pixels get the mean disparity of the chosen surface within kMeanRadius. In this mean,
// pixels far from steps have weight kSureWeight, and pixels near steps have weight 1.
constexpr int32_t kMeanRadius = 5, kSureWeight = 4;

// Chooses the disparity with the smallest sum for a doubtful pixel, and computes the pixel's gain.
// On ramps, the map's disparity lies between two surfaces and is never chosen.
// Returns the cost of the best other surface minus the cost of the chosen surface, divided by the
// number of paths.
uint8_t Choose(const ColourMap& map, const Choices& choices, size_t at,
               const ColourMemory& memory) {
  const int32_t given = map.disparity[at];
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
  const bool keeps = same && memory.doubt[at] != 0;
  memory.chosen[at] = keeps ? static_cast<int16_t>(given) : choices.disparity[best];
  memory.gain[at] =
      same ? int16_t{0} : static_cast<int16_t>(choices.cost[own] - choices.cost[best]);
  return static_cast<uint8_t>(margin / kPaths);
}

// Returns true if a doubtful pixel would move to another surface.
bool Differs(const ColourMap& map, const ColourMemory& memory, size_t at) {
  return Abs(memory.chosen[at] - map.disparity[at]) > kSameSurface;
}

TileCount CountTile(const ColourMap& map, const ColourMemory& memory, const Rect& tile) {
  TileCount count = {};
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    ForDoubtful(memory.doubt + map.setup.At(tile.x, y), tile.width, [&](int32_t k) {
      const size_t at = map.setup.At(tile.x + k, y);
      const int32_t doubt = memory.doubt[at];
      // Pixels on ramps count as edge pixels.
      if (doubt > kThinDoubt || (doubt != 0 && !IsBesideStep(map, tile, tile.x + k, y))) return;
      ++count.rough;
      count.differs += Differs(map, memory, at) ? 1 : 0;
    });
  }
  return count;
}

void ChooseTile(const ColourMap& map, const MapOutput& output, const simd::DepthKernels& kernels,
                int32_t index, const ChoiceMemory& choices, const ColourMemory& memory) {
  const Rect tile = TileOf(map.setup, index);
  if (tile.width == 0 || tile.height == 0) return;
  const Rect region = Widened(map.setup, tile, kTileMargin);
  WeighChoices(map, memory.doubt, region, kernels, choices);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const Choices* row = choices.choices + (y - region.y) * region.width + tile.x - region.x;
    const size_t at = map.setup.At(tile.x, y);
    std::fill_n(memory.gain + at, tile.width, int16_t{0});
    if (output.confidence.data != nullptr) {
      std::fill_n(output.confidence.Row(y) + tile.x, tile.width, uint8_t{UINT8_MAX});
    }
    ForDoubtful(memory.doubt + at, tile.width, [&](int32_t k) {
      const uint8_t certainty = Choose(map, row[k], at + static_cast<size_t>(k), memory);
      output.WriteConfidence(tile.x + k, y, certainty);
    });
  }
  memory.counts[index] = CountTile(map, memory, tile);
  CountBeside(GridOf(map.setup), map.disparity, tile, index, memory.thin);
}

// Returns the gain (saved cost) that a change requires, from the counts of all tiles. Marks the
// cells that must not change, which are the cells with thin structure or hair.
int32_t JudgeMap(const SweepSetup& setup, const ColourMemory& memory, bool has_hair) {
  const ThinGrid grid = GridOf(setup);
  FindThin(grid, kThinGiven, memory.thin);
  for (int32_t number = 0; has_hair && number < grid.Cells(); ++number) {
    const Rect cell = grid.CellAt(number % grid.columns, number / grid.columns);
    if (HasHair(memory.hair, cell)) memory.thin.thin[number] = 1;
  }
  return LeastEvidence(memory.counts, setup.columns * setup.rows, kRightGain, kWrongGain);
}

// Returns true if the total gain of the changes around a pixel is large enough to contradict the
// map.
bool IsGainsaid(const SweepSetup& setup, const int16_t* gains, int32_t least_gain, int32_t x,
                int32_t y) {
  const Rect around = Widened(setup, {x, y, 1, 1}, kGainRadius);
  int32_t gain = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      gain += gains[setup.At(column, row)];
    }
  }
  return gain >= least_gain;
}

// Returns the weighted mean of the map's disparities around pixel (x, y) that belong to the surface
// chosen for this pixel.
float MeanOfSurface(const ColourMap& map, const ColourMemory& memory, int32_t x, int32_t y) {
  const int32_t own = memory.chosen[map.setup.At(x, y)];
  const Rect around = Widened(map.setup, {x, y, 1, 1}, kMeanRadius);
  int32_t sum = 0, weights = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const size_t at = map.setup.At(column, row);
      const int32_t doubt = memory.doubt[at];
      if (doubt == 0 || Abs(map.disparity[at] - own) > kPixel) continue;
      const int32_t weight = doubt > kDisplacement ? kSureWeight : 1;
      sum += weight * map.disparity[at];
      weights += weight;
    }
  }
  if (weights == 0) return static_cast<float>(own) / kPixel;
  return static_cast<float>(sum) / static_cast<float>(weights * kPixel);
}

// Writes a doubtful pixel, to which WriteTile has written the map's disparity, to the output and to
// the map `repaired`. If `keeps` is true, known disparities are not changed.
void WritePixel(const ColourMap& map, const ColourMemory& memory, const MapOutput& output,
                int32_t least_gain, bool keeps, int32_t x, int32_t y, int16_t* repaired) {
  const size_t at = map.setup.At(x, y);
  const int16_t chosen = memory.chosen[at];
  const bool known = std::isfinite(GivenAt(map.light_field, y)[x]);
  const bool differs = Differs(map, memory, at);
  const bool moves =
      differs ? IsGainsaid(map.setup, memory.gain, least_gain, x, y) : chosen != map.disparity[at];
  const bool changes = !known || (moves && !keeps);
  if (changes) {
    const float written = output.Clamped(MeanOfSurface(map, memory, x, y));
    output.disparity.Row(y)[x] = written;
    repaired[at] = ToFixed(written);
  }
  if (differs && !changes) output.WriteConfidence(x, y, 0);
}

// Writes the repaired map of a tile to the output and to `repaired`.
void WriteTile(const ColourMap& map, const ColourMemory& memory, const MapOutput& output,
               int32_t least_gain, int32_t index, int16_t* repaired) {
  const Rect tile = TileOf(map.setup, index);
  const ThinGrid grid = GridOf(map.setup);
  const bool noisy = map.disparity != memory.given;
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t at = map.setup.At(tile.x, y);
    float* disparity = output.disparity.Row(y) + tile.x;
    for (int32_t k = 0; noisy && k < tile.width; ++k) {
      disparity[k] = output.Clamped(static_cast<float>(map.disparity[at + k]) / kPixel);
      repaired[at + k] = ToFixed(disparity[k]);
    }
    if (noisy) continue;
    std::copy_n(GivenAt(map.light_field, y) + tile.x, tile.width, disparity);
    std::copy_n(map.disparity + at, tile.width, repaired + at);
  }
  ForCells(grid, index, [&](const Rect& cell, int32_t number) {
    const bool keeps = memory.thin.thin[number] != 0;
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      ForDoubtful(memory.doubt + map.setup.At(cell.x, y), cell.width, [&](int32_t k) {
        WritePixel(map, memory, output, least_gain, keeps, cell.x + k, y, repaired);
      });
    }
  });
  MeasureCells(grid, repaired, index, memory.ranges);
}

// Writes `disparity` to the output if `disparity` differs from the pixel's disparity in the map.
// The confidence of a changed pixel is set to 0, because the colour of the pixel alone does not
// support the change.
void Change(const ColourMap& map, const MapOutput& output, int32_t x, int32_t y,
            int16_t disparity) {
  if (disparity == map.disparity[map.setup.At(x, y)]) return;
  output.Write(x, y, disparity);
  output.WriteConfidence(x, y, 0);
}

// Calls act(cell) for each cell of a tile that has a step larger than `step` in the cell or within
// `margin` pixels of the cell. Cells of thin structure are skipped if `skips_thin` is true.
// WidenTile writes disparities from up to kMostSoft + 1 pixels away, so the ranges of the cells of
// the repaired map exclude steps of the widened map as well.
template <class Act>
void ForSteps(const ColourMap& map, const ColourMemory& memory, int32_t index, int32_t margin,
              int32_t step, bool skips_thin, const Act& act) {
  static_assert(kMajorityReach + kMostSoft + 1 <= kLeastCellSide, "MayHaveStep reads enough cells");
  const ThinGrid grid = GridOf(map.setup);
  ForCells(grid, index, [&](const Rect& cell, int32_t number) {
    if (skips_thin && memory.thin.thin[number] != 0) return;
    if (!MayHaveStep(grid, memory.ranges, number, step)) return;
    if (HasStep(map, cell, margin, step)) act(cell);
  });
}

// Widens nearer surfaces by `softness`, the number of pixels over which the picture's edges are
// soft. Writes the changes to the output, and the widened map to `widened`.
void WidenTile(const ColourMap& map, const ColourMemory& memory, const MapOutput& output,
               int32_t softness, int32_t index, int16_t* widened) {
  const Rect tile = TileOf(map.setup, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t at = map.setup.At(tile.x, y);
    std::copy_n(map.disparity + at, tile.width, widened + at);
  }
  ForSteps(map, memory, index, softness, kSoftStep, true, [&](const Rect& cell) {
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      if (!HasStep(map, {cell.x, y, cell.width, 1}, softness, kSoftStep)) continue;
      for (int32_t x = cell.x; x < cell.x + cell.width; ++x) {
        const int16_t disparity = WidenedAt(map, softness, x, y);
        Change(map, output, x, y, disparity);
        widened[map.setup.At(x, y)] = disparity;
      }
    }
  });
}

// Assigns pixels near outlines to the surface of most surrounding pixels. Unless the map is assumed
// to be right, also removes rests of ramps from the surfaces.
void EvenTile(const ColourMap& map, const ColourMemory& memory, const MapOutput& output,
              bool is_right, int32_t index) {
  static_assert(kMostCellSide <= kMostMajority, "rows of cells");
  ForSteps(map, memory, index, kMajorityReach, kMajorityStep, true, [&](const Rect& cell) {
    int16_t even[kMostMajority];
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      TakeMajority(map, {cell.x, y, cell.width, 1}, even);
      const size_t at = map.setup.At(cell.x, y);
      ForDoubtful(memory.doubt + at, cell.width, [&](int32_t k) {
        if (!is_right && even[k] == map.disparity[at + static_cast<size_t>(k)]) {
          even[k] = MedianOfSurface(map, cell.x + k, y);
        }
      });
      for (int32_t k = 0; k < cell.width; ++k) Change(map, output, cell.x + k, y, even[k]);
    }
  });
}

// Converts the given map to fixed point (memory.given) and returns its noise.
int32_t ReadMap(const ColourMap& given, const ColourMemory& memory, Sequence* run) {
  const SweepSetup& setup = given.setup;
  const auto rows = [&](int32_t index) {
    return PartOf({0, setup.height}, index, setup.columns * setup.rows);
  };
  run->Run([&](int32_t index, int32_t) {
    ReadRows(setup, given.light_field, rows(index), memory.given);
  });
  if (run->status() != STARFOCUS_OK) return 0;
  FillUnknownRows(setup, memory.given);
  const int32_t workers = memory.jobs->max_workers;
  for (int32_t k = 0; k < workers; ++k) std::fill_n(memory.workers[k].noise, kNoiseCounts, 0U);
  run->Run([&](int32_t index, int32_t worker) {
    CountNoise(setup, given.disparity, rows(index), memory.workers[worker].noise);
  });
  uint32_t* all = memory.workers[0].noise;
  for (int32_t k = 1; k < workers; ++k) {
    for (int32_t n = 0; n < kNoiseCounts; ++n) all[n] += memory.workers[k].noise[n];
  }
  return NoiseOf(all);
}

// Smooths `given` in two passes, unless it is not noisy. Writes the half smoothed map to
// memory.chosen, and the smoothed map to memory.smooth.
void SmoothMap(const ColourMap& given, int32_t noise, const simd::DepthKernels& kernels,
               const ColourMemory& memory, Sequence* run) {
  if (noise == 0) {
    run->Skip();
    run->Skip();
    return;
  }
  const SweepSetup& setup = given.setup;
  // The first pass averages disparities within three standard deviations, which reduces the noise
  // to a third.
  run->Run([&](int32_t index, int32_t worker) {
    SmoothTile(given, 3, 1, 3 * noise, TileOf(setup, index), kernels, memory.workers[worker].ring,
               memory.chosen);
  });
  const ColourMap half = {setup, given.light_field, memory.chosen};
  run->Run([&](int32_t index, int32_t worker) {
    SmoothTile(half, 4, 2, 3 * noise / 2, TileOf(setup, index), kernels,
               memory.workers[worker].ring, memory.smooth);
  });
}

// Repairs the map, except where hair was found.
void ChooseByColour(const ColourMap& map, bool has_hair, const simd::DepthKernels& kernels,
                    const MapOutput& output, const ColourMemory& memory, Sequence* run) {
  const SweepSetup& setup = map.setup;
  run->Run([&](int32_t index, int32_t worker) {
    MeasureDoubt(map, TileOf(setup, index), memory.workers[worker].doubt, memory.doubt);
  });
  run->Run([&](int32_t index, int32_t worker) {
    ChooseTile(map, output, kernels, index, memory.workers[worker].choices, memory);
  });
  if (run->status() != STARFOCUS_OK) return;
  const int32_t least_gain = JudgeMap(setup, memory, has_hair);
  int16_t* const written = map.disparity == memory.given ? memory.smooth : memory.given;
  run->Run(
      [&](int32_t index, int32_t) { WriteTile(map, memory, output, least_gain, index, written); });
  const ColourMap repaired = {setup, map.light_field, written};
  run->Run([&](int32_t index, int32_t) {
    SoftCount count = {};
    ForSteps(repaired, memory, index, 1, kSoftStep, false,
             [&](const Rect& cell) { CountSoft(repaired, cell, &count); });
    memory.soft[index] = count;
  });
  if (run->status() != STARFOCUS_OK) return;
  const int32_t softness = SoftnessOf(memory.soft, setup.columns * setup.rows);
  const ColourMap wide = {setup, map.light_field, softness > 0 ? memory.chosen : written};
  if (softness > 0) {
    run->Run([&](int32_t index, int32_t) {
      WidenTile(repaired, memory, output, softness, index, memory.chosen);
    });
  } else {
    run->Skip();
  }
  const bool is_right = least_gain == kRightGain;
  run->Run([&](int32_t index, int32_t) { EvenTile(wide, memory, output, is_right, index); });
}

// Completes the coverage of a tile, whose disparities have been written to the output.
void CompleteTile(const MapOutput& output, const HairMemory& hair, const Rect& tile) {
  int16_t disparity[kMostTileSide];
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t k = 0; k < tile.width; ++k) {
      disparity[k] = ToFixed(output.disparity.Row(y)[tile.x + k]);
    }
    uint8_t* const confidence =
        output.confidence.data == nullptr ? nullptr : output.confidence.Row(y) + tile.x;
    CompleteCoverage(hair, {tile.x, tile.x + tile.width}, y, disparity,
                     output.coverage.Row(y) + tile.x, confidence);
  }
}

ColourTileMemory TakeTile(const SweepSetup& setup, Arena* arena) {
  size_t width = 0, area = 0;
  for (int32_t tile = 0; tile < setup.columns * setup.rows; ++tile) {
    const Rect region = Widened(setup, TileOf(setup, tile), kTileMargin);
    const auto columns = static_cast<size_t>(region.width);
    width = columns > width ? columns : width;
    const size_t pixels = columns * static_cast<size_t>(region.height);
    area = pixels > area ? pixels : area;
  }
  ColourTileMemory memory;
  memory.choices = TakeChoices(width, area, arena);
  memory.doubt = arena->Take<uint8_t>(area);
  memory.ring = arena->Take<int32_t>(kSmoothSamples);
  memory.noise = arena->Take<uint32_t>(kNoiseCounts);
  return memory;
}

}  // namespace

ColourMemory TakeColourRepair(const SweepSetup& setup, int32_t max_workers, Arena* arena) {
  const auto width = static_cast<size_t>(setup.width), height = static_cast<size_t>(setup.height);
  const auto tiles = static_cast<size_t>(setup.columns) * static_cast<size_t>(setup.rows);
  ColourMemory memory = {};
  memory.jobs = TakeJobs(setup, max_workers, arena);
  memory.given = arena->Take<int16_t>(width, height);
  memory.hair = TakeHairMemory(setup.width, setup.height, arena);
  // The search for coverage has ended before the first of the other phases begins.
  arena->Overlap([&] { TakeHairColours(setup.width, setup.height, arena, &memory.hair); },
                 [&] {
                   memory.chosen = arena->Take<int16_t>(width, height);
                   memory.smooth = arena->Take<int16_t>(width, height);
                   memory.gain = arena->Take<int16_t>(width, height);
                   memory.doubt = arena->Take<uint8_t>(width, height);
                   memory.counts = arena->Take<TileCount>(tiles);
                   memory.soft = arena->Take<SoftCount>(tiles);
                   memory.thin = TakeThinCells(GridOf(setup), arena);
                   memory.ranges = TakeCellRanges(GridOf(setup), arena);
                 });
  memory.workers = arena->Take<ColourTileMemory>(static_cast<size_t>(max_workers));
  for (int32_t worker = 0; worker < max_workers; ++worker) {
    const ColourTileMemory tile = TakeTile(setup, arena);
    if (memory.workers != nullptr) memory.workers[worker] = tile;
  }
  return memory;
}

starfocus_status RepairByColour(const SweepSetup& setup, const starfocus_light_field& light_field,
                                const simd::DepthKernels& kernels, const MapOutput& output,
                                const ColourMemory& memory, bool* has_coverage) {
  const ColourMap given = {setup, light_field, memory.given};
  const bool covers = output.coverage.data != nullptr;
  Sequence run(memory.jobs, kPhases + (covers ? kHairPhases : 0), setup.columns * setup.rows);
  const int32_t noise = ReadMap(given, memory, &run);
  const HairPicture picture = {setup.width,
                               setup.height,
                               RowsOf(light_field.views[0]),
                               {memory.given, static_cast<size_t>(setup.width), 0, 0},
                               output.coverage};
  *has_coverage = covers && FindHairCoverage(picture, memory.hair, &run);
  SmoothMap(given, noise, kernels, memory, &run);
  const ColourMap map = {setup, light_field, noise > 0 ? memory.smooth : memory.given};
  ChooseByColour(map, *has_coverage, kernels, output, memory, &run);
  if (*has_coverage) {
    run.Run(
        [&](int32_t index, int32_t) { CompleteTile(output, memory.hair, TileOf(setup, index)); });
  } else {
    run.Skip();
  }
  return run.status();
}

}  // namespace starfocus
