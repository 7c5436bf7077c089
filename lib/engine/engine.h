// The state of an engine, and the lens of the refocusing under way.
#ifndef STARFOCUS_LIB_ENGINE_ENGINE_H_
#define STARFOCUS_LIB_ENGINE_ENGINE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/view_grid.h"
#include "lib/engine/frame_changes.h"
#include "lib/engine/jobs.h"
#include "lib/filter/blur.h"
#include "lib/filter/deblock.h"
#include "lib/filter/layers.h"
#include "lib/input/window.h"
#include "lib/line_scan/triangles.h"
#include "lib/plan/block_stats.h"
#include "lib/plan/partition.h"
#include "lib/slices/compositor.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// How far beyond a stripe of blocks anything may be read, for blur up to a radius.
struct Reach {
  int32_t border;  // pixels: largest border of a block
  int32_t cells;   // how many cells away a pixel may splat from
  int32_t rows;    // picture rows of the centre view and the disparity map
};
Reach GetReach(double max_blur);

// Rows of a layer that a stripe may need.
int32_t LayerRows(const sf_config& config, int layer);

// Rows beyond a stripe that side views are read in, for blur up to a radius.
int32_t SideReach(const sf_config& config, double max_blur);

// Progress of a streamed refocusing, in rows.
struct Stream {
  bool active = false;
  int32_t pushed = 0;    // input rows taken
  int32_t next = 0;      // first row of the next stripe
  int32_t finished = 0;  // output rows that no later stripe changes
  int32_t written = 0;   // output rows the caller has pulled
};

// What a worker counts in one stripe.
struct Counts {
  sf_layer_report layers[SF_LAYERS];
  sf_skipped skipped;
  uint64_t centre_bytes;
  uint64_t side_bytes;
  uint64_t gathered_pixels;
};

// Memory of one worker.
struct Worker {
  LineScanScratch line_scan;
  CompositorScratch compositor;
  ResampleScratch resample;
  UpsampleScratch upsample;
  int16_t* layer_samples;   // a rendered rectangle
  int16_t* middle_samples;  // at layer 1, on the way up from layer 2
  int16_t* picture_samples;
  PartitionScratch partition;
  Counts counts;
};

// The blocks of a stripe, largest block by largest block.
struct StripePlan {
  uint8_t* wanted;             // per largest block: some of its pixels are needed
  uint8_t* measured;           // per largest block: its cells are needed
  bool all_measured;           // for the stripe before: those of every column
  Block* blocks;               // MaxBlocks per largest block
  int32_t* counts;             // blocks used of each
  GatherMap gathered;          // block mode
  uint8_t* needed[SF_LAYERS];  // per largest block's column: ColumnNeed of its layer 1, 2
};

// Whether the columns of a layer are read by the stripe, and whether they were by the one before.
enum ColumnNeed : uint8_t { kNeeded = 1, kNeededBefore = 2 };

struct EngineState {
  sf_config config;
  const simd::Kernels* kernels;
  uint32_t fall_off;  // ApertureFallOff(config.theta)

  // Tables made once: by N up to max_n, and kernels of the blur mode as far as asked for.
  int32_t max_n, max_subaperture_n;
  Aperture *apertures, *subapertures;  // by the paper's rule and by the rule of subapertures
  uint16_t* aperture_weights;          // of both
  ViewCounts *view_counts, *subaperture_view_counts;
  uint16_t* benchmark_weights;
  BlurKernel* blur_kernels;
  uint16_t* blur_weights;
  int32_t blur_steps;  // made so far

  // The lens of the refocusing under way.
  sf_params params;
  Rect region;        // of params, the whole picture when they have none
  Aperture aperture;  // frame modes: of the one N
  BlurScale scale;
  Reach reach;
  sf_report report;
  bool prepared;  // disparities and layers of the windows are those of a prepared light field

  Window windows[SF_LAYERS];
  LayerPlane layers[SF_LAYERS];  // of layers 1 and 2
  Plane<int16_t> disparity;      // ring of converted rows
  int32_t disparity_rows;        // of a whole picture, converted so far
  CellGrid cells;
  StripePlan plan;
  LayerMap map;
  Changes changes;

  Plane<uint8_t> rings[kMaxViews];  // with streaming
  uint8_t* stripe_out;              // kDeblockRows and a stripe, packed
  uint8_t* last_rows;               // the last kDeblockRows of the stripe before, as it left them
  Stream stream;

  Worker* workers;  // config.max_workers
  JobSet jobs;
};

inline int32_t BlockSide(const EngineState& engine) { return engine.config.largest_block; }

// Columns of largest blocks.
inline int32_t Columns(const EngineState& engine) {
  return (engine.config.width + BlockSide(engine) - 1) / BlockSide(engine);
}

inline bool IsBlockMode(const EngineState& engine) { return engine.params.mode == SF_MODE_BLOCK; }

inline bool IsBenchmark(const EngineState& engine) {
  return engine.params.mode == SF_MODE_BENCHMARK;
}

// Whether views stand for subapertures, and show slices.
inline bool UsesSubapertures(const EngineState& engine) {
  const int32_t rule = engine.params.rule;
  if (engine.params.mode == SF_MODE_FRAME) return rule == SF_RULE_SUBAPERTURE;
  return (IsBlockMode(engine) || IsBenchmark(engine)) && rule != SF_RULE_PAPER;
}

// Of a block with the rule's N.
inline const Aperture& ApertureOf(const EngineState& engine, int32_t n) {
  if (!IsBlockMode(engine)) return engine.aperture;
  return UsesSubapertures(engine) ? engine.subapertures[n] : engine.apertures[n];
}

// Whether blocks of different layers are joined.
inline bool IsDeblocking(const EngineState& engine) {
  return IsBlockMode(engine) && engine.config.max_layer > 0 && engine.config.deblocking > 0;
}

// Pixels around a block that joining it to others may change, and the rows above a stripe that are
// finished with it.
inline int32_t JoinReach(const EngineState& engine) {
  static_assert(kDeblockRows >= kDeblockReach, "rows wait for every join that changes them");
  return IsDeblocking(engine) ? kDeblockRows : 0;
}

// Makes the tables of a fresh engine.
void MakeTables(EngineState* engine);

// Points the windows at whole pictures (ring_rows = 0) or line rings.
void SetViews(const Plane<const uint8_t>* views, EngineState* engine);

// Whether no region is asked for, which means the whole picture.
inline bool IsWhole(const sf_region& region) {
  return region.x == 0 && region.y == 0 && region.width == 0 && region.height == 0;
}

// The rectangle that params ask for.
Rect RegionOf(const sf_config& config, const sf_params& params);

// Converts a disparity row to `out`, checking that it lies in the configured range.
sf_status ConvertDisparity(const EngineState& engine, const float* row, int16_t* out);

// Converts row y into the engine's ring.
sf_status ReadDisparity(const float* row, int32_t y, EngineState* engine);

// Adds to the report what the workers counted since the last time; or forgets it.
void TakeCounts(EngineState* engine);
void DropCounts(EngineState* engine);

// There is no stripe before the next one: nothing that it made is of use.
void ForgetStripe(EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_ENGINE_H_
