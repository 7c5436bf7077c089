// SPDX-License-Identifier: Apache-2.0
// Decides on which side of an outline the pixels of its band lie.
#include <algorithm>

#include "lib/depth/outlines.h"

namespace starfocus {
namespace {

// Largest absolute vote and side.
constexpr int32_t kSure = 127;

// A vote compares a pixel with every second pixel and row within band + kVoteReach pixels; beyond
// kFineReach pixels with every third, and beyond kCoarseReach with every fourth. The weight of a
// sample is the product of its trust, its closeness and its similarity.
constexpr int32_t kFineReach = 13, kCoarseReach = 15;
constexpr int32_t kRidgeTrust = 32;
// Squared distance in pixels at which the closeness is a half.
constexpr int32_t kFallOff = 100;
// Colours that no sample has are rather those of the nearer surface: those of the farther surface
// go on outside the band, but a rim or a thin part of the nearer surface may lie in the band alone.
// Mean similarities in 1/256.
constexpr int32_t kUnknownNear = 2, kUnknown = 4;
// Weight of all samples, in percent of fully trusted samples, below which the outlines are so dense
// that the map is kept.
constexpr int32_t kLeastTrusted = 10;
// The side of the displaced outline is 1 + kPrior * (distance - 1/4)^2 times as probable
// as the other one, at most kMostPrior times.
constexpr int32_t kPrior = 16, kMostPrior = 1000;

// A first vote for the side of the displaced outline is final if both together make that side
// kSurePrior times as probable as the other one.
constexpr int32_t kSurePrior = 64;

// Radius, around a cell, of the windows whose votes displace an outline.
constexpr int32_t kShiftRadius = 4;
// Weight of no displacement against displacements, in units of gains and weights of cells.
constexpr int32_t kStill = 1;

// Where the samples around a pixel are, and how much closeness they have.
struct Samples {
  int32_t reach, step, sum = 0;
  int16_t closeness[simd::kMostVoteSide * simd::kMostVoteSide];

