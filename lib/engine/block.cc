// SPDX-License-Identifier: Apache-2.0
// Refocuses one block: renders its views, or blurs it without views, and upsamples the result from
// its layer to the picture.
#include <cstring>

#include "lib/engine/stripe.h"
#include "lib/gather/depth_blur.h"
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

const simd::Encoding& EncodingOf(const BlockInputs& in) { return *in.input->transfer; }

void FinishPicture(const BlockInputs& in, const Rect& rect, int shift, const Plane<uint8_t>& out,
                   const Scratch& scratch) {
  const size_t samples = 3 * static_cast<size_t>(rect.width);
  CheckSums(scratch.sums, Samples(rect), shift);
  for (int32_t row = 0; row < rect.height; ++row) {
    in.input->kernels->Finish(scratch.sums + static_cast<size_t>(row) * samples, samples, shift,
                              EncodingOf(in), At(out, rect, row));
  }
}

// Converts the sums of a block to samples of the block's layer, and stores the samples at their
// position in LayerFrame.
void KeepLayer(const BlockInputs& in, const Block& block, int shift, const Scratch& scratch) {
  const Rect frame = LayerFrame(block.rect, block.layer), &rendered = block.rendered;
  const size_t samples = 3 * static_cast<size_t>(rendered.width);
  CheckSums(scratch.sums, Samples(rendered), shift);
  for (int32_t row = 0; row < rendered.height; ++row) {
    const size_t pixel =
        static_cast<size_t>(rendered.y - frame.y + row) * static_cast<size_t>(frame.width) +
        static_cast<size_t>(rendered.x - frame.x);
    in.input->kernels->FinishLayer(scratch.sums + static_cast<size_t>(row) * samples, samples,
                                   shift, scratch.layer_samples + 3 * pixel);
  }
}

// Upsamples a block from its layer to the picture. Layer 2 is upsampled through layer 1, including
// the margin that the second upsampling step reads.
void FinishLayer(const BlockInputs& in, const Block& block, const Plane<uint8_t>& out,
                 const Scratch& scratch) {
  const simd::Kernels& kernels = *in.input->kernels;
  const Rect frame = LayerFrame(block.rect, block.layer);
  CheckAll(ranges::kLayerSample, scratch.layer_samples, Samples(frame));
  LayerRect layer = {scratch.layer_samples, frame.width, frame.height};
  int32_t margin = LayerMargin(block.layer);
  if (block.layer == 2) {
    const int32_t next_margin = LayerMargin(1);
    const LayerRect middle = {scratch.middle_samples,
                              ((block.rect.width + 1) >> 1) + 2 * next_margin,
                              ((block.rect.height + 1) >> 1) + 2 * next_margin};
    UpsampleByTwo(kernels, layer, margin - next_margin / 2, scratch.upsample, middle);
    layer = middle;
    margin = next_margin;
  }
  const LayerRect picture = {scratch.picture_samples, block.rect.width, block.rect.height};
  UpsampleByTwo(kernels, layer, margin, scratch.upsample, picture);
  const size_t samples = 3 * static_cast<size_t>(block.rect.width);
  for (int32_t row = 0; row < block.rect.height; ++row) {
    kernels.Narrow(picture.samples + static_cast<size_t>(row) * samples, samples, EncodingOf(in),
                   At(out, block.rect, row));
  }
}

void CopyCentre(const Input& input, const Rect& rect, const Plane<uint8_t>& out) {
  for (int32_t row = 0; row < rect.height; ++row) {
    std::memcpy(At(out, rect, row),
                input.centre.Row(rect.y + row) + 3 * static_cast<size_t>(rect.x),
                3 * static_cast<size_t>(rect.width));
  }
}

// Number of views rendered for a block, and number of samples of all these views together.
struct Rendered {
  uint64_t views, samples;
};

