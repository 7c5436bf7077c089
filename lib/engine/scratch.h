// SPDX-License-Identifier: Apache-2.0
// What belongs to one worker: memory that its jobs use one after the other, and what it counts.
#ifndef STARFOCUS_LIB_ENGINE_SCRATCH_H_
#define STARFOCUS_LIB_ENGINE_SCRATCH_H_

#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/engine/tables.h"
#include "lib/filter/blur.h"
#include "lib/filter/layers.h"
#include "lib/input/excess.h"
#include "lib/plan/partition.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// What a worker counts in one stripe.
struct Counts {
  starfocus_layer_report layers[STARFOCUS_LAYERS];
  uint64_t copied_pixels;
  uint64_t gathered_pixels;
  uint64_t unknown_pixels;
  uint32_t depth_flags;  // simd::DepthFlags of rows that were read
};

// The extended rectangle of a block in the centre view. E: largest side of one.
struct BlockPixelsMemory {
  int16_t* rgb;        // light: E rows of RgbStride(E)
  int16_t* disparity;  // E^2
};

// Every renderer leaves the weighted sums of a block in `sums`; but for these and weights all
// memory of a worker is shared, since a worker does one thing at a time (layout.cc). R: largest
// side of a rectangle.
struct Scratch {
  void* renderers[kMaxRenderers];  // of each
  uint32_t* sums;                  // 3 R^2
  uint16_t* aperture_weights;      // with cat's eyes: of a block, of the largest N
  LampRuns* lamp_runs;             // with highlights
  BlockPixelsMemory field;         // of blocks that are gathered, or blurred by depth
  SpanMemory spans;                // of blocks blurred by depth
  ResampleScratch resample;
  UpsampleScratch upsample;
  int16_t* layer_samples;    // a rendered rectangle
  int16_t* middle_samples;   // at layer 1, on the way up from layer 2
  int16_t* picture_samples;  // 3 R^2: the block at layer 0
  PartitionScratch partition;
  Counts counts;
  CancelToken cancel;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_SCRATCH_H_
