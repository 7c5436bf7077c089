// SPDX-License-Identifier: Apache-2.0
#include "lib/video/motion.h"

#include <algorithm>

#include "simd/kernels.h"

namespace starfocus {
namespace {

// Rows of a job.
constexpr int32_t kBand = 32;

// A motion replaces the first candidate, which is that of the coarse block, if its sum of
// differences is smaller by more than this. Flat blocks therefore keep the motion of the coarse
// block.
constexpr int32_t kMotionPenalty = 128;

// Largest motion at the coarsest level, pixels of this level.
constexpr int32_t kTopSearch = 4;

void HalveLuma(const LumaLevel& fine, const LumaLevel& coarse, const Range& rows) {
  for (int32_t y = rows.first; y < rows.last; ++y) {
    const uint8_t* const upper = fine.luma.Row(2 * y);
    const uint8_t* const lower = fine.luma.Row(2 * y + 1);
    uint8_t* const to = coarse.luma.Row(y);
    for (int32_t x = 0; x < coarse.width; ++x) {
      const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
      to[x] = static_cast<uint8_t>((sum + 2) >> 2);
    }
  }
}

// Compares a block of a level with blocks of the frame before.
struct Matcher {
  const simd::VideoKernels& kernels;
  const LumaLevel &before, &now;
  int32_t x, y;  // place of the compared square around the block

  // Returns the sum of absolute differences for a motion, or a large number if the motion leaves
  // the picture.
  int64_t Difference(const Motion& motion) const {
    constexpr auto kSide = static_cast<int32_t>(simd::kCompared);
    const int32_t from_x = x + motion.across, from_y = y + motion.down;
    if (from_x < 0 || from_y < 0 || from_x + kSide > now.width || from_y + kSide > now.height) {
      return INT32_MAX;
    }
    return kernels.CompareSquares(now.luma.Row(y) + x, before.luma.Row(from_y) + from_x,
                                  now.luma.stride);
  }
};

// Returns the best motion of `count` candidates and of all motions within `search` pixels of the
// best candidate.
Motion BestMotion(const Matcher& matcher, const Motion* candidates, int32_t count, int32_t search) {
  Motion best = candidates[0];
  int64_t least = matcher.Difference(best) - kMotionPenalty;
  const auto test = [&](const Motion& motion) {
    const int64_t found = matcher.Difference(motion);
    if (found >= least) return;
    least = found;
    best = motion;
  };
  for (int32_t k = 1; k < count; ++k) {
    if (std::find(candidates, candidates + k, candidates[k]) == candidates + k) test(candidates[k]);
  }
  const Motion middle = best;
  ForPixels(Around(middle.across, middle.down, search), [&](int32_t across, int32_t down) {
    const Motion motion = {static_cast<int16_t>(across), static_cast<int16_t>(down)};
    if (!(motion == middle)) test(motion);
  });
  return best;
}

// Adds twice the motions of a block of the coarse level and of its neighbours that are nearest to
// block (column, row) of the fine level.
int32_t AddCoarse(const MotionField& coarse, int32_t column, int32_t row, Motion* candidates) {
  for (int32_t k = 0; k < 4; ++k) {
    const int32_t x = column / 2 + (k % 2 == 0 ? 0 : column % 2 != 0 ? 1 : -1);
    const int32_t y = row / 2 + (k / 2 == 0 ? 0 : row % 2 != 0 ? 1 : -1);
    const Motion& of = coarse.At(Clamp(x, 0, coarse.columns - 1), Clamp(y, 0, coarse.rows - 1));
    candidates[k] = {static_cast<int16_t>(2 * of.across), static_cast<int16_t>(2 * of.down)};
  }
  return 4;
}

}  // namespace

LumaPyramid TakePyramid(int32_t width, int32_t height, Arena* arena) {
  LumaPyramid pyramid = {};
  for (int32_t w = width, h = height; pyramid.levels < kMotionLevels; w /= 2, h /= 2) {
    if (pyramid.levels > 0 && Min(w, h) < 3 * kMotionBlock) break;
    LumaLevel& level = pyramid.level[pyramid.levels++];
    const auto columns = static_cast<size_t>(w);
    level = {w, h, {arena->Take<uint8_t>(columns, static_cast<size_t>(h)), columns}};
  }
  return pyramid;
}

void TakeMotion(const LumaPyramid& pyramid, Arena* arena, MotionField fields[kMotionLevels]) {
  for (int32_t k = 0; k < pyramid.levels; ++k) {
    const LumaLevel& level = pyramid.level[k];
    const int32_t columns = MotionBlocks(level.width), rows = MotionBlocks(level.height);
    fields[k] = {columns, rows,
                 arena->Take<Motion>(static_cast<size_t>(columns), static_cast<size_t>(rows))};
  }
}

starfocus_status FillPyramid(const Plane<const uint8_t>& rgb, const LumaPyramid& pyramid,
                             Jobs* jobs) {
  const LumaLevel& full = pyramid.level[0];
  const auto for_bands = [&](int32_t height, const auto& work) {
    return ForEach((height + kBand - 1) / kBand, jobs, [&](int32_t index, int32_t) {
      work(Range{index * kBand, Min(height, (index + 1) * kBand)});
    });
  };
  starfocus_status status = for_bands(full.height, [&](const Range& rows) {
    for (int32_t y = rows.first; y < rows.last; ++y) {
      const uint8_t* const from = rgb.Row(y);
      uint8_t* const to = full.luma.Row(y);
      for (int32_t x = 0; x < full.width; ++x) {
        to[x] =
            static_cast<uint8_t>((from[3 * x] + 2 * from[3 * x + 1] + from[3 * x + 2] + 2) >> 2);
      }
    }
  });
  for (int32_t k = 1; k < pyramid.levels && status == STARFOCUS_OK; ++k) {
    status = for_bands(pyramid.level[k].height, [&](const Range& rows) {
      HalveLuma(pyramid.level[k - 1], pyramid.level[k], rows);
    });
  }
  return status;
}

starfocus_status FindMotion(const simd::VideoKernels& kernels, const LumaPyramid& before,
                            const LumaPyramid& now, const MotionField fields[kMotionLevels],
                            Jobs* jobs) {
  starfocus_status status = STARFOCUS_OK;
  for (int32_t k = now.levels - 1; k >= 0 && status == STARFOCUS_OK; --k) {
    const LumaLevel& level = now.level[k];
    const MotionField& field = fields[k];
    const bool is_top = k + 1 == now.levels;
    status = ForEach(field.rows, jobs, [&](int32_t row, int32_t) {
      for (int32_t column = 0; column < field.columns; ++column) {
        constexpr auto kSide = static_cast<int32_t>(simd::kCompared);
        constexpr int32_t kAround = (kSide - kMotionBlock) / 2;
        Motion& found = field.At(column, row);
        found = {0, 0};
        if (Min(level.width, level.height) < kSide) continue;
        const Matcher matcher = {kernels, before.level[k], level,
                                 Clamp(column * kMotionBlock - kAround, 0, level.width - kSide),
                                 Clamp(row * kMotionBlock - kAround, 0, level.height - kSide)};
        Motion candidates[5] = {};  // the last is no motion
        const int32_t count = is_top ? 0 : AddCoarse(fields[k + 1], column, row, candidates);
        found = BestMotion(matcher, candidates, count + 1, is_top ? kTopSearch : 1);
      }
    });
  }
  return status;
}

}  // namespace starfocus
