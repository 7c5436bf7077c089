// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_repair.h"

#include <algorithm>
#include <cmath>

#include "lib/base/fixed.h"
#include "lib/depth/colour_map.h"

namespace starfocus {
namespace {

// Number of phases, without the phases of FindHairCoverage.
constexpr int32_t kPhases = 7 + kOutlinePhases;

// Converts the given map to fixed point (memory.outlines.given) and returns its noise.
int32_t ReadMap(const ColourMap& given, const ColourMemory& memory, Sequence* run) {
  const SweepSetup& setup = given.setup;
  const auto rows = [&](int32_t index) {
    return PartOf({0, setup.height}, index, setup.columns * setup.rows);
  };
  run->Run([&](int32_t index, int32_t) {
    ReadRows(setup, given.light_field, rows(index), memory.outlines.given);
  });
  if (run->status() != STARFOCUS_OK) return 0;
  FillUnknownRows(setup, memory.outlines.given);
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

// Smooths the map in two passes, unless it is not noisy.
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
               memory.outlines.repaired);
  });
  const ColourMap half = {setup, given.light_field, memory.outlines.repaired};
  run->Run([&](int32_t index, int32_t worker) {
    SmoothTile(half, 4, 2, 3 * noise / 2, TileOf(setup, index), kernels,
               memory.workers[worker].ring, memory.outlines.given);
  });
}

// Writes the repaired map of a tile. A disparity that is as in the given map is copied exactly.
void WriteTile(const ColourMap& map, const MapOutput& output, const OutlineMemory& outlines,
               const int16_t* repaired, const Rect& tile) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const float* given = GivenAt(map.light_field, y);
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = map.setup.At(x, y);
      const bool known = std::isfinite(given[x]);
      const int32_t vote = Abs(outlines.vote[at]);
      const int32_t confidence = outlines.distance[at] != 0 ? 2 * vote : UINT8_MAX;
      output.WriteConfidence(x, y, static_cast<uint8_t>(confidence));
      if (known && repaired[at] == ToFixed(given[x])) {
        output.disparity.Row(y)[x] = given[x];
      } else {
        output.Write(x, y, repaired[at]);
      }
    }
  }
}

// The parts of a map that are kept: thin structure and hair.
struct Kept {
  const SweepSetup* setup;
  const starfocus_light_field* light_field;
  const ColourMemory* memory;
  bool has_hair;

  static Rect Tile(const void* data, int32_t index) {
    return TileOf(*static_cast<const Kept*>(data)->setup, index);
  }
  static bool Known(const void* data, int32_t x, int32_t y) {
    return std::isfinite(GivenAt(*static_cast<const Kept*>(data)->light_field, y)[x]);
  }
  static void Keep(const void* data, int32_t index, int8_t* side) {
    const Kept& kept = *static_cast<const Kept*>(data);
    const ColourMemory& memory = *kept.memory;
    ForCells(GridOf(*kept.setup), index, [&](const Rect& cell, int32_t number) {
      if (memory.thin.thin[number] == 0 && !(kept.has_hair && HasHair(memory.hair, cell))) return;
      for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
        std::fill_n(side + kept.setup->At(cell.x, y), cell.width, int8_t{0});
      }
    });
  }
};

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

}  // namespace

ColourMemory TakeColourRepair(const SweepSetup& setup, int32_t max_workers, Arena* arena) {
  const auto workers = static_cast<size_t>(max_workers);
  ColourMemory memory = {};
  memory.jobs = TakeJobs(setup, max_workers, arena);
  memory.hair = TakeHairMemory(setup.width, setup.height, arena);
  TakeHairColours(setup.width, setup.height, arena, &memory.hair);
  memory.thin = TakeThinCells(GridOf(setup), arena);
  memory.outlines = TakeOutlines(setup.width, setup.height, max_workers, arena);
  memory.workers = arena->Take<ColourWorker>(workers);
  for (size_t worker = 0; worker < workers; ++worker) {
    const ColourWorker of_worker = {arena->Take<int32_t>(kSmoothSamples),
                                    arena->Take<uint32_t>(kNoiseCounts)};
    if (memory.workers != nullptr) memory.workers[worker] = of_worker;
  }
  return memory;
}

starfocus_status RepairByColour(const SweepSetup& setup, const starfocus_light_field& light_field,
                                const simd::DepthKernels& kernels, const MapOutput& output,
                                const ColourMemory& memory, bool* has_coverage) {
  const ColourMap map = {setup, light_field, memory.outlines.given};
  const bool covers = output.coverage.data != nullptr;
  const int32_t tiles = setup.columns * setup.rows;
  Sequence run(memory.jobs, kPhases + (covers ? kHairPhases : 0), tiles);
  const int32_t noise = ReadMap(map, memory, &run);
  const Plane<const uint8_t> rgb = RowsOf(light_field.views[0]);
  const HairPicture hair = {setup.width,
                            setup.height,
                            rgb,
                            {memory.outlines.given, static_cast<size_t>(setup.width), 0, 0},
                            output.coverage};
  *has_coverage = covers && FindHairCoverage(hair, memory.hair, &run);
  SmoothMap(map, noise, kernels, memory, &run);
  run.Run([&](int32_t index, int32_t) {
    CountBeside(GridOf(setup), map.disparity, TileOf(setup, index), index, memory.thin);
  });
  if (run.status() != STARFOCUS_OK) return run.status();
  FindThin(GridOf(setup), kThinGiven, memory.thin);
  const Kept kept = {&setup, &light_field, &memory, *has_coverage};
  const OutlinePicture picture = {&kernels,   rgb,        tiles,       memory.jobs->max_workers,
                                  Kept::Tile, Kept::Keep, Kept::Known, &kept};
  const int16_t* repaired = FollowOutlines(picture, memory.outlines, &run);
  run.Run([&](int32_t index, int32_t) {
    WriteTile(map, output, memory.outlines, repaired, TileOf(setup, index));
  });
  if (*has_coverage) {
    run.Run(
        [&](int32_t index, int32_t) { CompleteTile(output, memory.hair, TileOf(setup, index)); });
  } else {
    run.Skip();
  }
  return run.status();
}

}  // namespace starfocus
