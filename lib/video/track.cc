// SPDX-License-Identifier: Apache-2.0
#include "lib/video/track.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace starfocus {
namespace {

constexpr auto kSide = static_cast<int32_t>(simd::kCompared);
static_assert(sizeof(starfocus_track::patch) == simd::kCompared * simd::kCompared);

// Blocks around the point whose motions count, and pixels around it whose disparities count.
constexpr int32_t kBlocksAround = 3, kPixelsAround = 8;
// The patch is searched this far around the place to which the motion leads, and around the last
// place while the subject is lost.
constexpr int32_t kSearch = 3, kSearchLost = 12;
// Largest difference of the patch: 24 codes on average. A lost subject is found again up to half of
// it.
constexpr int64_t kMostDifference = 24 * kSide * kSide;

const StableFrame& Now(const Stabiliser& s) { return s.frames[s.current]; }

// Returns the square of the luma around a point, inside the picture.
const uint8_t* SquareAt(const Stabiliser& s, int32_t x, int32_t y) {
  const LumaLevel& level = Now(s).luma.level[0];
  return level.luma.Row(Clamp(y - kSide / 2, 0, level.height - kSide)) +
         Clamp(x - kSide / 2, 0, level.width - kSide);
}

// Copies a square to consecutive rows.
void CopySquare(const uint8_t* from, size_t stride, uint8_t* square) {
  for (int32_t y = 0; y < kSide; ++y) {
    std::memcpy(square + ptrdiff_t{y} * kSide, from + static_cast<size_t>(y) * stride, kSide);
  }
}

int64_t DifferenceAt(const Stabiliser& s, const starfocus_track& track, int32_t x, int32_t y) {
  uint8_t square[sizeof track.patch];
  CopySquare(SquareAt(s, x, y), Now(s).luma.level[0].luma.stride, square);
  return s.kernels->CompareSquares(square, track.patch, kSide);
}

// Returns the median motion of the blocks around the point, of those on its surface.
Motion MotionAround(const Stabiliser& s, const starfocus_track& track) {
  constexpr int32_t kMost = (2 * kBlocksAround + 1) * (2 * kBlocksAround + 1);
  const MotionField& field = s.motion[0];
  const StableFrame& before = s.frames[1 - s.current];
  const auto focus = static_cast<int32_t>(track.focus * (1 << kDisparityBits));
  const int32_t tolerance = s.tolerance;
  int16_t across[kMost], down[kMost];
  int32_t count = 0;
  const Rect blocks = Clipped(Around(track.x / kMotionBlock, track.y / kMotionBlock, kBlocksAround),
                              field.columns, field.rows);
  ForPixels(blocks, [&](int32_t column, int32_t row) {
    const Motion& motion = field.At(column, row);
    const int32_t x = column * kMotionBlock + kMotionBlock / 2 + motion.across;
    const int32_t y = row * kMotionBlock + kMotionBlock / 2 + motion.down;
    if (!Contains({0, 0, s.config.width, s.config.height}, x, y)) return;
    if (std::abs(before.disparity.Row(y)[x] - focus) > tolerance) return;
    across[count] = motion.across;
    down[count++] = motion.down;
  });
  if (count == 0) return {0, 0};
  std::sort(across, across + count);
  std::sort(down, down + count);
  return {across[count / 2], down[count / 2]};
}

// Returns the place within `search` of (x, y) that looks most like the patch.
Motion BestPlace(const Stabiliser& s, const starfocus_track& track, int32_t x, int32_t y,
                 int32_t search, int64_t* least) {
  Motion best = {0, 0};
  *least = DifferenceAt(s, track, x, y);
  const Rect inside = Clipped(Around(x, y, search), s.config.width, s.config.height);
  ForPixels(inside, [&](int32_t at_x, int32_t at_y) {
    // Nearer places are better, if they look alike.
    const int64_t far = 8 * (std::abs(at_x - x) + std::abs(at_y - y));
    const int64_t found = DifferenceAt(s, track, at_x, at_y) + far;
    if (found >= *least) return;
    *least = found;
    best = {static_cast<int16_t>(at_x - x), static_cast<int16_t>(at_y - y)};
  });
  return best;
}

// Sets *focus to the median of the known disparities around a point that are within `tolerance` of
// it. Returns their number.
int32_t FindFocus(const Stabiliser& s, int32_t x, int32_t y, int32_t tolerance, double* focus) {
  int16_t values[(2 * kPixelsAround + 1) * (2 * kPixelsAround + 1)];
  int32_t count = 0;
  const auto own = static_cast<int32_t>(*focus * (1 << kDisparityBits));
  ForPixels(Clipped(Around(x, y, kPixelsAround), s.config.width, s.config.height),
            [&](int32_t at_x, int32_t at_y) {
              const int16_t d = Now(s).disparity.Row(at_y)[at_x];
              const bool is_known = Now(s).count.Row(at_y)[at_x] > 0;
              if (is_known && std::abs(d - own) <= tolerance) values[count++] = d;
            });
  if (count == 0) return 0;
  std::nth_element(values, values + count / 2, values + count);
  *focus = static_cast<double>(values[count / 2]) / (1 << kDisparityBits);
  return count;
}

}  // namespace

void BeginTrack(const Stabiliser& s, int32_t x, int32_t y, starfocus_track* track) {
  track->x = x;
  track->y = y;
  track->lost = 0;
  track->focus = static_cast<double>(Now(s).disparity.Row(y)[x]) / (1 << kDisparityBits);
  const bool is_known = Now(s).count.Row(y)[x] > 0;
  FindFocus(s, x, y, is_known ? s.tolerance : INT16_MAX - INT16_MIN, &track->focus);
  CopySquare(SquareAt(s, x, y), Now(s).luma.level[0].luma.stride, track->patch);
}

void FollowTrack(const Stabiliser& s, starfocus_track* track) {
  const bool was_lost = track->lost > 0;
  const Motion motion = was_lost || s.length < 2 ? Motion{0, 0} : MotionAround(s, *track);
  const int32_t x = track->x - motion.across, y = track->y - motion.down;
  if (!Contains({0, 0, s.config.width, s.config.height}, x, y)) {
    ++track->lost;
    return;
  }
  int64_t difference = 0;
  const Motion place = BestPlace(s, *track, x, y, was_lost ? kSearchLost : kSearch, &difference);
  const int32_t found_x = x + place.across, found_y = y + place.down;
  double focus = track->focus;
  // A subject that comes nearer changes its disparity by less than the tolerance.
  const int32_t alike = FindFocus(s, found_x, found_y, s.tolerance, &focus);
  constexpr int32_t kFewest = (2 * kPixelsAround + 1) * (2 * kPixelsAround + 1) / 8;
  if (alike < kFewest || difference > (was_lost ? kMostDifference / 2 : kMostDifference)) {
    ++track->lost;
    return;
  }
  track->lost = 0;
  track->x = found_x;
  track->y = found_y;
  track->focus = focus;
  // The patch follows the subject slowly, as it turns.
  uint8_t square[sizeof track->patch];
  CopySquare(SquareAt(s, found_x, found_y), Now(s).luma.level[0].luma.stride, square);
  for (size_t n = 0; n < sizeof square; ++n) {
    track->patch[n] = static_cast<uint8_t>((7 * track->patch[n] + square[n] + 4) >> 3);
  }
}

}  // namespace starfocus