// Renders the views of a job into the worker's sums. Returns the number of samples of a view.
uint64_t RenderSums(const BlockInputs& in, const RenderJob& job, Scratch* scratch) {
  const Renderer& renderer = *in.lens->renderer;
  return renderer.render(job, scratch->renderers[renderer.index], scratch->sums);
}

// Returns the fractional bits of the sums of RenderSums.
int SumBits(const BlockInputs& in, const RenderJob& job) {
  return in.lens->renderer->sum_bits(job.grid->aperture);
}

// Renders the light of highlights beyond white and adds this light to the block. Returns the number
// of samples of a view. Not inlined, because its Input of more than 1 KiB would lie on the stack
// under every block.
[[gnu::noinline]] uint64_t RenderExcess(const BlockInputs& in, RenderJob job,
                                        const Plane<uint8_t>& out, Scratch* scratch) {
  const Input excess = ExcessOf(*in.input, in.config->highlights, scratch->lamp_runs);
  job.input = &excess;
  const uint64_t samples = RenderSums(in, job, scratch);
  if (!scratch->cancel.Spend(0)) return 0;
  const size_t row_samples = 3 * static_cast<size_t>(job.rect.width);
  for (int32_t row = 0; row < job.rect.height; ++row) {
    AddExcess(excess, scratch->sums + static_cast<size_t>(row) * row_samples, row_samples,
              SumBits(in, job), At(out, job.rect, row));
  }
  return samples;
}

Rendered Render(const BlockInputs& in, const Block& block, const RenderJob& job,
                const Plane<uint8_t>& out, Scratch* scratch) {
  uint64_t samples = RenderSums(in, job, scratch);
  if (!scratch->cancel.Spend(0)) return {0, 0};  // after cancellation, the sums are incomplete
  if (block.layer == 0) {
    FinishPicture(in, job.rect, SumBits(in, job), out, *scratch);
  } else {
    KeepLayer(in, block, SumBits(in, job), *scratch);
    if (!block.gathers) FinishLayer(in, block, out, *scratch);
  }
  if (block.has_highlights) samples += RenderExcess(in, job, out, scratch);
  const auto views = static_cast<uint64_t>(WeightsOf(*in.lens, block.n).views);
  return {views, views * samples};
}

// Blurs the cells of a block that need no views (gathering), and writes the completed block to the
// picture.
void GatherBlock(const BlockInputs& in, const Block& block, const Plane<uint8_t>& out,
                 Scratch* scratch) {
  BlockPixels field;
  field.rgb = scratch->field_rgb;
  field.disparity = scratch->field_disparity;
  const BlockCells cells = {in.gathered, block.rect, block.layer};
  const Tables& tables = *in.tables;
  const GatherJob job = {in.input,           in.cells,        cells,
                         in.lens->scale,     tables.psfs,     LastGatherStep(*in.lens),
                         tables.mean_square, &scratch->cancel};
  const Rect frame = LayerFrame(block.rect, block.layer);
  const size_t stride = block.layer == 0 ? out.stride : 3 * static_cast<size_t>(frame.width);
  scratch->counts.gathered_pixels +=
      GatherCells(job, &field, At(out, block.rect, 0), scratch->layer_samples, stride);
  if (block.layer > 0 && scratch->cancel.Spend(0)) FinishLayer(in, block, out, *scratch);
}

// Returns the part of a block that is rendered from views. At layer 0 this part may be smaller than
// the block.
const Rect& ViewsRect(const Block& block) { return block.layer == 0 ? block.rendered : block.rect; }

// Copies `rect`, in which no view moves a pixel, from the centre view.
Rendered CopyBlock(const BlockInputs& in, const Rect& rect, const Plane<uint8_t>& out,
                   Scratch* scratch) {
  const uint64_t samples = Samples(rect);
  CopyCentre(*in.input, rect, out);
  scratch->counts.copied_pixels += samples / 3;
  return {1, samples};
}