  // In wider bands, the second vote, whose samples are trusted more, compares fewer samples.
  Samples(const OutlinePass& pass, bool second) : reach(pass.band + kVoteReach) {
    step = reach > kCoarseReach ? 4 : reach > kFineReach ? 3 : 2;
    if (second && step > 2) ++step;
    reach -= reach % step;
    int32_t k = 0;
    for (int32_t y = -reach; y <= reach; y += step) {
      for (int32_t x = -reach; x <= reach; x += step, ++k) {
        const int32_t close = simd::kMostCloseness * kFallOff / (kFallOff + x * x + y * y);
        closeness[k] = static_cast<int16_t>(close * simd::kClosenessUnit);
        sum += close;
      }
    }
  }
};

// Writes the colours of a row of pixels, from sample `at` of the planes.
void FillColours(const uint8_t* rgb, int32_t count, int32_t at, const simd::DepthKernels& kernels,
                 VoteBlock* block) {
  uint8_t split[3][VoteBlock::kWidth];
  kernels.SplitRow(rgb, static_cast<size_t>(count), VoteBlock::kWidth, split[0]);
  int16_t* const brightness = block->colour[0] + at;
  for (int32_t k = 0; k < count; ++k) {
    brightness[k] = static_cast<int16_t>((split[0][k] + 2 * split[1][k] + split[2][k]) >> 2);
  }
  // Hue distinguishes surfaces that shading makes alike, so its weight is larger.
  for (int32_t c = 0; c < 3; c += 2) {
    int16_t* const hue = block->colour[1 + c / 2] + at;
    for (int32_t k = 0; k < count; ++k) {
      hue[k] = static_cast<int16_t>(3 * (split[c][k] - split[1][k]) / 2);
    }
  }
}

// Writes the planes of the pixels around `area`, with the trust and the surface of
// sample(at, &trust), which returns the surface. Pixels outside the picture have no trust.
template <class Sample>
void FillBlock(const OutlinePass& pass, const Plane<const uint8_t>& rgb,
               const simd::DepthKernels& kernels, const Rect& area, int32_t reach,
               const Sample& sample, VoteBlock* block) {
  const Rect around = Widened(*pass.setup, area, reach);
  std::fill_n(block->trust, VoteBlock::kWidth * VoteBlock::kWidth, int16_t{0});
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const int32_t row = (y - area.y + kMostReach) * VoteBlock::kWidth + kMostReach - area.x;
    FillColours(rgb.Row(y) + 3 * ptrdiff_t{around.x}, around.width, row + around.x, kernels, block);
    for (int32_t x = around.x; x < around.x + around.width; ++x) {
      block->surface[row + x] = sample(pass.At(x, y), block->trust + row + x);
    }
  }
}

// Calls act(at, sums, lane) for each pixel of the band of a tile for which
// needs(x, y, at, lane) returns true, and which lies in lane `lane`. The function `needs` is called
// for the pixels of all lanes first.
template <class Sample, class Needs, class Act>
void SumAround(const OutlinePass& pass, const Plane<const uint8_t>& rgb,
               const simd::DepthKernels& kernels, const Rect& tile, const Samples& samples,
               VoteBlock* block, const Sample& sample, const Needs& needs, const Act& act) {
  constexpr auto kLanes = static_cast<int32_t>(simd::kSliceLanes);
  const auto visit = [&](const Rect& area) {
    if (!HasBand(pass, area)) return;
    FillBlock(pass, rgb, kernels, area, samples.reach, sample, block);
    for (int32_t y = area.y; y < area.y + area.height; ++y) {
      for (int32_t x = area.x; x < area.x + area.width; x += kLanes) {
        const int32_t count = Min(kLanes, area.x + area.width - x);
        const Rect row = {x, y, count, 1};
        if (!HasBand(pass, row)) continue;
        size_t wanted[kLanes], wants = 0;
        ForBand(pass, row, [&](int32_t column, int32_t, size_t at) {
          const auto lane = static_cast<size_t>(column - x);
          if (needs(column, y, at, lane)) wanted[wants++] = lane;
        });
        if (wants == 0) continue;
        int16_t middle[kLanes] = {};
        std::copy_n(pass.middle + pass.At(x, y), count, middle);
        const int32_t own = (y - area.y + kMostReach) * VoteBlock::kWidth + kMostReach + x - area.x;
        const int16_t* const colours[] = {block->colour[0] + own, block->colour[1] + own,
                                          block->colour[2] + own};
        simd::VoteSums sums;
        kernels.SumVotes(colours, block->surface + own, block->trust + own, middle, VoteBlock::kWidth,
                         samples.reach, samples.step, samples.closeness, &sums);
        for (size_t k = 0; k < wants; ++k) act(pass.At(x, y) + wanted[k], sums, wanted[k]);
      }
    }
  };
  for (int32_t y = tile.y; y < tile.y + tile.height; y += VoteBlock::kSide) {
    for (int32_t x = tile.x; x < tile.x + tile.width; x += VoteBlock::kSide) {
      visit({x, y, Min(VoteBlock::kSide, tile.x + tile.width - x),
             Min(VoteBlock::kSide, tile.y + tile.height - y)});
    }
  }
}

// Returns the vote that follows from the mean similarities of both sides and from how much more
// probable the nearer and farther side are, in [-kSure, kSure], and never 0.
int8_t VoteOf(const simd::VoteSums& sums, size_t lane, int32_t prior_far, int32_t prior_near) {
  // A side with few samples needs more similarity: an eighth of all weight counts for both sides.
  const int32_t far_weight = sums.weight[0][lane], near_weight = sums.weight[1][lane];
  const int32_t shared = (far_weight + near_weight) / 8 + 1;
  // Sums are at most 58320 in 1/16.
  const int64_t far = sums.similar[0][lane] * 4096LL / (far_weight + shared) + kUnknown;
  const int64_t near = sums.similar[1][lane] * 4096LL / (near_weight + shared) + kUnknown +
                       kUnknownNear * Min(far_weight, 64) / 64;
  const int64_t nearer = near * prior_near, farther = far * prior_far;
  const auto vote = static_cast<int32_t>(kSure * (nearer - farther) / (nearer + farther));
  return static_cast<int8_t>(vote == 0 ? 1 : vote);
}

// Displacement of the outline in a cell and the cells around it, in 1/kDistance pixel.
int32_t SmoothShift(const OutlineMemory& memory, int32_t column, int32_t row) {
  const int32_t columns = memory.Columns().Count(), rows = memory.Rows().Count();
  int32_t weights = kStill, shifts = 0;
  for (int32_t v = Max(row - 1, 0); v <= Min(row + 1, rows - 1); ++v) {
    for (int32_t u = Max(column - 1, 0); u <= Min(column + 1, columns - 1); ++u) {
      const int32_t cell = v * columns + u;
      const int32_t weight = memory.gain[cell] << ((u == column ? 1 : 0) + (v == row ? 1 : 0));
      weights += weight;
      shifts += weight * memory.shift[cell];
    }
  }
  return shifts / weights;
}

}  // namespace

void VoteByColour(const OutlinePass& pass, const Plane<const uint8_t>& rgb,
                  const simd::DepthKernels& kernels, const Rect& tile, VoteBlock* block) {
  // Trust by the absolute value of the distance.
  const int32_t end = kDistance * pass.band, first = pass.trusted * end;
  int16_t trust[128] = {simd::kMostTrust};
  for (int32_t k = 1; k < 128; ++k) {
    const int32_t least = (k & 1) != 0 ? kRidgeTrust : 0;
    trust[k] = static_cast<int16_t>(
        Clamp(simd::kMostTrust * (10 * k - first) / (10 * end - first), least, simd::kMostTrust));
  }
  const Samples samples(pass, false);
  SumAround(
      pass, rgb, kernels, tile, samples, block,
      [&](size_t at, int16_t* trusted) {
        *trusted = trust[Abs(pass.distance[at])];
        return pass.map[at];
      },
      [](int32_t, int32_t, size_t, size_t) { return true; },
      [&](size_t at, const simd::VoteSums& sums, size_t lane) {
        const int32_t weight = sums.weight[0][lane] + sums.weight[1][lane];
        const bool dense = 100 * weight < kLeastTrusted * samples.sum;
        pass.vote[at] = dense ? int8_t{0} : VoteOf(sums, lane, 1, 1);
      });
}

