// SPDX-License-Identifier: Apache-2.0
// Refocuses one block: renders its views, or blurs it without views, and upsamples the result from
// its layer to the picture.
#include <cstring>

#include "lib/engine/stripe.h"
#include "lib/gather/gather.h"
#include "lib/io/highlights.h"

namespace starfocus {
namespace {

size_t Samples(const Rect& rect) {
  return 3 * static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height);
}

uint8_t* At(const Plane<uint8_t>& out, const Rect& rect, int32_t row) {
  return out.Row(rect.y + row) + 3 * static_cast<size_t>(rect.x);
}

void FinishPicture(const EngineState& engine, const Rect& rect, int shift,
                   const Plane<uint8_t>& out, const Scratch& scratch) {
  const size_t samples = 3 * static_cast<size_t>(rect.width);
  CheckSums(scratch.sums, Samples(rect), shift);
  for (int32_t row = 0; row < rect.height; ++row) {
    engine.input.kernels->Finish(scratch.sums + static_cast<size_t>(row) * samples, samples, shift,
                                 *engine.input.transfer, At(out, rect, row));
  }
}

// Converts the sums of a block to samples of the block's layer, and stores the samples at their
// position in LayerFrame.
void KeepLayer(const EngineState& engine, const Block& block, int shift, const Scratch& scratch) {
  const Rect frame = LayerFrame(block.rect, block.layer), &rendered = block.rendered;
  const size_t samples = 3 * static_cast<size_t>(rendered.width);
  CheckSums(scratch.sums, Samples(rendered), shift);
  for (int32_t row = 0; row < rendered.height; ++row) {
    const size_t pixel =
        static_cast<size_t>(rendered.y - frame.y + row) * static_cast<size_t>(frame.width) +
        static_cast<size_t>(rendered.x - frame.x);
    engine.input.kernels->FinishLayer(scratch.sums + static_cast<size_t>(row) * samples, samples,
                                      shift, scratch.layer_samples + 3 * pixel);
  }
}

// Upsamples a block from its layer to the picture. Layer 2 is upsampled through layer 1, including
// the border that the second upsampling step reads.
void FinishLayer(const EngineState& engine, const Block& block, const Plane<uint8_t>& out,
                 const Scratch& scratch) {
  const simd::Kernels& kernels = *engine.input.kernels;
  const Rect frame = LayerFrame(block.rect, block.layer);
  CheckAll(ranges::kLayerSample, scratch.layer_samples, Samples(frame));
  LayerRect layer = {scratch.layer_samples, frame.width, frame.height};
  int32_t border = UpsampleBorder(block.layer);
  if (block.layer == 2) {
    const int32_t next_border = UpsampleBorder(1);
    const LayerRect middle = {scratch.middle_samples,
                              ((block.rect.width + 1) >> 1) + 2 * next_border,
                              ((block.rect.height + 1) >> 1) + 2 * next_border};
    UpsampleByTwo(kernels, layer, border - next_border / 2, scratch.upsample, middle);
    layer = middle;
    border = next_border;
  }
  const LayerRect picture = {scratch.picture_samples, block.rect.width, block.rect.height};
  UpsampleByTwo(kernels, layer, border, scratch.upsample, picture);
  const size_t samples = 3 * static_cast<size_t>(block.rect.width);
  for (int32_t row = 0; row < block.rect.height; ++row) {
    kernels.Narrow(picture.samples + static_cast<size_t>(row) * samples, samples,
                   *engine.input.transfer, At(out, block.rect, row));
  }
}

// Renders the views of a job into the worker's sums. Returns the number of samples of a view.
uint64_t RenderSums(const EngineState& engine, const RenderJob& job, Scratch* scratch) {
  const Renderer& renderer = *engine.lens.renderer;
  return renderer.render(job, scratch->renderers[renderer.index], scratch->sums);
}

// Returns the fractional bits of the sums of RenderSums.
int SumBits(const EngineState& engine, const RenderJob& job) {
  return engine.lens.renderer->sum_bits(job.grid->aperture);
}

// Renders the light of highlights beyond white and adds this light to the block. Returns the number
// of samples of a view. Not inlined, because its Input of more than 1 KiB would lie on the stack
// under every block.
[[gnu::noinline]] uint64_t RenderExcess(const EngineState& engine, RenderJob job,
                                        const Plane<uint8_t>& out, Scratch* scratch) {
  const Input excess = ExcessOf(engine.input, engine.config.highlights, scratch->lamp_lengths);
  job.input = &excess;
  const uint64_t samples = RenderSums(engine, job, scratch);
  if (!scratch->cancel.Spend(0)) return 0;
  const size_t row_samples = 3 * static_cast<size_t>(job.rect.width);
  for (int32_t row = 0; row < job.rect.height; ++row) {
    AddExcess(excess, scratch->sums + static_cast<size_t>(row) * row_samples, row_samples,
              SumBits(engine, job), At(out, job.rect, row));
  }
  return samples;
}

// Renders the views of a block, and counts the rendered samples.
void Render(const EngineState& engine, const Block& block, const RenderJob& job,
            const Plane<uint8_t>& out, Scratch* scratch) {
  uint64_t samples = RenderSums(engine, job, scratch);
  if (!scratch->cancel.Spend(0)) return;  // after cancellation, the sums are incomplete
  if (block.layer == 0) {
    FinishPicture(engine, job.rect, SumBits(engine, job), out, *scratch);
  } else {
    KeepLayer(engine, block, SumBits(engine, job), *scratch);
    if (!block.gathers) FinishLayer(engine, block, out, *scratch);
  }
  if (block.has_highlights) samples += RenderExcess(engine, job, out, scratch);
  const auto views = static_cast<uint64_t>(WeightsOf(engine.lens, block.n).views);
  starfocus_layer_report& report = scratch->counts.layers[block.layer];
  report.views += views;
  report.rendered_samples += views * samples;
}

// Blurs the cells of a block that need no views (gathering), and writes the completed block to the
// picture.
void GatherBlock(const EngineState& engine, const Block& block, const Plane<uint8_t>& out,
                 Scratch* scratch) {
  BlockPixels field;
  field.rgb = scratch->block_rgb;
  field.disparity = scratch->block_disparity;
  const BlockCells cells = {&engine.stripe.plan.gathered, block.rect, block.layer};
  const Tables& tables = *engine.tables;
  const GatherJob job = {&engine.input,      &engine.stripe.cells, cells,
                         engine.lens.scale,  tables.psfs,          LastGatherPsf(engine.lens),
                         tables.mean_square, &scratch->cancel};
  const Rect frame = LayerFrame(block.rect, block.layer);
  const size_t stride = block.layer == 0 ? out.stride : 3 * static_cast<size_t>(frame.width);
  scratch->counts.gathered_pixels +=
      GatherCells(job, &field, At(out, block.rect, 0), scratch->layer_samples, stride);
  if (block.layer > 0 && scratch->cancel.Spend(0)) FinishLayer(engine, block, out, *scratch);
}

// Copies `rect` of a block, in which no view moves a pixel, from the centre view.
void CopyBlock(const EngineState& engine, const Block& block, const Rect& rect,
               const Plane<uint8_t>& out, Scratch* scratch) {
  for (int32_t row = 0; row < rect.height; ++row) {
    std::memcpy(At(out, rect, row),
                engine.input.centre.Row(rect.y + row) + 3 * static_cast<size_t>(rect.x),
                3 * static_cast<size_t>(rect.width));
  }
  scratch->counts.copied_pixels += Samples(rect) / 3;
  starfocus_layer_report& report = scratch->counts.layers[block.layer];
  report.views += 1;
  report.rendered_samples += Samples(rect);
}

void RefocusViews(const EngineState& engine, const Block& block, const Plane<uint8_t>& out,
                  Scratch* scratch) {
  const Lens& lens = engine.lens;
  const ViewGrid grid = ViewGridOf(engine, block, scratch->aperture_weights);
  const BlockCells cells = {&engine.stripe.plan.gathered, block.rect, block.layer};
  const BlockCells* const gathered = block.gathers ? &cells : nullptr;
  const RenderJob job = {&engine.input,
                         block.layer,
                         &grid,
                         block.rendered,
                         block.border,
                         &scratch->cancel,
                         gathered,
                         lens.r_max,
                         IsBenchmark(lens),
                         &scratch->counts.layers[block.layer]};
  // If some cells of a block at layer 1 or 2 are blurred without views, GatherBlock upsamples the
  // whole block later.
  const bool in_part = block.layer > 0 && block.gathers;
  const bool copies = !block.has_highlights && !in_part &&
                      (WeightsOf(lens, block.n).n == 0 || lens.renderer->nothing_moves(job));
  if (!copies) return Render(engine, block, job, out, scratch);
  // At layer 0 the part that is rendered from views may be smaller than the block.
  CopyBlock(engine, block, block.layer == 0 ? block.rendered : block.rect, out, scratch);
}

// Not inlined, for the same reason as RenderExcess.
[[gnu::noinline]] void BlurBlock(const EngineState& engine, const Block& block,
                                 const Plane<uint8_t>& out, Scratch* scratch) {
  const auto blur = [&](const Input& input) {
    const BlurJob job = {&input,     engine.lens.scale, engine.tables->psfs,
                         block.rect, block.border.left, &scratch->cancel};
    BlurRectangle(job, scratch->block_rgb, scratch->sums, At(out, block.rect, 0), out.stride);
  };
  blur(engine.input);
  if (block.has_highlights) {
    blur(ExcessOf(engine.input, engine.config.highlights, scratch->lamp_lengths));
  }
}

}  // namespace