Rendered RefocusViews(const BlockInputs& in, const Block& block, const Plane<uint8_t>& out,
                      Scratch* scratch) {
  const Lens& lens = *in.lens;
  const ViewGrid grid = ViewGridOf(in, block, scratch->aperture_weights);
  const BlockCells cells = {in.gathered, block.rect, block.layer};
  const BlockCells* const gathered = block.gathers ? &cells : nullptr;
  const RenderJob job = {in.input,         block.layer, &grid,      block.rendered,   block.border,
                         &scratch->cancel, gathered,    lens.r_max, IsBenchmark(lens)};
  // If some cells of a block at layer 1 or 2 are blurred without views, GatherBlock upsamples the
  // whole block later.
  const bool in_part = block.layer > 0 && block.gathers;
  const bool copies = !block.has_highlights && !in_part &&
                      (WeightsOf(lens, block.n).n == 0 || lens.renderer->nothing_moves(job));
  return copies ? CopyBlock(in, ViewsRect(block), out, scratch)
                : Render(in, block, job, out, scratch);
}

// Not inlined, for the same reason as RenderExcess.
[[gnu::noinline]] void BlurBlock(const BlockInputs& in, const Block& block,
                                 const Plane<uint8_t>& out, Scratch* scratch) {
  const auto blur = [&](const Input& input) {
    const BlurJob job = {&input,     in.lens->scale,    in.tables->psfs,
                         block.rect, block.border.left, &scratch->cancel};
    BlurRectangle(job, scratch->field_rgb, scratch->sums, scratch->spans, At(out, block.rect, 0),
                  out.stride);
  };
  blur(*in.input);
  if (block.has_highlights) {
    blur(ExcessOf(*in.input, in.config->highlights, scratch->lamp_runs));
  }
}

}  // namespace

ViewGrid ViewGridOf(const BlockInputs& in, const Block& block, uint16_t* weights) {
  const Lens& lens = *in.lens;
  const ViewWeights& aperture = WeightsOf(lens, block.n);
  // With N = 0 a block shows the centre view alone. To render the centre view, the weights of N = 1
  // are used, and grid.step = 0 moves all views to the centre.
  const bool pinhole = aperture.n == 0;
  const ViewWeights& whole = pinhole ? lens.apertures[1] : aperture;
  const ApertureShape& opening = in.tables->opening;
  const ViewWeights rendered =
      opening.cats_eye > 0
          ? MakeCatsEye(whole, opening,
                        ShiftOfRim(opening, block.rect, in.config->width, in.config->height),
                        weights)
          : whole;
  ViewGrid grid = MakeViewGrid(rendered, lens.scale.focus, lens.params.aperture * rendered.extent,
                               block.layer, in.config->views == 17);
  if (pinhole) grid.step = 0;
  return grid;
}

void RefocusBlock(const BlockInputs& in, const Block& block, const Plane<uint8_t>& out,
                  Scratch* scratch) {
  const starfocus_observer& observer = *in.observer;
  const uint64_t start = observer.clock != nullptr ? observer.clock(observer.clock_data) : 0;
  Rendered rendered = {1, 0};  // a block blurred entirely without views counts as one view
  if (IsPinhole(*in.lens)) {
    rendered = CopyBlock(in, block.rect, out, scratch);
  } else if (in.lens->params.mode == STARFOCUS_MODE_BLUR) {
    BlurBlock(in, block, out, scratch);
    rendered = {0, 0};
  } else {
    if (block.rendered.width > 0) {
      rendered = RefocusViews(in, block, out, scratch);
    }
    // Rendering runs first, because the rendered rectangle may contain cells that GatherBlock
    // overwrites.
    if (block.gathers) GatherBlock(in, block, out, scratch);
  }
  starfocus_layer_report& report = scratch->counts.layers[block.layer];
  report.blocks += 1;
  report.pixels += Samples(block.rect) / 3;
  report.views += rendered.views;
  report.rendered_samples += rendered.samples;
  report.predicted_ps += block.cost;
  if (observer.clock != nullptr) {
    report.measured_ns += observer.clock(observer.clock_data) - start;
  }
}

}  // namespace starfocus
