// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/hair_coverage.h"

#include <initializer_list>

#include "lib/base/fixed.h"
#include "lib/depth/hair_colours.h"
#include "lib/depth/hair_unmix.h"

namespace starfocus {
namespace {

// A map has hair with closed outlines if, of the pixels 2 to 4 cells inside outlines, a share of
// more than kLeastFar looks like background. Shares are in units of 1/256. In maps that neural
// networks compute for the hair scene, a share of 80/256 looks like background. In exact maps, maps
// that are wrong by 3 pixels, and photographs, the share that looks like background is at most
// 28/256 (docs/depth.md).
constexpr int64_t kLeastFar = 48;

void MeasureTile(const void* data, int32_t index, int32_t) {
  const HairJob& job = HairJobOf(data);
  ForHairCells(job.Tile(index), [&](int32_t column, int32_t row) {
    MeasureHairCell(job.map, column, row, job.cells);
  });
}

// Returns true if the map has hair with closed outlines.
bool HasClosedHair(const HairJob& job) {
  int64_t inside = 0, far = 0;
  for (int32_t k = 0; k < job.map.plan.columns * job.map.plan.rows; ++k) {
    inside += job.memory.counts[k].inside;
    far += job.memory.counts[k].far;
  }
  return far > kLeastFar * inside;
}

bool FindHair(const HairJob& job) {
  return MarkHair(job.cells, job.memory.near_pixels, job.memory.contrast);
}

bool CarryOnFar(const HairJob& job) { return CarryOnColours(job.memory.far); }
bool CarryOnNear(const HairJob& job) { return CarryOnColours(job.memory.near); }
bool GoOn(const HairJob&) { return true; }

}  // namespace

HairMemory TakeHairMemory(const EstimatePlan& plan, Arena* arena) {
  HairMemory memory;
  memory.far = TakeColourPyramid(plan.width, plan.height, arena);
  memory.near = TakeColourPyramid(plan.width, plan.height, arena);
  const ColourLevel& cells = memory.far.levels[0];
  for (int32_t** plane : {&memory.contrast, &memory.near_pixels}) {
    *plane =
        arena->Take<int32_t>(static_cast<size_t>(cells.columns), static_cast<size_t>(cells.rows));
  }
  memory.counts =
      arena->Take<InsideCount>(static_cast<size_t>(plan.columns), static_cast<size_t>(plan.rows));
  return memory;
}

starfocus_status FindHairCoverage(const ColourMap& map, const MapOutput& output,
                                  const HairCells& cells, const HairMemory& memory, Phases* phases,
                                  bool* found) {
  const HairJob job = {map, output, cells, memory};
  // The phases of the search. When all tiles of a phase are finished, `conclude` processes the
  // results for the whole picture. The search ends if `conclude` returns false.
  const struct {
    JobFunction function;
    bool (*conclude)(const HairJob& job);
  } all[kHairPhases] = {
      {MeasureTile, [](const HairJob& j) { return MarkEdges(j.cells); }},
      {PullFar, CarryOnFar},
      {MeasureContrast, GoOn},
      {PullNear, CarryOnNear},
      {CountInside, HasClosedHair},
      {CountCells, FindHair},
      {UnmixFirst, GoOn},
      {PullBoth, [](const HairJob& j) { return CarryOnFar(j) && CarryOnNear(j); }},
      {UnmixAgain, GoOn},
  };
  *found = true;
  for (const auto& phase : all) {
    if (!*found) {
      phases->Skip();
      continue;
    }
    const starfocus_status status = phases->Run(phase.function, &job);
    if (status != STARFOCUS_OK) return status;
    *found = phase.conclude(job);
  }
  return STARFOCUS_OK;
}

void CompleteCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                      const Rect& tile) {
  ForHairCells(tile, [&](int32_t column, int32_t row) {
    const size_t at = cells.At(column, row);
    const Rect cell = HairCellAt(map.plan, column, row);
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      const float* disparities = output.disparity + static_cast<size_t>(y) * output.stride;
      uint8_t* coverage = output.coverage + static_cast<size_t>(y) * output.coverage_stride;
      for (int32_t x = cell.x; x < cell.x + cell.width; ++x) {
        const bool is_near = cells.marks[at] == 0 || cells.IsNear(at, ToFixed(disparities[x]));
        if ((cells.marks[at] & HairCells::kHasHair) == 0) {
          coverage[x] = is_near ? UINT8_MAX : uint8_t{0};
        } else if (output.confidence != nullptr) {
          output.confidence[static_cast<size_t>(y) * output.confidence_stride +
                            static_cast<size_t>(x)] =
              static_cast<uint8_t>(is_near ? coverage[x] : UINT8_MAX - coverage[x]);
        }
      }
    }
  });
}

}  // namespace starfocus
