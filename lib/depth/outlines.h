// SPDX-License-Identifier: Apache-2.0
// Moves the outlines of a disparity map of a single view to the outlines of the picture. Maps from
// networks, stereo and sensors have outlines that are soft, of low resolution, or off by a few
// pixels.
//
// An outline is where the map crosses the mean of two surfaces that meet (`middle`). The pixels of
// a band around the outline have a signed distance to it, which is positive on the nearer side, and
// get votes: whether trusted pixels of similar colour around them are nearer or farther than the
// middle. The outline is displaced where the votes of a whole window agree, and snaps to the edges
// of the picture as far as colours explain the votes. Pixels that change their side, and pixels on
// ramps, take the disparity of the nearest clean pixels of their side. In hard maps, whose outlines
// are steps between neighbours, a second pass with a narrow band corrects what remains.
#ifndef STARFOCUS_LIB_DEPTH_OUTLINES_H_
#define STARFOCUS_LIB_DEPTH_OUTLINES_H_

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "lib/base/arena.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/depth/setup.h"
#include "lib/depth/thin_patches.h"
#include "lib/matting/hair_coverage.h"
#include "simd/kernels.h"

namespace starfocus {

// Units of distances to an outline per pixel. Distances are even; a set lowest bit marks a ridge,
// which is a pixel without same-sided neighbours that are farther from the outline. The middle of a
// thin structure is a ridge, and is trusted more than other pixels at its distance.
inline constexpr int32_t kDistance = 4;
// Largest width of the band on each side, and largest radius of the windows in which outlines are
// found, in pixels.
inline constexpr int32_t kMostBand = 10, kMostOutlineRadius = 12;
// Votes compare pixels up to kVoteRadius pixels beyond the width of the band.
inline constexpr int32_t kVoteRadius = 7, kMostRadius = kMostBand + kVoteRadius;
// Disparities of a tile follow from the pixels up to kSideRadius pixels around it.
inline constexpr int32_t kSideRadius = 2 * kMostBand + 4;
inline constexpr size_t kMostWidened = kMostTileSide + 2 * kSideRadius;
// Widths of ramps that are counted apart, in 1/kDistance pixel. The last one includes all wider.
inline constexpr int32_t kRampCounts = kDistance * 25;

// The patches along a row or column in which displacements are measured. Patches of kSide pixels
// begin at both borders, and a patch of 1 to 2 kSide pixels is left in the middle, so that mirrored
// pictures have mirrored patches.
struct ShiftPatches {
  static constexpr int32_t kSide = 4;
  int32_t length;  // in pixels

  int32_t Half() const { return (length - 1) / (2 * kSide); }
  int32_t Count() const { return 2 * Half() + 1; }
  // Returns the patch of a pixel.
  int32_t Of(int32_t pixel) const {
    const int32_t after = length - 1 - pixel;
    if (pixel < kSide * Half()) return pixel / kSide;
    return after < kSide * Half() ? Count() - 1 - after / kSide : Half();
  }
  // Returns the first pixel of a patch, or `length` for patch Count().
  int32_t Begin(int32_t patch) const {
    return patch <= Half() ? kSide * patch : length - kSide * (Count() - patch);
  }
};

// Counts of a worker.
struct OutlineCounts {
  uint32_t ramps[kRampCounts];
  uint32_t beside, changes;  // Pixels next to outlines, and those of them that change their side.
  bool wrong;                // true if a part of the map is wrong
};

// Pixels of a block and the pixels around it, in planes, for simd::SumVotes.
struct VoteBlock {
  static constexpr int32_t kSide = 128, kWidth = kSide + 2 * kMostRadius;

  int16_t colour[3][kWidth * kWidth], surface[kWidth * kWidth], trust[kWidth * kWidth];
};

// Planes of a rectangle of at most kMostWidened^2 pixels and a border of one pixel, for
// WriteResult, and the pixels that have no disparity yet.
struct SidePlanes {
  static constexpr size_t kSamples = (kMostWidened + 2) * (kMostWidened + 2);

  Rect widened;
  int16_t disparity[kSamples];
  uint8_t state[kSamples];
  uint8_t ready[kSamples];  // a bit for odd and one for even rounds
  int32_t pending[kSamples];

  int32_t Stride() const { return widened.width + 2; }
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>((y - widened.y + 1) * Stride() + x - widened.x + 1);
  }
  int32_t XOf(int32_t at) const { return at % Stride() + widened.x - 1; }
  int32_t YOf(int32_t at) const { return at / Stride() + widened.y - 1; }
};

// Memory of a worker. Each phase uses one of its members.
union OutlineScratch {
  struct {
    int32_t outlines[kMostWidened * kMostWidened];
    // Lowest and highest disparities of windows.
    int16_t low[(kMostWidened + 2 * kMostOutlineRadius) * kMostWidened];
    int16_t high[(kMostWidened + 2 * kMostOutlineRadius) * kMostWidened];
  } distances;
  VoteBlock block;
  SidePlanes sides;
};

