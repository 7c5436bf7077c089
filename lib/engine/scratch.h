// SPDX-License-Identifier: Apache-2.0
// Data of one worker: scratch memory, which the jobs of the worker use in turn, and counts.
#ifndef STARFOCUS_LIB_ENGINE_SCRATCH_H_
#define STARFOCUS_LIB_ENGINE_SCRATCH_H_

#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/engine/tables.h"
#include "lib/gather/depth_blur.h"
#include "lib/io/block_pixels.h"
#include "lib/io/highlights.h"
#include "lib/io/layers.h"
#include "lib/plan/partition.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Counts of one worker in one stripe.
struct Counts {
  starfocus_layer_report layers[STARFOCUS_LAYERS];
  uint64_t copied_pixels;
  uint64_t gathered_pixels;
  uint64_t unknown_pixels;
  uint32_t depth_flags;  // simd::DepthFlags of the rows that were read
};

// Scratch memory of one worker. Each renderer leaves the weighted sums of a block in `sums`. The
// pointers except `sums` and the weights share memory, because a worker runs one step at a time
// (layout.cc). R is the largest side of a rectangle to refocus, in pixels.
struct Scratch {
  void* renderers[kMaxRenderers];  // Scratch memory of each renderer.
  uint32_t* sums;                  // 3 R^2 samples.
  uint16_t* aperture_weights;  // With cat's eyes: view weights of a block, for up to the largest N.
  LampRuns* lamp_runs;         // Cache of runs of highlights, if highlights are enabled.
  BlockPixels field;           // Memory for the pixels of a block that is blurred without views.
  SpanMemory spans;            // Spans of a block that is blurred by depth.
  ResampleScratch resample;
  UpsampleScratch upsample;
  int16_t* layer_samples;          // Samples of the rendered rectangle.
  int16_t* middle_samples;         // Result at layer 1 while upsampling from layer 2.
  int16_t* picture_samples;        // 3 R^2 samples: the block at layer 0.
  PartitionCandidate* candidates;  // Memory of PartitionBlock.
  int16_t* cell_samples;
  Counts counts;
  CancelToken cancel;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_SCRATCH_H_
