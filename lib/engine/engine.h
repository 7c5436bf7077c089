// SPDX-License-Identifier: Apache-2.0
// One engine: its state, grouped by lifetime, and its memory. LayOut both computes the size of the
// workspace and divides the workspace into pieces; each part takes its own pieces. Also declares
// the comparison of frames (frame_diff.cc), whose flags are a part of the state.
#ifndef STARFOCUS_LIB_ENGINE_ENGINE_H_
#define STARFOCUS_LIB_ENGINE_ENGINE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/engine/deblock.h"
#include "lib/engine/lens.h"
#include "lib/io/block_pixels.h"
#include "lib/io/highlights.h"
#include "lib/io/input.h"
#include "lib/io/layers.h"
#include "lib/io/output.h"
#include "lib/matting/coverage.h"
#include "lib/matting/rims.h"
#include "lib/plan/cells.h"
#include "lib/plan/partition.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Comparison of two light fields. Rows are compared in order, starting at the first row that
// affects the region. The flags of a stripe and its neighbours are complete when all rows that
// affect these stripes have been compared.
struct FrameDiff {
  const FullConfig* config;
  // Light fields of the caller, which may end before the coverage if `covers` is false.
  const starfocus_light_field* before = nullptr;  // Null: light fields are not compared.
  const starfocus_light_field* now;
  const starfocus_image* picture;  // Previous picture, packed RGB: source of unchanged pixels.
  bool covers;                     // True if both light fields have coverage; false if none has.
  int32_t views;                   // Number of views to compare.
  // Number of pixels around a block, in the centre view and in side views, on which the block may
  // depend.
  int32_t centre_reach, side_reach;
  int32_t rows;   // Number of rows compared so far.
  int32_t known;  // Number of stripes whose flags are initialised.
  // Ring of stripes with one flag per column of superblocks: 1 if the superblock changed.
  uint8_t* flags = nullptr;
  int32_t stripes = 0;  // number of stripes in the ring

  uint8_t* Flags(int32_t stripe) const {
    return flags + static_cast<size_t>(stripe % stripes) * static_cast<size_t>(Columns(*config));
  }
};

// Allocates the flags. Input rows are compared up to `reach` rows below the next stripe. The
// compared rows flag stripes that start up to `reach` rows farther down. The ring of flags also
// keeps the flags of the previous stripe.
void TakeFrameDiff(const FullConfig& config, int32_t reach, Arena* arena, FrameDiff* changes);

// Compares all rows that affect blocks of the stripe at row y, of the previous stripe, or of the
// next stripe. Returns STARFOCUS_OK or STARFOCUS_ERROR_CANCELLED.
starfocus_status CompareRows(int32_t y, CancelToken* cancel, FrameDiff* changes);

// Returns true if a superblock that overlaps `rect` has changed. The distance from `rect` to the
// stripe that was compared last must be less than the height of a stripe.
bool HasChanged(const FrameDiff& changes, const Rect& rect);

// Statistics of a refocusing with the layers by value, which hides the caller's pointer.
struct FullReport : starfocus_report {
  starfocus_layer_report layers[STARFOCUS_LAYERS];
};

// Counts of one worker in one stripe.
struct Counts {
  starfocus_layer_report layers[STARFOCUS_LAYERS];
  uint64_t copied_pixels;
  uint64_t gathered_pixels;
  uint64_t unknown_pixels;
  uint64_t converted_pixels;
  uint64_t measured_pixels;
  uint32_t depth_flags;  // flags (simd::kUnknownDepth) of the rows that were read
};

