// SPDX-License-Identifier: Apache-2.0
// Refocuses one stripe: finds its coverage (lib/matting), plans its blocks (stripe_plan.cc),
// subsamples the centre view (stripe_layers.cc), renders the blocks (block.cc) and deblocks their
// boundaries. Also has the loop over the stripes of a picture (ForStripes), and refocuses whole
// pictures (driver.cc).
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_H_

#include <cstdint>

#include "lib/engine/engine.h"
#include "lib/optics/view_grid.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the grid of the views that the block is rendered from. `weights` is memory for the
// weights of an aperture with a cat's eye: FullApertureSize(N) elements.
ViewGrid ViewGridOf(const EngineState& engine, const Block& block, uint16_t* weights);

// Writes the rectangle of the block to `out` and adds the block to scratch->counts.
void RefocusBlock(const EngineState& engine, const Block& block, const PictureRows& out,
                  Scratch* scratch);

// Clears the marks of the columns to subsample, for a new stripe. Keeps the old marks as the marks
// of the previous stripe.
void ClearLayerColumns(const FullConfig& config, StripeLayers* layers);

// Marks all columns of all layers that the engine may use.
void MarkLayerColumns(const FullConfig& config, StripeLayers* layers);

// Marks the columns of superblocks that `block` reads.
void MarkLayerColumns(const FullConfig& config, const Block& block, StripeLayers* layers);

// Moves the layers, also of the engine's input, to the rows `of_picture` of the picture, extended
// by `borders`. Rows of the layers that were computed for the previous stripe are kept.
void PlaceLayers(const Range& of_picture, const Borders& borders, EngineState* engine);

// All layers that FillLayers computes.
inline constexpr Range kAllLayers = {1, STARFOCUS_LAYERS};

// Computes the marked columns of the layers [layers.first, layers.last), from the picture or, for
// layer 2 and if it is not null, from `layer_one`, whose samples contain all rows that the filter
// reads. PlaceLayers must be called first. Returns STARFOCUS_OK, STARFOCUS_ERROR_RUNNER or
// STARFOCUS_ERROR_CANCELLED.
starfocus_status FillLayers(const Range& layers, const LayerPlane* layer_one, EngineState* engine);

// Computes the marked columns of the layers of the passes after kLightPass, for the rows of the
// stripe, if any block needs them. Also sets stripe.excess_shift. Returns as FillLayers.
starfocus_status FillPassLayers(const Range& stripe, EngineState* engine);

// Marks the columns of superblocks to refocus, and the columns whose cells must be measured to plan
// these superblocks. Returns false if no column has to be refocused.
bool ChooseColumns(const Range& rows, EngineState* engine);

// Measures cells, splits superblocks, and drops blocks that do not affect the requested pixels.
// Reports the remaining blocks to the caller's visitor. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_RUNNER or STARFOCUS_ERROR_CANCELLED.
starfocus_status PlanStripe(const Range& rows, EngineState* engine);

// Returns the number of output rows that are final after the stripe at row y.
int32_t FinishedRows(const FullConfig& config, int32_t y);

// Returns the output buffer for the stripe at row y. The buffer also contains the rows above the
// stripe that the stripe may still change.
PictureRows BufferRows(const EngineState& engine, int32_t y);

// Refocuses the part of the stripe at row y that affects the region of the lens, into BufferRows.
// `y` must be a multiple of the superblock size, and stripes must be refocused in order. The
// input must contain all rows within the borders of the stripe. After
// STARFOCUS_ERROR_RUNNER and STARFOCUS_ERROR_CANCELLED the rows are unspecified and the state of
// the engine is restored, so that a stream can refocus the stripe again.
starfocus_status RefocusStripe(EngineState* engine, int32_t y);

// Returns the status of flags (simd::kUnknownDepth): STARFOCUS_OK, STARFOCUS_ERROR_NOT_FINITE or
// STARFOCUS_ERROR_DISPARITY. If both kinds of errors occur, returns STARFOCUS_ERROR_NOT_FINITE.
starfocus_status CheckFlags(uint32_t flags, const FullConfig& config);

// If `disparity` is null, checks the map of the engine's input, and returns an error of CheckFlags
// if any value on which `rows` depend is invalid. Otherwise converts rows of the map to `disparity`
// and, if the input converts the centre view, rows of the centre view to their ring.
starfocus_status ReadRows(const Range& rows, const Plane<int16_t>* disparity, EngineState* engine);

// Returns the rows of all stripes that affect the region of the lens. The first row is a multiple
// of the superblock size.
Range StripeRows(const EngineState& engine);

// The loop over stripes of whole pictures, streams and prepared light fields. A stripe reads its
// own rows and `reach` rows above and below. Calls step(y, read) for the stripes that begin at
// stripes.first and every superblock after it, before stripes.last. `read` are the input rows that
// no earlier stripe of the loop has read. Stops before the first stripe that reads a row from
// `available` on, and after the first step that does not return STARFOCUS_OK. Returns the status of
// the last step.
template <class Step>
starfocus_status ForStripes(const Range& stripes, int32_t reach, int32_t available,
                            const FullConfig& config, const Step& step) {
  starfocus_status status = STARFOCUS_OK;
  Range read = {0, Max(0, stripes.first - reach)};
  for (int32_t y = stripes.first; y < stripes.last; y += config.superblock) {
    read = {read.last, Min(config.height, y + config.superblock + reach)};
    if (read.last > available) break;
    status = step(y, read);
    if (status != STARFOCUS_OK) break;
  }
  return status;
}

// Refocuses the stripes that affect the region of the lens, and stores the rows of the region.
// Checks all input rows before it stores the first output row. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_CANCELLED, STARFOCUS_ERROR_RUNNER or an error of the disparity map.
starfocus_status RefocusRows(const Output& out, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_H_