// Planes of the size of the picture, with contiguous rows, and memory of the workers.
struct OutlineMemory {
  const SweepSetup* setup;
  int32_t workers;
  int16_t* given;      // the map (kDisparityBits)
  int16_t* repaired;   // the map after the first pass
  int16_t* middle;     // in the band: mean of the two surfaces (kDisparityBits)
  int8_t* distance;    // signed distance to the outline, in 1/kDistance pixel; 0 outside the band
  int8_t* vote;        // -127 (surely farther) to 127 (surely nearer); 0 without samples
  int8_t* side;        // the same, by the second vote; 0 where the map is kept, and outside
  int8_t* shift;       // by how much the outline approaches this patch, in 1/kDistance pixel
  uint8_t* gain;       // agreement of the votes that the shift gains, in 1/255
  uint8_t* beside;     // pixels of this patch next to an outline
  uint8_t* displaced;  // those of them that change their side as the shift demands
  uint8_t* is_right;   // 1 if the map around this patch is right
  OutlineCounts* counts;    // one for each worker
  OutlineScratch* scratch;  // one for each worker

  ShiftPatches Columns() const { return {setup->width}; }
  ShiftPatches Rows() const { return {setup->height}; }
  size_t At(int32_t x, int32_t y) const { return setup->At(x, y); }
};

// A pass of the search for outlines, which reads the picture and `map`, and writes `result`.
struct OutlinePass : OutlineMemory {
  Plane<const uint8_t> rgb;
  const simd::DepthKernels* kernels;
  const int16_t* map;
  int16_t* result;
  int32_t ramp;     // width of the map's edges, in 1/kDistance pixel
  int32_t radius;   // radius of the windows in which outlines are found
  int32_t band;     // width of the band on each side, in pixels
  int32_t trusted;  // trust grows from 0 at trusted/10 of the width of the band to 1 at its end
  int32_t clear;    // displacements need a gain of more than clear/256

  // Returns true if the map's edges are steps between neighbours.
  bool IsHard() const { return ramp < 2 * kDistance; }
};

// `setup` must outlive the memory; only its size and its tiles are read.
OutlineMemory TakeOutlines(const SweepSetup& setup, int32_t max_workers, Arena* arena);

// Number of phases of FollowOutlines.
inline constexpr int32_t kOutlinePhases = 15;

// Returns the repaired map, which is memory.repaired or memory.given. `thin` and `hair`, which may
// be null, have the parts of the map that are kept. Where the edges of the map are steps and few
// pixels would change their side, the map is right: memory.side is 0, memory.vote is 0 at pixels
// whose colours contradict the map, and known disparities are as given.
const int16_t* FollowOutlines(const starfocus_light_field& light_field,
                              const simd::DepthKernels& kernels, const ThinPatches& thin,
                              const HairMemory* hair, const OutlineMemory& memory, Sequence* run);

// Calls act(x, y, index) for each pixel of the band in `rect`.
template <class Act>
void ForBand(const OutlineMemory& memory, const Rect& rect, const Act& act) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    const size_t row = memory.At(0, y);
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x) {
      const size_t at = row + static_cast<size_t>(x);
      if (memory.distance[at] != 0) act(x, y, at);
    }
  }
}

// Returns true if a pixel of `rect` belongs to the band.
inline bool HasBand(const OutlineMemory& memory, const Rect& rect) {
  static constexpr int8_t kNone[kMostTileSide] = {};
  const auto count = static_cast<size_t>(rect.width);
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    if (std::memcmp(memory.distance + memory.At(rect.x, y), kNone, count) != 0) return true;
  }
  return false;
}

// Calls act(disparity, dx, dy) for the four neighbours of a pixel.
template <class Act>
void ForBeside(const OutlinePass& pass, int32_t x, int32_t y, const Act& act) {
  const int32_t width = pass.setup->width;
  const int16_t* own = pass.map + pass.At(x, y);
  if (x > 0) act(int32_t{own[-1]}, -1, 0);
  if (x + 1 < width) act(int32_t{own[1]}, 1, 0);
  if (y > 0) act(int32_t{own[-width]}, 0, -1);
  if (y + 1 < pass.setup->height) act(int32_t{own[width]}, 0, 1);
}

// Calls act(number, patch, begins) for the patches that a tile touches. `begins` is true if the
// first pixel of the patch lies in the tile.
template <class Act>
void ForShiftPatches(const OutlineMemory& memory, const Rect& tile, const Act& act) {
  const ShiftPatches columns = memory.Columns(), rows = memory.Rows();
  for (int32_t row = rows.Of(tile.y); row <= rows.Of(tile.y + tile.height - 1); ++row) {
    const int32_t top = rows.Begin(row), height = rows.Begin(row + 1) - top;
    for (int32_t column = columns.Of(tile.x); column <= columns.Of(tile.x + tile.width - 1);
         ++column) {
      const int32_t left = columns.Begin(column), width = columns.Begin(column + 1) - left;
      act(row * columns.Count() + column, Rect{left, top, width, height},
          left >= tile.x && top >= tile.y);
    }
  }
}

// The following functions process one tile of a pass, and each needs the results of the previous
// one for the pixels around the tile.

// Writes pass.vote, from samples that are trusted by their distance to the outline.
void VoteByColour(const OutlinePass& pass, const Rect& tile, VoteBlock* block);

// Writes pass.shift and pass.gain of the patches whose first pixels lie in the tile.
void ShiftOutlines(const OutlinePass& pass, const Rect& tile);

// Writes pass.side, from samples that are trusted by their own votes, and from the distance to the
// displaced outline.
void VoteAgain(const OutlinePass& pass, const Rect& tile, VoteBlock* block);

// Copies pass.map to pass.result in the tile, except pixels that change their side or lie on a
// ramp: these take the disparities of their side around them.
void WriteResult(const OutlinePass& pass, const Rect& tile, SidePlanes* planes);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_OUTLINES_H_
