// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_repair.h"

#include <algorithm>
#include <cmath>

#include "lib/io/image.h"

namespace starfocus {
namespace {

// Number of phases, without the phases of FindHairCoverage.
constexpr int32_t kPhases = 7 + kOutlinePhases;

constexpr int16_t kUnknown = INT16_MIN;
// Largest standard deviation of noise that is invisible in a refocused picture, in fixed point
// (kDisparityBits).
constexpr int32_t kLeastNoise = 6;
// Number of differences that CountNoise counts apart. The last one stands for all larger ones.
constexpr int32_t kNoiseCounts = 1024;

// A ring buffer of kSmoothRows rows around the row that is being smoothed. Each row consists of the
// four planes that SmoothDisparity reads, kSmoothPlane samples apart.
constexpr int32_t kMostSmoothRadius = 4, kSmoothRows = 2 * kMostSmoothRadius + 1;
constexpr int32_t kSmoothPlane = kMostTileSide + 2 * kMostSmoothRadius;
constexpr int32_t kSmoothSamples = kSmoothRows * 4 * kSmoothPlane;
// Disparity of pixels outside the picture, which differs from all other disparities by more than
// any tolerance.
constexpr int32_t kOutside = INT32_MIN / 2;
constexpr uint8_t kBlack[3] = {};

// Converts a disparity to fixed point (kDisparityBits). Halves are rounded away from zero.
int16_t ToFixed(float disparity) {
  const float scaled = disparity * (1 << kDisparityBits);
  return static_cast<int16_t>(scaled < 0 ? scaled - 0.5F : scaled + 0.5F);
}

// Calls fill(k, before, after) for each unknown element k of a line, unless all are unknown. The
// elements `before` and `after` are the nearest known ones on both sides, or twice the nearer one.
template <class IsKnown, class Fill>
void FillNearest(int32_t length, const IsKnown& is_known, const Fill& fill) {
  int32_t last = -1;
  for (int32_t next = 0; next <= length; ++next) {
    if (next < length && !is_known(next)) continue;
    if (last < 0 && next == length) return;
    for (int32_t k = last + 1; k < next; ++k) {
      const int32_t before = last < 0 ? INT32_MAX : k - last;
      const int32_t after = next == length ? INT32_MAX : next - k;
      fill(k, before <= after ? last : next, after <= before ? next : last);
    }
    last = next;
  }
}

// A repair: its input, its output and its memory.
struct ColourRepair {
  const SweepSetup& setup;
  const starfocus_light_field& light_field;
  const simd::DepthKernels& kernels;
  const MapOutput& output;
  const ColourMemory& memory;
  const Plane<const uint8_t> rgb;

  starfocus_status Run(bool* has_coverage) const {
    const bool covers = output.coverage.data != nullptr;
    Sequence run(memory.jobs, kPhases + (covers ? kHairPhases : 0), setup.columns * setup.rows);
    const int32_t noise = ReadMap(&run);
    int16_t* const given = memory.outlines.given;
    *has_coverage = covers && FindHairCoverage(rgb, {given, static_cast<size_t>(setup.width), 0, 0},
                                               output.coverage, memory.hair, &run);
    // The first pass averages disparities within three standard deviations, which reduces the noise
    // to a third.
    Smooth(given, noise, 3, 1, 3 * noise, memory.outlines.repaired, &run);
    Smooth(memory.outlines.repaired, noise, 4, 2, 3 * noise / 2, given, &run);
    run.Run([&](int32_t index, int32_t) {
      CountBeside(memory.thin, given, TileOf(setup, index), index);
    });
    if (run.status() != STARFOCUS_OK) return run.status();
    FindThin(memory.thin, kThinGiven);
    const int16_t* repaired =
        FollowOutlines(light_field, kernels, memory.thin, *has_coverage ? &memory.hair : nullptr,
                       memory.outlines, &run);
    run.Run([&](int32_t index, int32_t) { WriteTile(repaired, TileOf(setup, index)); });
    if (*has_coverage) {
      run.Run([&](int32_t index, int32_t) { CompleteTile(TileOf(setup, index)); });
    } else {
      run.Skip();
    }
    return run.status();
  }

