// SPDX-License-Identifier: Apache-2.0
// Repairs a given disparity map by two sweeps over its doubtful pixels, and changes only pixels for
// which the views are sufficient evidence.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/depth/sweep.h"
#include "lib/depth/swept.h"
#include "lib/io/image.h"
#include "simd/disparities.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Largest difference between disparities that are averaged as one surface, in fixed point
// (kDisparityBits).
constexpr int32_t kSameSurface = 38;
// Largest difference at which a disparity counts as equal to the given disparity.
constexpr int32_t kSame = kPixel / 4;
constexpr int32_t kMeanRadius = 3, kEvidenceRadius = 2;
// Largest distance in pixels from a pixel that mixes two surfaces to trusted disparities of the
// nearer surface. kNearRadius spans a ramp of disparities that is 12 pixels long, and the untrusted
// pixels at the ends of the ramp.
constexpr int32_t kNearRadius = 16;
// Largest cost of a pixel that the views show clearly. kClearCost corresponds to 11 grey levels. In
// images of hair in front of a wall, half of the wall pixels and a twentieth of the mixed pixels
// have a cost below kClearCost.
constexpr int32_t kClearCost = 44;

// Smallest total evidence that a change of the map requires, in units of cost (simd::kCostScale per
// grey level). In a wrong map, a change requires a total of 240, which corresponds to eight pixels
// that fit 7.5 grey levels worse. In a map that is right except at details of low contrast, a
// change requires a total of 1600. If changes require a total of 1600, a pixel whose new disparity
// is on the surface of the given disparity is not changed.
constexpr int32_t kRightEvidence = 1600, kWrongEvidence = 240;

// Returns the mean of `count` values with the sum `sum`, with halves rounded away from zero.
int32_t MeanOf(int32_t sum, int32_t count) {
  return (2 * sum + (sum < 0 ? -count : count)) / (2 * count);
}

// Returns the mean disparity, around pixel (x, y), of the surface at disparity `own`. If trusted
// disparities of this surface exist, only trusted disparities are averaged.
int32_t MeanOfSurface(const SweepSetup& setup, const EstimateMemory& memory, int32_t x, int32_t y,
                      int32_t own) {
  const Rect around = Widened(setup, {x, y, 1, 1}, kMeanRadius);
  int32_t trusted_sum = 0, trusted = 0, sum = 0, count = 0;
  ForPixels(around, [&](int32_t column, int32_t row) {
    const size_t at = setup.At(column, row);
    if (std::abs(memory.second[at] - own) > kSameSurface) return;
    sum += memory.second[at];
    ++count;
    const int32_t d = memory.trusted[at];
    if (d == simd::kNoSurface || std::abs(d - own) > kSameSurface) return;
    trusted_sum += d;
    ++trusted;
  });
  return trusted > 0 ? MeanOf(trusted_sum, trusted) : MeanOf(sum, count);
}

// Returns true if less than a quarter of the pixels around pixel (x, y) are trusted. A rough part
// of the map is noise, or a wide slope in place of an edge, and is not worth keeping.
bool IsRough(const SweepSetup& setup, const EstimateMemory& memory, int32_t x, int32_t y) {
  const Rect around = Widened(setup, {x, y, 1, 1}, kMeanRadius);
  int32_t smooth = 0;
  ForPixels(around, [&](int32_t column, int32_t row) {
    smooth += memory.trusted[setup.At(column, row)] != simd::kNoSurface;
  });
  return 4 * smooth < around.width * around.height;
}

// Returns the disparity of pixel (x, y) according to both sweeps. If memory.second agrees with the
// given disparity, the result is the given disparity. Otherwise, the result is the mean of the
// surrounding trusted pixels that are on the surface of memory.second. If no trusted pixel is on
// this surface, the result is the mean of memory.second over the surface. Stray pixels are removed
// with the help of the colours of the centre view.
int16_t EvenedAt(const SweepSetup& setup, const Plane<const uint8_t>& centre,
                 const EstimateMemory& memory, int32_t x, int32_t y) {
  const size_t at = setup.At(x, y);
  const int16_t given = memory.given[at], trusted = memory.trusted[at];
  if (trusted != simd::kNoSurface && std::abs(trusted - memory.second[at]) <= kSame) return given;
  const int32_t own = WithoutStray(setup, centre, memory.second, x, y);
  const int32_t mean = MeanOfSurface(setup, memory, x, y, own);
  const bool same = given != simd::kNoSurface && std::abs(given - mean) <= kSame;
  return same ? given : static_cast<int16_t>(mean);
}

// Returns true if memory.first and the given map are on different surfaces at pixel `at`, or if the
// given disparity of this pixel is unknown.
bool Differs(const EstimateMemory& memory, size_t at) {
  return memory.given[at] == simd::kNoSurface ||
         std::abs(memory.first[at] - memory.given[at]) > kPixel / 2;
}

