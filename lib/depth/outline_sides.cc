// SPDX-License-Identifier: Apache-2.0
// Decides on which side of an outline the pixels of its band lie, and finds their disparities from
// their sides. Clean pixels, which lie on no ramp and keep their side, keep their disparity. It
// spreads to the other pixels of their side from neighbour to neighbour, so that the disparities of
// a surface are continuous.
#include <algorithm>

#include "lib/depth/outlines.h"

namespace starfocus {
namespace {

// Largest absolute vote and side.
constexpr int32_t kSure = 127;

// A vote compares a pixel with every second pixel and row within band + kVoteRadius pixels; beyond
// kFineRadius pixels with every third, and beyond kCoarseRadius with every fourth. The weight of a
// sample is the product of its trust, its closeness and its similarity.
constexpr int32_t kFineRadius = 13, kCoarseRadius = 15;
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

// Radius, around a patch, of the windows whose votes displace an outline.
constexpr int32_t kShiftRadius = 4;
// Weight of no displacement against displacements, in units of gains and weights of patches.
constexpr int32_t kStill = 1;

// Writes the colours of a row of pixels, from sample `at` of the planes.
void FillColours(const uint8_t* rgb, int32_t count, int32_t at, const simd::DepthKernels& kernels,
                 VoteBlock* block) {
  uint8_t split[3][VoteBlock::kWidth];
  kernels.DeinterleaveRow(rgb, static_cast<size_t>(count), VoteBlock::kWidth, split[0]);
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
void FillBlock(const OutlinePass& pass, const Rect& area, int32_t reach, const Sample& sample,
               VoteBlock* block) {
  const Rect around = Widened(*pass.setup, area, reach);
  std::fill_n(block->trust, VoteBlock::kWidth * VoteBlock::kWidth, int16_t{0});
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const int32_t row = (y - area.y + kMostRadius) * VoteBlock::kWidth + kMostRadius - area.x;
    FillColours(pass.rgb.Row(y) + 3 * ptrdiff_t{around.x}, around.width, row + around.x,
                *pass.kernels, block);
    for (int32_t x = around.x; x < around.x + around.width; ++x) {
      const int32_t to = row + x;
      block->surface[to] = sample(pass.At(x, y), block->trust + to);
    }
  }
}

// Calls act(at, sums, lane, closeness) for each pixel of the band of a tile for which
// needs(x, y, at, lane) returns true, and which lies in lane `lane`. The function `needs` is called
// for the pixels of all lanes first. `closeness` is the total closeness of the samples. In wider
// bands, the second vote, whose samples are trusted more, compares fewer samples.
template <class Sample, class Needs, class Act>
void SumAround(const OutlinePass& pass, const Rect& tile, bool second, VoteBlock* block,
               const Sample& sample, const Needs& needs, const Act& act) {
  constexpr auto kLanes = static_cast<int32_t>(simd::kSliceLanes);
  int32_t reach = pass.band + kVoteRadius;
  int32_t step = reach > kCoarseRadius ? 4 : reach > kFineRadius ? 3 : 2;
  if (second && step > 2) ++step;
  reach -= reach % step;
  int16_t closeness[simd::kMostVoteSide * simd::kMostVoteSide];
  int32_t samples = 0, all = 0;
  for (int32_t y = -reach; y <= reach; y += step) {
    for (int32_t x = -reach; x <= reach; x += step) {
      const int32_t close = simd::kMostCloseness * kFallOff / (kFallOff + x * x + y * y);
      closeness[samples++] = static_cast<int16_t>(close * simd::kClosenessUnit);
      all += close;
    }
  }
  const auto visit = [&](const Rect& area) {
    if (!HasBand(pass, area)) return;
    FillBlock(pass, area, reach, sample, block);
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
        const int32_t own =
            (y - area.y + kMostRadius) * VoteBlock::kWidth + kMostRadius + x - area.x;
        const int16_t* const colours[] = {block->colour[0] + own, block->colour[1] + own,
                                          block->colour[2] + own};
        simd::VoteSums sums;
        pass.kernels->SumVotes(colours, block->surface + own, block->trust + own, middle,
                               VoteBlock::kWidth, reach, step, closeness, &sums);
        for (size_t k = 0; k < wants; ++k) act(pass.At(x, y) + wanted[k], sums, wanted[k], all);
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

// Displacement of the outline in a patch and the patches around it, in 1/kDistance pixel.
int32_t SmoothShift(const OutlineMemory& memory, int32_t column, int32_t row) {
  const int32_t columns = memory.Columns().Count(), rows = memory.Rows().Count();
  int32_t weights = kStill, shifts = 0;
  for (int32_t v = Max(row - 1, 0); v <= Min(row + 1, rows - 1); ++v) {
    for (int32_t u = Max(column - 1, 0); u <= Min(column + 1, columns - 1); ++u) {
      const int32_t patch = v * columns + u;
      const int32_t weight = memory.gain[patch] << ((u == column ? 1 : 0) + (v == row ? 1 : 0));
      weights += weight;
      shifts += weight * memory.shift[patch];
    }
  }
  return shifts / weights;
}

constexpr int32_t kPixel = 1 << kDisparityBits;
// Pixels that are farther than half of the ramp plus kBesideRamp from the outline are clean, in
// 1/kDistance pixel.
constexpr int32_t kBesideRamp = 2 * kDistance;
// Largest difference to a neighbour on a clean pixel of a soft and of a hard map (kDisparityBits).
constexpr int32_t kFlat = kPixel / 8, kRampStep = kPixel / 2;
constexpr int32_t kCrestRadius = 3;
// Round from which the crests of thin structures and the grounds of gaps are clean.
constexpr int32_t kFlatRounds = 12;

// States of pixels: the lowest bit is the side, and the others are the round in which the pixel got
// its disparity, or one of these.
constexpr uint8_t kNearer = 1, kRound = 2, kNone = 0x7e, kOutside = 0xfe;

// Returns true if pixel (x, y) of the band belongs to the nearer side according to pass.side of the
// pixel and its neighbours.
bool IsNearer(const OutlinePass& pass, int32_t x, int32_t y) {
  const size_t own = pass.At(x, y);
  const auto row = [&](int32_t by) {
    const int8_t* side = pass.side + pass.At(x, Clamp(y + by, 0, pass.setup->height - 1));
    return side[x > 0 ? -1 : 0] + 2 * side[0] + side[x + 1 < pass.setup->width ? 1 : 0];
  };
  const int32_t sum = pass.side[own] == 0 ? 0 : row(-1) + 2 * row(0) + row(1);
  return sum == 0 ? pass.map[own] > pass.middle[own] : sum > 0;
}

// Returns true if the disparities of the neighbours hardly differ from that of pixel (x, y).
bool IsFlat(const OutlinePass& pass, int32_t x, int32_t y) {
  const int32_t own = pass.map[pass.At(x, y)];
  bool flat = true;
  ForBeside(pass, x, y,
            [&](int32_t other, int32_t, int32_t) { flat = flat && Abs(other - own) <= kFlat; });
  return flat;
}

// Returns true if a neighbour on the same side is so much farther from the middle that pixel (x, y)
// of the band lies on a ramp: by more than `step`.
bool IsOnRamp(const OutlinePass& pass, int32_t x, int32_t y, int32_t step) {
  const size_t at = pass.At(x, y);
  const int32_t own = pass.map[at], sign = own > pass.middle[at] ? 1 : -1;
  bool found = false;
  ForBeside(pass, x, y,
            [&](int32_t other, int32_t, int32_t) { found |= sign * (other - own) > step; });
  return found;
}

// Returns the disparity of the crest of a thin structure, or of the ground of a gap: the extreme of
// the side of pixel (x, y) within kCrestRadius.
int16_t CrestOf(const OutlinePass& pass, int32_t x, int32_t y, bool near) {
  const size_t own = pass.At(x, y);
  const int32_t middle = pass.middle[own];
  int16_t extreme = pass.map[own];
  ForPixels(Widened(*pass.setup, {x, y, 1, 1}, kCrestRadius), [&](int32_t column, int32_t row) {
    const int16_t other = pass.map[pass.At(column, row)];
    if ((other > middle) != near) return;
    const bool takes = (extreme > middle) != near || (near ? other > extreme : other < extreme);
    if (takes) extreme = other;
  });
  return extreme;
}

// Bit of SidePlanes::ready for a round.
uint8_t Bit(int32_t round) { return static_cast<uint8_t>(1 << (round & 1)); }

// Writes the states of the rectangle, the disparities of clean pixels, and the list of the others.
// Returns their number. Clean pixels outside the band are found only beside it.
size_t FindClean(const OutlinePass& pass, SidePlanes* planes) {
  const Rect widened = planes->widened;
  const int32_t end = kDistance * pass.band - 2;
  const int32_t clean = pass.IsHard() ? 0 : Min(pass.ramp / 2 + kBesideRamp, end);
  std::fill_n(planes->state, planes->Stride() * (widened.height + 2), kOutside);
  size_t count = 0;
  ForBand(pass, widened, [&](int32_t x, int32_t y, size_t from) {
    const size_t to = planes->At(x, y);
    const int32_t distance = Abs(pass.distance[from]);
    const bool near = IsNearer(pass, x, y), was_near = pass.map[from] > pass.middle[from];
    const bool keeps = near == was_near && distance >= clean &&
                       (pass.IsHard() ? !IsOnRamp(pass, x, y, kRampStep) : IsFlat(pass, x, y));
    planes->disparity[to] = pass.map[from];
    planes->state[to] = static_cast<uint8_t>((keeps ? 0 : kNone) + (near ? kNearer : 0));
    if (!keeps && pass.side[from] != 0) {
      planes->ready[to] = Bit(1);
      planes->pending[count++] = static_cast<int32_t>(to);
    }
    if (distance < end - kDistance) return;
    ForPixels(Widened(*pass.setup, {x, y, 1, 1}, 1), [&](int32_t u, int32_t v) {
      if (pass.distance[pass.At(u, v)] != 0 || !Contains(widened, u, v)) return;
      if (!pass.IsHard() && !IsFlat(pass, u, v)) return;
      planes->disparity[planes->At(u, v)] = pass.map[pass.At(u, v)];
      planes->state[planes->At(u, v)] = 0;
    });
  });
  return count;
}

// Takes the mean disparity of the neighbours of the same side that have had theirs before `round`.
// Neighbours that are more than a pixel of disparity from the clearest one, such as a second near
// surface, are left out. Returns false if no neighbour has a disparity of this side.
bool AverageNeighbours(int32_t middle, int32_t at, int32_t round, SidePlanes* planes) {
  const int32_t end = round * kRound;
  const bool near = (planes->state[at] & kNearer) != 0;
  int32_t found[8], count = 0, extreme = near ? INT16_MIN : INT16_MAX;
  for (int32_t row = -1; row <= 1; ++row) {
    for (int32_t column = -1; column <= 1; ++column) {
      const int32_t other = at + row * planes->Stride() + column;
      if (planes->state[other] >= end) continue;
      const int32_t disparity = planes->disparity[other];
      if ((disparity > middle) != near) continue;
      found[count++] = disparity;
      extreme = near ? Max(extreme, disparity) : Min(extreme, disparity);
    }
  }
  if (count == 0) return false;
  int32_t sum = 0, number = 0;
  for (int32_t k = 0; k < count; ++k) {
    if (Abs(found[k] - extreme) > kPixel) continue;
    sum += found[k];
    ++number;
  }
  planes->disparity[at] =
      static_cast<int16_t>((2 * sum + (sum < 0 ? -number : number)) / (2 * number));
  return true;
}

// Lets pending pixels on the crests of thin structures, or on the ground of gaps, keep their
// disparity, and the others try again. Returns the number of pixels that remain.
size_t FindCrests(const OutlinePass& pass, size_t pending, int32_t round, SidePlanes* planes) {
  size_t left = 0;
  for (size_t k = 0; k < pending; ++k) {
    const int32_t at = planes->pending[k], x = planes->XOf(at), y = planes->YOf(at);
    const size_t from = pass.At(x, y);
    const bool near = (planes->state[at] & kNearer) != 0;
    planes->ready[at] = Bit(round);
    if ((pass.map[from] > pass.middle[from]) == near && !IsOnRamp(pass, x, y, 0)) {
      planes->state[at] = near ? kNearer : 0;
    } else {
      planes->pending[left++] = at;
    }
  }
  return left;
}

}  // namespace

void VoteByColour(const OutlinePass& pass, const Rect& tile, VoteBlock* block) {
  // Trust by the absolute value of the distance.
  const int32_t end = kDistance * pass.band, first = pass.trusted * end;
  int16_t trust[128] = {simd::kMostTrust};
  for (int32_t k = 1; k < 128; ++k) {
    const int32_t least = (k & 1) != 0 ? kRidgeTrust : 0;
    trust[k] = static_cast<int16_t>(
        Clamp(simd::kMostTrust * (10 * k - first) / (10 * end - first), least, simd::kMostTrust));
  }
  SumAround(
      pass, tile, false, block,
      [&](size_t at, int16_t* trusted) {
        *trusted = trust[Abs(pass.distance[at])];
        return pass.map[at];
      },
      [](int32_t, int32_t, size_t, size_t) { return true; },
      [&](size_t at, const simd::VoteSums& sums, size_t lane, int32_t closeness) {
        const int32_t weight = sums.weight[0][lane] + sums.weight[1][lane];
        const bool dense = 100 * weight < kLeastTrusted * closeness;
        pass.vote[at] = dense ? int8_t{0} : VoteOf(sums, lane, 1, 1);
      });
}

void ShiftOutlines(const OutlinePass& pass, const Rect& tile) {
  // bins[k] is the sum of the votes k - kZero pixels from the outline, rounded.
  constexpr int32_t kZero = kMostBand + 1, kBins = 2 * kZero + 1;
  ForShiftPatches(pass, tile, [&](int32_t number, const Rect& patch, bool begins) {
    if (!begins) return;
    pass.gain[number] = 0;
    if (!HasBand(pass, patch)) return;
    int32_t bins[kBins] = {}, count = 0, farther = 0;
    ForBand(pass, Widened(*pass.setup, patch, kShiftRadius), [&](int32_t, int32_t, size_t at) {
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

void VoteAgain(const OutlinePass& pass, const Rect& tile, VoteBlock* block) {
  const ShiftPatches columns = pass.Columns(), rows = pass.Rows();
  // The displacement of each column of patches of the tile, and the row of patches for which it
  // holds.
  int32_t shifts[kMostTileSide], shift_rows[kMostTileSide];
  std::fill_n(shift_rows, kMostTileSide, -1);
  const int32_t first_column = columns.Of(tile.x);
  int32_t priors[simd::kSliceLanes];  // negative for the farther side
  uint8_t trust[kSure + 1];
  for (int32_t k = 0; k <= kSure; ++k) {
    trust[k] = static_cast<uint8_t>(k * k * simd::kMostTrust / (kSure * kSure));
  }
  SumAround(
      pass, tile, true, block,
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
        const int32_t column = columns.Of(x), row = rows.Of(y), patch = column - first_column;
        if (shift_rows[patch] != row) shifts[patch] = SmoothShift(pass, column, row);
        shift_rows[patch] = row;
        const int32_t moved = pass.distance[at] + shifts[patch];
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
      [&](size_t at, const simd::VoteSums& sums, size_t lane, int32_t) {
        pass.side[at] = VoteOf(sums, lane, Max(-priors[lane], 1), Max(priors[lane], 1));
      });
}

void WriteResult(const OutlinePass& pass, const Rect& tile, SidePlanes* planes) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    std::copy_n(pass.map + pass.At(tile.x, y), tile.width, pass.result + pass.At(tile.x, y));
  }
  const int32_t rounds = 2 * pass.band + 2;
  planes->widened = Widened(*pass.setup, tile, rounds);
  size_t pending = FindClean(pass, planes);
  const auto write = [&](int32_t at, int32_t x, int32_t y) {
    if (Contains(tile, x, y)) pass.result[pass.At(x, y)] = planes->disparity[at];
  };
  for (int32_t round = 1; round <= rounds && pending > 0; ++round) {
    if (round == kFlatRounds) pending = FindCrests(pass, pending, round, planes);
    size_t left = 0;
    for (size_t k = 0; k < pending; ++k) {
      const int32_t at = planes->pending[k];
      planes->pending[left++] = at;
      if ((planes->ready[at] & Bit(round)) == 0) continue;
      planes->ready[at] &= static_cast<uint8_t>(~Bit(round));
      const int32_t x = planes->XOf(at), y = planes->YOf(at);
      if (!AverageNeighbours(pass.middle[pass.At(x, y)], at, round, planes)) continue;
      --left;
      write(at, x, y);
      planes->state[at] = static_cast<uint8_t>(round * kRound + (planes->state[at] & kNearer));
      for (int32_t row = -1; row <= 1; ++row) {
        uint8_t* ready = planes->ready + at + row * planes->Stride();
        for (int32_t column = -1; column <= 1; ++column) ready[column] |= Bit(round + 1);
      }
    }
    pending = left;
  }
  for (size_t k = 0; k < pending; ++k) {
    const int32_t at = planes->pending[k], x = planes->XOf(at), y = planes->YOf(at);
    planes->disparity[at] = CrestOf(pass, x, y, (planes->state[at] & kNearer) != 0);
    write(at, x, y);
  }
}

}  // namespace starfocus