  // Converts the given map to fixed point (memory.outlines.given) and returns its noise.
  int32_t ReadMap(Sequence* run) const {
    const auto rows = [&](int32_t index) { return PartOf({0, setup.height}, index, run->count()); };
    run->Run([&](int32_t index, int32_t) {
      ReadRows(setup, light_field, rows(index), memory.outlines.given);
    });
    if (run->status() != STARFOCUS_OK) return 0;
    FillUnknownRows(setup, memory.outlines.given);
    const int32_t counts = memory.outlines.workers * kNoiseCounts;
    std::fill_n(memory.noise, counts, 0U);
    run->Run([&](int32_t index, int32_t worker) {
      CountNoise(rows(index), memory.noise + worker * kNoiseCounts);
    });
    for (int32_t k = kNoiseCounts; k < counts; ++k) {
      memory.noise[k % kNoiseCounts] += memory.noise[k];
    }
    return NoiseOf(memory.noise);
  }

  // Adds the pixels of `rows`, except the pixels at the edges of the picture, to the numbers of
  // pixels by the absolute difference between four times the pixel's disparity and the sum of the
  // disparities of its neighbours.
  void CountNoise(const Range& rows, uint32_t* counts) const {
    const ptrdiff_t width = setup.width;
    for (int32_t y = Max(rows.first, 1); y < Min(rows.last, setup.height - 1); ++y) {
      const int16_t* d = memory.outlines.given + setup.At(1, y);
      for (ptrdiff_t x = 1; x + 1 < width; ++x, ++d) {
        const int32_t others = *(d - 1) + *(d + 1) + *(d - width) + *(d + width);
        ++counts[Min(Abs(others - 4 * *d), kNoiseCounts - 1)];
      }
    }
  }

  // Returns the standard deviation of the map's noise in kDisparityBits from the numbers of
  // CountNoise, or 0 if the noise is invisible. The deviation is computed from the median
  // difference between a pixel and the mean of its neighbours. Edges do not affect the median.
  static int32_t NoiseOf(const uint32_t* counts) {
    size_t total = 0;
    for (int32_t k = 0; k < kNoiseCounts; ++k) total += counts[k];
    int32_t median = 0;
    for (size_t below = counts[0]; 2 * below < total; below += counts[median]) ++median;
    // For normally distributed noise, the median is 0.6745 * sqrt(20), or approximately 3, standard
    // deviations.
    const int32_t deviation = median / 3;
    return deviation > kLeastNoise ? deviation : 0;
  }

  // Smooths `from` into `to`, unless the map is not noisy. A pixel is averaged with every `step`-th
  // neighbour within `radius` pixels, at most kMostSmoothRadius, whose disparity differs by at most
  // `tolerance` (kDisparityBits). Neighbours of similar colour have the largest weights.
  void Smooth(const int16_t* from, int32_t noise, int32_t radius, int32_t step, int32_t tolerance,
              int16_t* to, Sequence* run) const {
    if (noise == 0) return run->Skip();
    run->Run([&](int32_t index, int32_t worker) {
      const Rect tile = TileOf(setup, index);
      int32_t* const ring = memory.rings + ptrdiff_t{worker} * kSmoothSamples;
      const auto row_at = [ring](int32_t y) { return ring + y % kSmoothRows * 4 * kSmoothPlane; };
      int32_t filled = Max(tile.y - radius, 0);
      for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
        for (; filled <= y + radius && filled < setup.height; ++filled) {
          FillPlanes(from, tile.x - radius, tile.width + 2 * radius, filled, row_at(filled));
        }
        const int32_t* rows[simd::kMostSmoothRows];
        size_t count = 0;
        for (int32_t row = y - radius; row <= y + radius; row += step) {
          if (row >= 0 && row < setup.height) rows[count++] = row_at(row) + radius;
        }
        kernels.SmoothDisparity(row_at(y) + radius, rows, count, kSmoothPlane, radius, step,
                                tolerance, static_cast<size_t>(tile.width),
                                to + setup.At(tile.x, y));
      }
    });
  }