// Returns the repaired disparity of pixel (x, y), which is the disparity in memory.first or the
// given disparity. A contradicted pixel changes only if the total evidence of the contradicted
// pixels around the pixel is large enough. Single contradicted pixels are more often right in the
// given map than in memory.first. In rough parts of the map, contradicted pixels always change to
// memory.first.
int16_t RepairedAt(const SweepSetup& setup, const EstimateMemory& memory, int32_t least_evidence,
                   int32_t x, int32_t y) {
  const size_t own = setup.At(x, y);
  const int16_t given = memory.given[own], found = memory.first[own];
  if (given == simd::kNoSurface) return found;
  if (!Differs(memory, own)) {
    return least_evidence < kRightEvidence ? found : given;
  }
  if (IsRough(setup, memory, x, y)) return found;
  const Rect around = Widened(setup, {x, y, 1, 1}, kEvidenceRadius);
  int32_t evidence = 0;
  ForPixels(around, [&](int32_t column, int32_t row) {
    const size_t at = setup.At(column, row);
    if (Differs(memory, at)) evidence += memory.given_cost[at] - memory.found_cost[at];
  });
  return evidence >= least_evidence ? found : given;
}

// Fills `nearest` with the largest trusted disparity near each pixel of row y of a patch. The
// largest trusted disparity belongs to the surface from which hair stands out. If no trusted pixel
// is near, the value is kNoSurface.
void FindNearest(const SweepSetup& setup, const int16_t* trusted, const Rect& patch, int32_t y,
                 int16_t* nearest) {
  const Rect around = Widened(setup, {patch.x, y, patch.width, 1}, kNearRadius);
  // Largest disparity in each column; columns[0] is kNearRadius columns to the left of the patch.
  int16_t columns[kMostPatchSide + 2 * kNearRadius];
  std::fill_n(columns, patch.width + 2 * kNearRadius, simd::kNoSurface);
  int16_t* to = columns + kNearRadius - (patch.x - around.x);
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const int16_t* from = trusted + setup.At(around.x, row);
    for (int32_t x = 0; x < around.width; ++x) to[x] = std::max(to[x], from[x]);
  }
  std::fill_n(nearest, patch.width, simd::kNoSurface);
  for (int32_t k = 0; k <= 2 * kNearRadius; ++k) {
    for (int32_t x = 0; x < patch.width; ++x) nearest[x] = std::max(nearest[x], columns[x + k]);
  }
}

// Returns the disparity of pixel `at` in thin structure that the given map lacks. The result is the
// disparity of the nearer surface, unless the views clearly show a farther surface. Most pixels
// that the views do not show clearly mix the colours of two surfaces. A comparison of colours
// separates mixed pixels better than a search over disparities does.
int16_t PartedAt(const EstimateMemory& memory, size_t at, int16_t nearest) {
  const int16_t given = memory.given[at], found = memory.first[at];
  const bool sloping = memory.trusted[at] == simd::kNoSurface && nearest != simd::kNoSurface;
  const int16_t near = sloping ? nearest : given;
  if (near == simd::kNoSurface) return found;
  const bool clear = memory.found_cost[at] <= kClearCost &&
                     std::abs(found - memory.second[at]) < kPixel && found < near - kPixel;
  return clear ? found : near;
}

// Writes the results of EvenedAt to memory.first, whose previous content is no longer used, and
// counts the edge pixels of the tile and the pixels whose given disparity the repair contradicts.
void ValueTile(const SweepSetup& setup, const Plane<const uint8_t>& centre, int32_t index,
               const EstimateMemory& memory) {
  const Rect tile = TileOf(setup, index);
  TileCount count = {};
  ForSwept(setup, memory.swept, tile, [&](int32_t x, int32_t y) {
    const size_t at = setup.At(x, y);
    memory.first[at] = EvenedAt(setup, centre, memory, x, y);
    count.rough += memory.trusted[at] == simd::kNoSurface;
    count.differs += Differs(memory, at);
  });
  memory.counts[index] = count;
  CountBeside(memory.given_patches, memory.given, tile, index);
  CountBeside(memory.found_patches, memory.first, tile, index);
}

void WritePixel(const SweepSetup& setup, const EstimateMemory& memory, const MapOutput& output,
                int32_t x, int32_t y, int16_t disparity) {
  const size_t at = setup.At(x, y);
  if (disparity != memory.given[at]) output.Write(x, y, disparity);
  // The confidence of a pixel is 0 if the estimate from the views contradicts the map, but the
  // estimate is not used.
  if (disparity != memory.first[at] && Differs(memory, at)) output.WriteConfidence(x, y, 0);
}