void ShiftOutlines(const OutlinePass& pass, const Rect& tile) {
  // bins[k] is the sum of the votes k - kZero pixels from the outline, rounded.
  constexpr int32_t kZero = kMostBand + 1, kBins = 2 * kZero + 1;
  ForShiftCells(pass, tile, [&](int32_t number, const Rect& cell, bool begins) {
    if (!begins) return;
    pass.gain[number] = 0;
    if (!HasBand(pass, cell)) return;
    int32_t bins[kBins] = {}, count = 0, farther = 0;
    ForBand(pass, Widened(*pass.setup, cell, kShiftRadius), [&](int32_t, int32_t, size_t at) {
      bins[kZero + ((pass.distance[at] + 2) >> 2)] += pass.vote[at];
      farther -= pass.vote[at];
      ++count;
    });
    // The agreement of an outline at k - kZero - 1/2: its nearer side begins with bin k.
    int32_t nearer = -farther, best = INT32_MIN, best_at = 0, unmoved = 0;
    for (int32_t k = 0; k < kBins; ++k) {
      const int32_t to = k - kZero - 1, agreement = 2 * nearer;
      if (to == 0) unmoved = agreement;
      if (Abs(to) <= pass.band &&
          (agreement > best || (agreement == best && Abs(to) < Abs(best_at)))) {
        best = agreement;
        best_at = to;
      }
      nearer -= bins[k];
    }
    const int32_t gain = best - unmoved;
    const bool clear = 256 * gain > pass.clear * kSure * count;
    pass.shift[number] = static_cast<int8_t>(clear ? -kDistance * best_at : 0);
    pass.gain[number] = static_cast<uint8_t>(clear ? Min(255, 255 * gain / (kSure * count)) : 0);
  });
}

void VoteAgain(const OutlinePass& pass, const Plane<const uint8_t>& rgb,
               const simd::DepthKernels& kernels, const Rect& tile, VoteBlock* block) {
  const Samples samples(pass, true);
  const ShiftCells columns = pass.Columns(), rows = pass.Rows();
  // The displacement of each column of cells of the tile, and the row of cells for which it holds.
  int32_t shifts[kMostTileSide], shift_rows[kMostTileSide];
  std::fill_n(shift_rows, kMostTileSide, -1);
  const int32_t first_column = columns.Of(tile.x);
  int32_t priors[simd::kSliceLanes];  // negative for the farther side
  uint8_t trust[kSure + 1];
  for (int32_t k = 0; k <= kSure; ++k) {
    trust[k] = static_cast<uint8_t>(k * k * simd::kMostTrust / (kSure * kSure));
  }
  SumAround(
      pass, rgb, kernels, tile, samples, block,
      [&](size_t at, int16_t* trusted) {
        *trusted = simd::kMostTrust;
        const int32_t distance = pass.distance[at], vote = pass.vote[at];
        if (distance == 0) return pass.map[at];
        *trusted = trust[Abs(vote)];
        // A pixel on the other side shows a surface as far beyond the middle.
        if ((vote > 0) == (distance > 0)) return pass.map[at];
        return static_cast<int16_t>(
            Clamp(2 * pass.middle[at] - pass.map[at], INT16_MIN, INT16_MAX));
      },
      [&](int32_t x, int32_t y, size_t at, size_t lane) {
        const int32_t vote = pass.vote[at];
        pass.side[at] = 0;
        if (vote == 0) return false;
        const int32_t column = columns.Of(x), row = rows.Of(y), cell = column - first_column;
        if (shift_rows[cell] != row) shifts[cell] = SmoothShift(pass, column, row);
        shift_rows[cell] = row;
        const int32_t moved = pass.distance[at] + shifts[cell];
        const bool near = moved > 0 || (moved == 0 && pass.distance[at] > 0);
        const int32_t beyond = Max(2 * Abs(moved) - kDistance / 2, 0);  // in 1/(2 kDistance) pixel
        const int32_t prior =
            Min(1 + kPrior * beyond * beyond / (4 * kDistance * kDistance), kMostPrior);
        priors[lane] = near ? prior : -prior;
        if ((vote > 0) != near ||
            prior * (kSure + Abs(vote)) < kSurePrior * (kSure + 1 - Abs(vote))) {
          return true;
        }
        pass.side[at] = near ? kSure : -kSure;
        return false;
      },
      [&](size_t at, const simd::VoteSums& sums, size_t lane) {
        pass.side[at] = VoteOf(sums, lane, Max(-priors[lane], 1), Max(priors[lane], 1));
      });
}

}  // namespace starfocus