  // Fills columns [first, first + count) of the planes of row y. Columns may lie outside the
  // picture.
  void FillPlanes(const int16_t* map, int32_t first, int32_t count, int32_t y, int32_t* row) const {
    for (int32_t k = 0; k < count; ++k) {
      const int32_t x = first + k;
      const bool inside = x >= 0 && x < setup.width;
      const uint8_t* colour = inside ? rgb.Row(y) + 3 * ptrdiff_t{x} : kBlack;
      row[k] = inside ? map[setup.At(x, y)] : kOutside;
      row[k + kSmoothPlane] = colour[0] + colour[1] + colour[2];
      row[k + 2 * kSmoothPlane] = colour[0] - colour[1];
      row[k + 3 * kSmoothPlane] = colour[1] - colour[2];
    }
  }

  // Writes the repaired map of a tile. A disparity that is as in the given map is copied exactly.
  void WriteTile(const int16_t* repaired, const Rect& tile) const {
    ForPixels(tile, [&](int32_t x, int32_t y) {
      const size_t at = setup.At(x, y);
      const float given = GivenAt(light_field, y)[x];
      const int32_t vote = Abs(memory.outlines.vote[at]);
      const int32_t confidence = memory.outlines.distance[at] != 0 ? 2 * vote : UINT8_MAX;
      output.WriteConfidence(x, y, static_cast<uint8_t>(confidence));
      if (std::isfinite(given) && repaired[at] == ToFixed(given)) {
        output.disparity.Row(y)[x] = given;
      } else {
        output.Write(x, y, repaired[at]);
      }
    });
  }

  // Completes the coverage of a tile, whose disparities have been written to the output.
  void CompleteTile(const Rect& tile) const {
    int16_t disparity[kMostTileSide];
    for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
      for (int32_t k = 0; k < tile.width; ++k) {
        disparity[k] = ToFixed(output.disparity.Row(y)[tile.x + k]);
      }
      uint8_t* const confidence =
          output.confidence.data == nullptr ? nullptr : output.confidence.Row(y) + tile.x;
      CompleteCoverage(memory.hair, {tile.x, tile.x + tile.width}, y, disparity,
                       output.coverage.Row(y) + tile.x, confidence);
    }
  }
};

}  // namespace

ColourMemory TakeColourRepair(const SweepSetup& setup, int32_t max_workers, Arena* arena) {
  const auto workers = static_cast<size_t>(max_workers);
  ColourMemory memory = {};
  memory.jobs = TakeJobs(setup, max_workers, arena);
  memory.hair = TakeHairMemory(setup.width, setup.height, arena);
  memory.thin = TakeThinPatches(setup, arena);
  memory.outlines = TakeOutlines(setup, max_workers, arena);
  memory.rings = arena->Take<int32_t>(kSmoothSamples, workers);
  memory.noise = arena->Take<uint32_t>(kNoiseCounts, workers);
  return memory;
}

void ReadRows(const SweepSetup& setup, const starfocus_light_field& light_field, const Range& rows,
              int16_t* disparity) {
  for (int32_t y = rows.first; y < rows.last; ++y) {
    int16_t* row = disparity + setup.At(0, y);
    const float* given = GivenAt(light_field, y);
    bool complete = true;
    for (int32_t x = 0; x < setup.width; ++x) {
      const bool known = std::isfinite(given[x]);
      row[x] = known ? ToFixed(given[x]) : kUnknown;
      complete &= known;
    }
    if (complete) continue;
    FillNearest(
        setup.width, [&](int32_t x) { return row[x] != kUnknown; },
        [&](int32_t x, int32_t a, int32_t b) { row[x] = std::min(row[a], row[b]); });
  }
}

void FillUnknownRows(const SweepSetup& setup, int16_t* disparity) {
  FillNearest(
      setup.height, [&](int32_t y) { return disparity[setup.At(0, y)] != kUnknown; },
      [&](int32_t y, int32_t a, int32_t b) {
        const int16_t *above = disparity + setup.At(0, a), *below = disparity + setup.At(0, b);
        std::transform(above, above + setup.width, below, disparity + setup.At(0, y),
                       [](int16_t left, int16_t right) { return std::min(left, right); });
      });
}

starfocus_status RepairByColour(const SweepSetup& setup, const starfocus_light_field& light_field,
                                const simd::DepthKernels& kernels, const MapOutput& output,
                                const ColourMemory& memory, bool* has_coverage) {
  const Plane<const uint8_t> rgb = RowsOf(light_field.views[0]);
  return ColourRepair{setup, light_field, kernels, output, memory, rgb}.Run(has_coverage);
}

}  // namespace starfocus