// Writes the disparities of a patch with thin structure that the given map lacks.
void WriteParted(const SweepSetup& setup, const EstimateMemory& memory, const MapOutput& output,
                 const Rect& patch) {
  for (int32_t y = patch.y; y < patch.y + patch.height; ++y) {
    int16_t nearest[kMostPatchSide];
    FindNearest(setup, memory.trusted, patch, y, nearest);
    ForSwept(setup, memory.swept, {patch.x, y, patch.width, 1}, [&](int32_t x, int32_t) {
      const int16_t disparity = PartedAt(memory, setup.At(x, y), nearest[x - patch.x]);
      WritePixel(setup, memory, output, x, y, disparity);
    });
  }
}

void WritePatch(const SweepSetup& setup, const EstimateMemory& memory, const MapOutput& output,
                int32_t least_evidence, const Rect& patch, int32_t number) {
  const bool keeps = memory.given_patches.thin[number] != 0;
  if (!keeps && memory.found_patches.thin[number] != 0) {
    return WriteParted(setup, memory, output, patch);
  }
  ForSwept(setup, memory.swept, patch, [&](int32_t x, int32_t y) {
    const int16_t given = memory.given[setup.At(x, y)];
    const bool kept = keeps && given != simd::kNoSurface;
    WritePixel(setup, memory, output, x, y,
               kept ? given : RepairedAt(setup, memory, least_evidence, x, y));
  });
}

// Writes the given disparities of a tile, and then the disparities that the repair changes.
void WriteTile(const SweepSetup& setup, const starfocus_light_field& light_field, int32_t index,
               const EstimateMemory& memory, int32_t least_evidence, const MapOutput& output) {
  const Rect tile = TileOf(setup, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    std::copy_n(GivenAt(light_field, y) + tile.x, tile.width, output.disparity.Row(y) + tile.x);
    if (output.confidence.data == nullptr) continue;
    std::copy_n(memory.certainty + setup.At(tile.x, y), tile.width,
                output.confidence.Row(y) + tile.x);
  }
  ForPatches(memory.given_patches, index, [&](const Rect& patch, int32_t number) {
    WritePatch(setup, memory, output, least_evidence, patch, number);
  });
}

}  // namespace

int32_t LeastEvidence(const TileCount* counts, int32_t tiles, int32_t right, int32_t wrong) {
  // Up to kRightPercent, the map is assumed to be right; from kWrongPercent on, to be wrong.
  constexpr int32_t kRightPercent = 18, kWrongPercent = 22;
  int64_t rough = 1, differs = 0;
  for (int32_t tile = 0; tile < tiles; ++tile) {
    rough += counts[tile].rough;
    differs += counts[tile].differs;
  }
  const int64_t percent = 100 * differs / rough;
  if (percent <= kRightPercent) return right;
  if (percent >= kWrongPercent) return wrong;
  const auto beyond = static_cast<int32_t>(kWrongPercent - percent);
  return wrong + (right - wrong) * beyond / (kWrongPercent - kRightPercent);
}

starfocus_status Repair(const SweepSetup& setup, const starfocus_light_field& light_field,
                        const simd::DepthKernels& kernels, const MapOutput& output,
                        const EstimateMemory& memory) {
  const Sweep sweep = {setup, light_field, kernels, memory};
  const Plane<const uint8_t> centre = RowsOf(light_field.views[0]);
  const bool rates = output.confidence.data != nullptr;
  Sequence run(memory.jobs, 7, setup.columns * setup.rows);
  run.Run(
      [&](int32_t index, int32_t) { ReadGiven(setup, light_field, TileOf(setup, index), memory); });
  run.Run([&](int32_t index, int32_t) {
    FindTrusted(setup, TileOf(setup, index), memory.given, memory.trusted);
    FindDoubts(setup, light_field, TileOf(setup, index), memory);
  });
  run.Run([&](int32_t index, int32_t worker) {
    FindSwept(setup, TileOf(setup, index), memory.workers[worker].cost, memory);
  });
  run.Run([&](int32_t index, int32_t worker) {
    SweepTile(sweep, true, index, worker, memory.first, nullptr);
  });
  run.Run([&](int32_t index, int32_t worker) {
    SweepTile(sweep, false, index, worker, memory.second, rates ? memory.certainty : nullptr);
  });
  run.Run([&](int32_t index, int32_t) {
    ValueTile(setup, centre, index, memory);
    if (rates) RateUnswept(setup, centre, TileOf(setup, index), memory);
  });
  if (run.status() != STARFOCUS_OK) return run.status();
  FindThin(memory.given_patches, kThinGiven);
  FindThin(memory.found_patches, kThinFound);
  const int32_t least_evidence =
      LeastEvidence(memory.counts, setup.columns * setup.rows, kRightEvidence, kWrongEvidence);
  run.Run([&](int32_t index, int32_t) {
    WriteTile(setup, light_field, index, memory, least_evidence, output);
  });
  return run.status();
}

}  // namespace starfocus