// Scratch memory of one worker. Each renderer leaves the weighted sums of a block in `sums`. The
// pointers except `sums` and the weights share memory, because a worker runs one step at a time
// (engine.cc). R is the largest side of a rectangle to refocus, in pixels.
struct Scratch {
  RendererScratch* renderers[kMaxRenderers];  // Scratch memory of each renderer.
  uint32_t* sums;                             // 3 R^2 samples.
  uint16_t* aperture_weights;  // With cat's eyes: view weights of a block, for up to the largest N.
  LampLengths* lamp_lengths;   // Cache of runs of highlights, if highlights are enabled.
  int16_t *block_rgb, *block_disparity;  // Pixels of a block that is blurred without views.
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

// Blocks of a stripe. Planning stores the blocks of each superblock in a separate part of `blocks`.
// After planning, the blocks to refocus are moved to the start of `blocks`.
struct StripePlan {
  int32_t side;        // Side of a superblock in pixels.
  int32_t columns;     // Number of columns of superblocks.
  uint8_t* wanted;     // Per superblock: 1 if the superblock is refocused.
  uint8_t* measured;   // Per superblock: 1 if its cells are measured.
  bool all_measured;   // True: the previous stripe measured the cells of every column.
  Block* blocks;       // Memory for MaxBlocks blocks per superblock.
  int32_t* counts;     // Number of blocks of each superblock.
  int32_t used;        // Number of blocks to refocus.
  GatherMap gathered;  // In block mode, the cells that are blurred without views.

  Block* BlocksOf(int32_t column) const {
    return blocks + static_cast<size_t>(column) * static_cast<size_t>(MaxBlocks(side));
  }
};

struct StripeState {
  CellGrid cells;        // Cells of the stripe and of the surroundings that splat into the stripe.
  CoverageMap coverage;  // Coverage of the stripe and of the rows around the stripe.
  RimMap rims;           // Rims of the same rows.
  StripePlan plan;
  LayerMap map;       // Layer of each smallest block, for deblocking.
  FrameDiff changes;  // Superblocks that differ from the previous light field.
  // Output: the last kDeblockRows rows of the previous stripe, and the stripe, packed.
  PictureRows out;
  // With streaming: the last kDeblockRows rows of the previous stripe, saved when that stripe was
  // finished. Null without streaming, because a failed call is not resumed and the last rows can
  // stay in `out`.
  PictureRows last_rows;
  int32_t excess_shift = 0;  // Input::excess_shift of the blocks of a deep picture.
};

// Passes over a block. Light up to white comes first. Excess, which is the light beyond
// white, and alpha are refocused in the same way, where there are any.
enum Pass { kLightPass, kExcessPass, kAlphaPass, kPassCount };

// Progress of a streamed refocusing, in rows.
struct Stream {
  bool active = false;
  bool covers = false;   // True: pushed rows include coverage.
  int32_t pushed = 0;    // Number of pushed input rows.
  int32_t next = 0;      // First row of the next stripe.
  int32_t finished = 0;  // Number of output rows that no later stripe changes.
  int32_t written = 0;   // Number of output rows that the caller has pulled.
};

// Frees memory that came from an allocator. Does nothing if its functions are null, because the
// memory then belongs to the caller. The allocator is a copy, because the memory may contain it.
inline void Release(starfocus_allocator allocator, void* memory, size_t bytes) {
  if (allocator.release != nullptr) allocator.release(allocator.data, memory, bytes);
}

struct EngineMemory;

// Copies of an engine share its tables, jobs and memory.
struct EngineState {
  // The following members are valid for the life of the engine.
  FullConfig config;               // config.problem points to `problem` of this struct.
  starfocus_problem problem = {};  // Problem that the last call reported.
  const simd::Kernels* kernels;
  Tables* tables;
  Jobs* jobs;                  // Runs the jobs; has room for MaxJobs jobs.
  Scratch* scratch = nullptr;  // Scratch memory of each worker.
  DeepTables* deep = nullptr;  // Null without STARFOCUS_FEATURE_DEEP.
  // Memory of the engine, its size, and the part that TakePicture divides into pieces.
  EngineMemory* memory = nullptr;
  size_t bytes = 0;
  uint8_t* picture_memory = nullptr;
  // Frees the memory of the engine. If the allocator's functions are null, the caller owns the
  // memory.
  starfocus_allocator allocator = {};
  InputRings rings;
  // See Output. With images.
  uint8_t* odd_row = nullptr;
  Plane<uint8_t> dithered, dithered_alpha;