ViewGrid ViewGridOf(const EngineState& engine, const Block& block, uint16_t* weights) {
  const Lens& lens = engine.lens;
  const ViewWeights& aperture = WeightsOf(lens, block.n);
  // With N = 0 a block shows the centre view alone. To render the centre view, the weights of N = 1
  // are used, and grid.step = 0 moves all views to the centre.
  const bool pinhole = aperture.n == 0;
  const ViewWeights& whole = pinhole ? lens.weights_by_n[1] : aperture;
  const ApertureShape& opening = engine.tables->opening;
  const ViewWeights rendered =
      opening.cats_eye > 0
          ? MakeCatsEye(whole, opening,
                        ShiftOfRim(opening, block.rect, engine.config.width, engine.config.height),
                        weights)
          : whole;
  ViewGrid grid =
      MakeViewGrid(rendered, lens.scale.focus, lens.params.aperture * rendered.extent, block.layer);
  if (pinhole) grid.step = 0;
  return grid;
}

void RefocusBlock(const EngineState& engine, const Block& block, const Plane<uint8_t>& out,
                  Scratch* scratch) {
  const starfocus_observer& observer = engine.observer;
  const uint64_t start = observer.clock != nullptr ? observer.clock(observer.clock_data) : 0;
  starfocus_layer_report& report = scratch->counts.layers[block.layer];
  if (IsPinhole(engine.lens)) {
    CopyBlock(engine, block, block.rect, out, scratch);
  } else if (engine.lens.params.mode == STARFOCUS_MODE_BLUR) {
    BlurBlock(engine, block, out, scratch);
  } else {
    if (block.rendered.width > 0) {
      RefocusViews(engine, block, out, scratch);
    } else {
      report.views += 1;  // a block blurred entirely without views counts as one view
    }
    // Rendering runs first, because the rendered rectangle may contain cells that GatherBlock
    // overwrites.
    if (block.gathers) GatherBlock(engine, block, out, scratch);
  }
  report.blocks += 1;
  report.pixels += Samples(block.rect) / 3;
  report.predicted_ps += block.cost;
  if (observer.clock != nullptr) {
    report.measured_ns += observer.clock(observer.clock_data) - start;
  }
}

}  // namespace starfocus
