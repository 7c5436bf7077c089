// SPDX-License-Identifier: Apache-2.0
// Disparity maps of the centre view from several views: their memory, the conversion of the light
// field, estimates, and repairs of a given map.
//
// An estimate sweeps twice over all candidate disparities (labels). The first sweep uses the views
// on one side of each pixel. The result of the first sweep shows which views see each pixel, and
// the second sweep uses only these views. A repair sweeps like an estimate, with an additional cost
// for labels that differ from the given map. A last phase decides which of the contradicted pixels
// are changed.
#ifndef STARFOCUS_LIB_DEPTH_MAPS_H_
#define STARFOCUS_LIB_DEPTH_MAPS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/jobs.h"
#include "lib/depth/setup.h"
#include "lib/depth/thin_patches.h"
#include "lib/io/depth_map.h"
#include "simd/kernels.h"
#include "starfocus/depth.h"

namespace starfocus {

// Output planes of a map. Disparities are clamped to [lowest, highest]. Without data, confidence
// and coverage are not requested.
struct MapOutput {
  Plane<float> disparity;
  float lowest, highest;
  Plane<uint8_t> confidence, coverage;

  float Clamped(float value) const {
    return value < lowest ? lowest : value > highest ? highest : value;
  }
  // Writes a disparity in fixed point (kDisparityBits).
  void Write(int32_t x, int32_t y, int32_t d) const {
    disparity.Row(y)[x] = Clamped(static_cast<float>(d) / (1 << kDisparityBits));
  }
  void WriteConfidence(int32_t x, int32_t y, uint8_t value) const {
    if (confidence.data != nullptr) confidence.Row(y)[x] = value;
  }
};

// Returns row y of the given map.
inline const float* GivenAt(const starfocus_light_field& light_field, int32_t y) {
  return RowsOf(light_field.depth).Row(y);
}

// Counts of pixels in a tile of a given map.
struct TileCount {
  int32_t rough;    // Pixels at edges.
  int32_t differs;  // Pixels that the repair contradicts.
};

// Returns the evidence required for a change, which depends on the percentage of edge pixels that
// the repair contradicts. If the percentage is small, the map is assumed to be right, and the
// required evidence is `right`. If it is large, the required evidence is `wrong`. In between, the
// required evidence is interpolated. `counts` has one element for each of the `tiles` tiles of the
// map.
int32_t LeastEvidence(const TileCount* counts, int32_t tiles, int32_t right, int32_t wrong);

// Takes the state of the jobs of a call that processes the tiles of `setup` one by one.
Jobs* TakeJobs(const SweepSetup& setup, int32_t max_workers, Arena* arena);

struct TileMemory;

// Memory of an estimate or repair: maps of the whole picture, and scratch memory of each worker for
// one tile.
struct EstimateMemory {
  Jobs* jobs;
  // Disparities of the whole picture after the first sweep, which ignores occlusion, in fixed point
  // (kDisparityBits). After the sweeps, a repair stores the results of EvenedAt in `first`.
  int16_t* first;
  int16_t* second;     // Disparities after the second sweep, which omits hidden views.
  uint8_t* certainty;  // Certainty of the second sweep.
  // If the views lie on one side: the disparity maps of the side views, in the order of the setup.
  // Each map has the size of the picture. Otherwise null.
  int16_t* side_maps;
  // `given` and all later arrays of this structure are for repairs, and null for estimates. Unknown
  // disparities are kNoSurface.
  int16_t* given;    // Given disparities.
  int16_t* trusted;  // Given disparities at trusted pixels; kNoSurface at all other pixels.
  // Marks of pixels in doubt (swept.h). `doubt` shares the memory of `certainty`; at most one of
  // the two is in use at a time.
  uint8_t* doubt;
  uint8_t* swept;     // 1 for pixels that the sweeps process, else 0; null if all pixels are swept.
  TileCount* counts;  // One element for each tile.
  // Cost of each pixel's disparity in the given map and in the map of the second sweep. The two
  // costs are equal at pixels without a given disparity.
  uint8_t* given_cost;
  uint8_t* found_cost;
  // Thin structure of the given map and of the result of the sweeps.
  ThinPatches given_patches, found_patches;
  TileMemory* workers;  // sweep.h
};

// Returns the map of side view k in memory.side_maps.
inline int16_t* SideMap(const SweepSetup& setup, const EstimateMemory& memory, int32_t k) {
  return memory.side_maps + ptrdiff_t{k} * setup.width * setup.height;
}

// Takes the memory of an estimate or repair.
EstimateMemory TakeEstimate(const SweepSetup& setup, int32_t max_workers, Arena* arena);

// Replaces the views of *field and, for a repair, its map by converted copies in memory of `arena`.
// If the arena only counts, changes nothing; `jobs` and `field` may then be null. Images and maps
// that are read in place are not copied. Disparities are rounded to 1/64 pixel and limited to the
// configured range; unknown disparities are NaN. A set has at most one job per tile of the setup.
// Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER.
starfocus_status ConvertField(const FullConfig& config, const SweepSetup& setup, Arena* arena,
                              Jobs* jobs, starfocus_light_field* field);

// Estimates the disparity map of the centre view and writes the map to `output`. Returns
// STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER.
starfocus_status Estimate(const SweepSetup& setup, const starfocus_light_field& light_field,
                          const simd::DepthKernels& kernels, const MapOutput& output,
                          const EstimateMemory& memory);

// Repairs light_field.depth and writes the result to `output`. setup.repairs must be true. Pixels
// whose disparity the views do not contradict keep this disparity exactly. Unknown pixels (NaN or
// infinite) get a disparity. Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or
// STARFOCUS_ERROR_RUNNER.
starfocus_status Repair(const SweepSetup& setup, const starfocus_light_field& light_field,
                        const simd::DepthKernels& kernels, const MapOutput& output,
                        const EstimateMemory& memory);

// Returns the disparity of pixel (x, y), or the weighted median of its neighbourhood if the pixel's
// disparity differs too much from the median. Neighbours of similar colour have larger weights.
// `map` has the size of the picture, and disparities are in fixed point (kDisparityBits).
int16_t WithoutStray(const SweepSetup& setup, const Plane<const uint8_t>& centre,
                     const int16_t* map, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAPS_H_
