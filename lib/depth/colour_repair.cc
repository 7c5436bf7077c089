// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_repair.h"

#include <cmath>
#include <new>

#include "lib/base/carver.h"
#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Changed pixels get the mean of the surface around them.
constexpr int32_t kMeanRadius = 5;

struct ColourJob {
  const ColourMap& map;
  const MapOutput& output;
  const Smoothing& smoothing;
  int16_t* smooth;
  const ColourMemory& memory;
};

const ColourJob& JobOf(const void* data) { return *static_cast<const ColourJob*>(data); }

void SmoothMap(const void* data, int32_t index, int32_t) {
  const ColourJob& job = JobOf(data);
  SmoothTile(job.map, job.smoothing, TileOf(job.map.plan, index), job.smooth);
}

// Returns the mean of the map's pixels around (x, y) that are within a pixel of disparity `own`.
float MeanOfSurface(const ColourJob& job, int32_t x, int32_t y, int32_t own) {
  const Rect around = Widened(job.map.plan, {x, y, 1, 1}, kMeanRadius);
  int32_t sum = 0, count = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const size_t at = job.map.At(column, row);
      if ((job.memory.coverage.levels.place[at] & kOnRamp) != 0) continue;
      if (Abs(job.map.disparity[at] - own) > kPixel) continue;
      sum += job.map.disparity[at];
      ++count;
    }
  }
  if (count == 0) return static_cast<float>(own) / kPixel;
  return static_cast<float>(sum) / static_cast<float>(count * kPixel);
}

// Returns the disparity of the surface that covers most of a pixel.
int32_t ChosenLevel(const CoverageMemory& memory, size_t at, const PixelCoverage& pixel) {
  const bool is_near = pixel.coverage > kCovered / 2;
  if (!pixel.is_thin) return memory.alike[is_near ? 1 : 0][at];
  return is_near ? memory.levels.near_level[at] : memory.levels.far_level[at];
}

// Returns whether the map's disparity gives way to that of the surface that covers most of the
// pixel.
bool IsChanged(const ColourJob& job, size_t at, const PixelCoverage& pixel) {
  const CoverageMemory& memory = job.memory.coverage;
  if (memory.exact || !pixel.is_mixed) return false;
  // Without coverage the map shows thin structure best: as a whole.
  if (pixel.is_thin) return job.output.coverage != nullptr;
  const bool on_ramp = (memory.levels.place[at] & kOnRamp) != 0;
  return on_ramp || Abs(ChosenLevel(memory, at, pixel) - job.map.disparity[at]) > kPixel;
}

// Writes coverage, which agrees with a disparity that was kept.
void WriteCoverage(const ColourJob& job, int32_t x, int32_t y, const PixelCoverage& pixel,
                   bool kept) {
  if (job.output.coverage == nullptr) return;
  const uint8_t place = job.memory.coverage.levels.place[job.map.At(x, y)];
  int32_t coverage = pixel.coverage;
  if (kept && pixel.is_mixed) {
    const bool near_side = (place & kNearSide) != 0;
    coverage = near_side ? Max(coverage, kCovered / 2 + 1) : Min(coverage, kCovered / 2);
  }
  job.output
      .coverage[static_cast<size_t>(y) * job.output.coverage_stride + static_cast<size_t>(x)] =
      static_cast<uint8_t>(coverage);
}

void WritePixel(const ColourJob& job, int32_t x, int32_t y) {
  const size_t at = job.map.At(x, y), row = static_cast<size_t>(y), column = static_cast<size_t>(x);
  const CoverageMemory& memory = job.memory.coverage;
  const float given = GivenAt(job.map.light_field, y)[x];
  const bool known = std::isfinite(given);
  const PixelCoverage pixel = CoverageAt(job.map.plan, memory, x, y);
  const bool changes = !known || IsChanged(job, at, pixel);
  const bool noisy = job.map.disparity != job.memory.maps[0];
  float value = noisy ? static_cast<float>(job.map.disparity[at]) / kPixel : given;
  if (changes) {
    int32_t own = job.map.disparity[at];
    if (pixel.is_mixed) own = ChosenLevel(memory, at, pixel);
    value = job.output.Clamped(MeanOfSurface(job, x, y, own));
  }
  job.output.disparity[row * job.output.stride + column] = value;
  WriteCoverage(job, x, y, pixel, !changes);
  if (job.output.confidence == nullptr) return;
  const int32_t certainty =
      pixel.is_mixed ? Abs(2 * pixel.coverage - kCovered) * pixel.trust / 255 : 255;
  job.output.confidence[row * job.output.confidence_stride + column] =
      static_cast<uint8_t>(certainty);
}

void WriteTile(const void* data, int32_t index, int32_t) {
  const ColourJob& job = JobOf(data);
  const Rect tile = TileOf(job.map.plan, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) WritePixel(job, x, y);
  }
}

}  // namespace

size_t LayOutColourRepair(const EstimatePlan& plan, int32_t max_workers, void* base,
                          ColourMemory** memory) {
  Carver carver(base);
  const auto width = static_cast<size_t>(plan.width), height = static_cast<size_t>(plan.height);
  *memory = carver.Take<ColourMemory>(1);
  const auto tiles = static_cast<size_t>(plan.columns) * static_cast<size_t>(plan.rows);
  auto* progress = carver.Take<std::atomic<uint32_t>>(ProgressWords(tiles));
  int16_t* maps[3];
  for (int16_t*& map : maps) map = carver.Take<int16_t>(width, height);
  const CoverageMemory coverage = TakeCoverage(plan, max_workers, &carver);
  if (base != nullptr) {
    ColourMemory& made = *new (*memory) ColourMemory();
    made.jobs.max_workers = max_workers;
    made.jobs.progress = progress;
    for (int k = 0; k < 3; ++k) made.maps[k] = maps[k];
    made.coverage = coverage;
  }
  return carver.Bytes();
}

sf_status RepairByColour(const EstimatePlan& plan, const sf_light_field& light_field,
                         const Runner& runner, const MapOutput& output, ColourMemory* memory) {
  int16_t* const* maps = memory->maps;
  ReadMap(plan, light_field, maps[0]);
  const int32_t noise = MeasureNoise(plan, maps[0]);
  const ColourMap given = {plan, light_field, maps[0]}, half = {plan, light_field, maps[1]};
  const ColourMap map = {plan, light_field, maps[noise > 0 ? 2 : 0]};
  // Within three standard deviations first; what that leaves is a third as noisy.
  const Smoothing first = {3, 1, 3 * noise}, second = {4, 2, 3 * noise / 2};
  constexpr int32_t kParts = kCoverageParts + 3;
  const struct {
    const ColourMap& from;
    const Smoothing& smoothing;
    int16_t* to;
  } steps[] = {{given, first, maps[1]}, {half, second, maps[2]}};
  const int32_t tiles = plan.columns * plan.rows;
  int32_t done = 0;
  for (const auto& step : steps) {
    memory->jobs.watch.SetPart(done++, kParts);
    if (noise == 0) continue;
    const ColourJob job = {step.from, output, step.smoothing, step.to, *memory};
    const sf_status status = RunJobSet(SmoothMap, &job, tiles, runner, &memory->jobs);
    if (status != SF_OK) return status;
  }
  const sf_status status =
      FindAllCoverage(map, runner, done, kParts, &memory->jobs, &memory->coverage);
  if (status != SF_OK) return status;
  memory->jobs.watch.SetPart(kParts - 1, kParts);
  const ColourJob job = {map, output, second, nullptr, *memory};
  return RunJobSet(WriteTile, &job, tiles, runner, &memory->jobs);
}

}  // namespace starfocus