  // The following members are valid until the next call of starfocus_set_callbacks, like the runner
  // and the progress function in `jobs`.
  starfocus_observer observer = {};

  // The following members are valid for one refocusing.
  Lens lens;
  Input input;
  StripeLayers layers;
  LayerPlane pass_layers[kPassCount][STARFOCUS_LAYERS];  // Layers of the excess and the alpha.
  Stream stream;
  FullReport report;

  // The following member is valid for one stripe.
  StripeState stripe;
};

// Returns an output of the engine to `image`, which must be valid, without alpha.
Output OutputOf(const EngineState& engine, const starfocus_image& image, const Rect& rect);

// Returns the input of a pass other than kLightPass. `scratch` provides the memory of highlights.
Input InputOf(const EngineState& engine, Pass pass, const Scratch& scratch);

// Starts to compare the engine's input, the light field `now` of the caller, with the previous
// frame. The lens must be set.
void StartFrameDiff(const starfocus_previous& previous, const starfocus_light_field* now,
                    EngineState* engine);

// Sets up the lens for `params` and discards the state of the previous refocusing. Reports progress
// through the workers' CallProgress. Returns STARFOCUS_ERROR_BLUR, STARFOCUS_ERROR_CANCELLED or
// STARFOCUS_OK. The caller must have checked all other requirements on `params`.
starfocus_status SetLens(const FullParams& params, EngineState* engine);

// ReportCounts moves the workers' counts to the report. DropCounts discards these counts.
void ReportCounts(EngineState* engine);
void DropCounts(EngineState* engine);

// Writes the statistics of the last refocusing to *report, unless it is null. Writes only the first
// report->size bytes, because the caller's header may be older than the library.
void WriteReport(const EngineState& engine, starfocus_report* report);

// Discards the state of the previous stripe, so that the next stripe reuses no data.
void ForgetStripe(StripeState* stripe);

// Discards the rows of the layers, which belong to another picture or are incomplete.
void ForgetLayers(const FullConfig& config, StripeLayers* layers);

// Allocates the memory of a worker that subsamples a column of superblocks.
void TakeResample(const FullConfig& config, Arena* arena, ResampleScratch* resample);

// Allocates the planes of layers 1 and 2 around a stripe, and the marks of their columns.
void TakeLayers(const FullConfig& config, Arena* arena, StripeLayers* layers);

// Allocates the layers of the passes after kLightPass.
void TakePassLayers(const FullConfig& config, Arena* arena, EngineState* engine);

// Allocates the cells and blocks of a stripe, and the map of their layers.
void TakePlan(const FullConfig& config, Arena* arena, StripeState* stripe);

// Makes an engine for a valid configuration at `base`, aligned to STARFOCUS_ALIGNMENT. If `base` is
// null, only counts the bytes and sets *engine to null. Returns the number of bytes, or kTooLarge.
// `pieces` receives each piece and may be null.
size_t LayOut(const FullConfig& config, void* base, EngineState** engine,
              const PieceVisitor* pieces = nullptr);

// Returns an engine for pictures of `config`, which may differ from the configuration of *engine
// only in a smaller or equal picture and range of disparities, and must not enable streaming. Both
// engines share all memory, so *engine must not be used while the result is; afterwards *engine
// keeps its tables, but no state of a stream.
EngineState PreviewEngine(const FullConfig& config, EngineState* engine);

// Poisons the red zones of an engine's memory during the lifetime of this object; no-op in builds
// without red zones. After the lifetime of this object, the caller, which owns the memory, may use
// the memory for another purpose.
class RedZones {
 public:
  explicit RedZones(const EngineState& engine);
  ~RedZones();
  RedZones(const RedZones&) = delete;
  RedZones& operator=(const RedZones&) = delete;

 private:
  [[maybe_unused]] const EngineState& engine_;
};

// Returns the address range of the memory that an engine occupies.
Extent Workspace(const EngineState& engine);

// Returns the largest number of jobs in any set of an engine.
int32_t MaxJobs(const FullConfig& config);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_ENGINE_H_
