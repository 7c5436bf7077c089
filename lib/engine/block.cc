// SPDX-License-Identifier: Apache-2.0
// Refocuses one block: renders its views, or blurs it without views, and upsamples the result from
// its layer to the picture.
#include <algorithm>
#include <cstring>

#include "lib/engine/stripe.h"
#include "lib/gather/gather.h"
#include "lib/io/deep.h"
#include "lib/io/highlights.h"

namespace starfocus {
namespace {

// A pass over a block.
struct BlockPass {
  const EngineState& engine;
  const Block& block;
  const Input& input;  // of the pass
  Pass pass;
  const PictureRows& out;
  Scratch* scratch;

  // Returns true if the pass writes codes, which kernels encode.
  bool writes_codes() const { return pass == kLightPass && !out.is_deep(); }
};

size_t Samples(const Rect& rect) {
  return 3 * static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height);
}

uint8_t* At(const Plane<uint8_t>& out, const Rect& rect, int32_t row) {
  return out.Row(rect.y + row) + 3 * static_cast<size_t>(rect.x);
}

// Stores `count` values of the light of a deep picture, from pixel (x, y) on: sums or samples with
// `bits` fractional bits more than light. Light replaces the stored values, and excess is added to
// them.
template <class T>
void StoreDeep(const BlockPass& p, const T* values, int bits, int32_t count, int32_t x, int32_t y) {
  // Samples of layers have one bit less than light, and excess is multiplied by up to
  // 2^kExcessBits.
  constexpr int kMore = kExcessBits + 2;
  const auto light = [&](int32_t n, int more) {
    const int drop = bits + more + kMore;
    return static_cast<int64_t>(
        ((static_cast<uint64_t>(values[n]) << kMore) + (uint64_t{1} << (drop - 1))) >> drop);
  };
  if (p.pass == kAlphaPass) {
    uint16_t* const alpha = p.out.alpha.Row(y) + x;
    for (int32_t n = 0; n < count; ++n) {
      alpha[n] = static_cast<uint16_t>(Min(static_cast<int32_t>(light(3 * n, 0)), kLightWhite));
    }
    return;
  }
  uint16_t* const rgb = p.out.deep.Row(y) + 3 * static_cast<ptrdiff_t>(x);
  if (p.pass == kLightPass) {
    for (int32_t n = 0; n < 3 * count; ++n) {
      if constexpr (sizeof(T) == 2) {
        rgb[n] = static_cast<uint16_t>(2 * values[n]);  // samples of layers, at most white
      } else {
        const auto sum = static_cast<int32_t>((values[n] + (T{1} << bits >> 1)) >> bits);
        rgb[n] = static_cast<uint16_t>(Min(sum, kLightWhite));
      }
    }
    return;
  }
  const int shift = p.input.excess_shift - kExcessBits;
  for (int32_t n = 0; n < 3 * count; ++n) {
    if (values[n] == 0) continue;
    rgb[n] = DeepOfLight(LightOfDeep(rgb[n]) + light(n, shift));
  }
}

// Stores rows of `rect` of the picture, from sums with `shift` fractional bits.
void StoreSums(const BlockPass& p, const uint32_t* sums, const Rect& rect, int shift) {
  const size_t samples = 3 * static_cast<size_t>(rect.width);
  for (int32_t row = 0; row < rect.height; ++row, sums += samples) {
    if (p.out.is_deep()) {
      StoreDeep(p, sums, shift - kLightBits, rect.width, rect.x, rect.y + row);
    } else if (p.pass == kExcessPass) {
      AddExcess(p.input, sums, samples, shift, At(p.out.codes, rect, row));
    } else {
      p.input.kernels->Finish(sums, samples, shift, *p.input.transfer, At(p.out.codes, rect, row));
    }
  }
}

// Stores rows of `rect` of the picture, from samples of layers (simd::kLayerBits), `stride` samples
// from row to row.
void StoreSamples(const BlockPass& p, const int16_t* samples, size_t stride, const Rect& rect) {
  const size_t count = 3 * static_cast<size_t>(rect.width);
  for (int32_t row = 0; row < rect.height; ++row, samples += stride) {
    if (p.writes_codes()) {
      p.input.kernels->Narrow(samples, count, *p.input.transfer, At(p.out.codes, rect, row));
      continue;
    }
    if (p.out.is_deep()) {
      StoreDeep(p, samples, simd::kLayerBits - kLightBits, rect.width, rect.x, rect.y + row);
      continue;
    }
    uint8_t* const codes = At(p.out.codes, rect, row);
    for (size_t n = 0, some = 0; n < count; n += some) {
      uint32_t sums[96], any = 0;
      some = std::min(count - n, sizeof sums / sizeof *sums);
      for (size_t k = 0; k < some; ++k) any |= sums[k] = static_cast<uint32_t>(samples[n + k]);
      if (any != 0) AddExcess(p.input, sums, some, simd::kLayerBits, codes + n);
    }
  }
}

// Converts the sums of a block to samples of the block's layer, and stores the samples at their
// position in LayerFrame.
void KeepLayer(const BlockPass& p, int shift) {
  const Rect frame = LayerFrame(p.block.rect, p.block.layer), &rendered = p.block.rendered;
  const size_t samples = 3 * static_cast<size_t>(rendered.width);
  CheckSums(p.scratch->sums, Samples(rendered), shift);
  for (int32_t row = 0; row < rendered.height; ++row) {
    const size_t pixel =
        static_cast<size_t>(rendered.y - frame.y + row) * static_cast<size_t>(frame.width) +
        static_cast<size_t>(rendered.x - frame.x);
    p.input.kernels->FinishLayer(p.scratch->sums + static_cast<size_t>(row) * samples, samples,
                                 shift, p.scratch->layer_samples + 3 * pixel);
  }
}

// Upsamples a block from its layer to the picture. Layer 2 is upsampled through layer 1, including
// the border that the second upsampling step reads.
void FinishLayer(const BlockPass& p) {
  const Block& block = p.block;
  const Scratch& scratch = *p.scratch;
  const simd::Kernels& kernels = *p.input.kernels;
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
  StoreSamples(p, picture.samples, 3 * static_cast<size_t>(block.rect.width), block.rect);
}

// Clears the sums of the cells that are blurred without views later, some of which views show too.
void ClearGathered(const BlockPass& p, const Rect& rect, uint32_t* sums) {
  const BlockCells cells = {&p.engine.stripe.plan.gathered, p.block.rect, 0};
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x, sums += 3) {
      if (cells.IsGathered(x, y)) sums[0] = sums[1] = sums[2] = 0;
    }
  }
}

// Renders the views of a block, and counts the rendered samples.
void Render(const BlockPass& p, const RenderJob& job) {
  const Lens& lens = p.engine.lens;
  const Renderer& renderer = *lens.renderer;
  uint32_t* const sums = p.scratch->sums;
  const uint64_t samples = renderer.render(job, p.scratch->renderers[renderer.index], sums);
  if (!p.scratch->cancel.Spend(0)) return;  // after cancellation, the sums are incomplete
  const int shift = renderer.sum_bits(job.grid->aperture);
  if (p.block.layer == 0) {
    CheckSums(sums, Samples(job.rect), shift);
    if (p.pass == kExcessPass && p.block.gathers) ClearGathered(p, job.rect, sums);
    StoreSums(p, sums, job.rect, shift);
  } else {
    KeepLayer(p, shift);
    if (!p.block.gathers) FinishLayer(p);
  }
  const auto views = static_cast<uint64_t>(WeightsOf(lens, p.block.n).views);
  starfocus_layer_report& report = p.scratch->counts.layers[p.block.layer];
  report.views += views;
  report.rendered_samples += views * samples;
}

// Stores the samples of the gathered cells of a block at layer 0, in rows of the block.
void StoreGathered(const BlockPass& p, const BlockCells& cells, const int16_t* samples) {
  const Rect& rect = p.block.rect;
  const size_t stride = 3 * static_cast<size_t>(rect.width);
  for (int32_t y = rect.y; y < rect.y + rect.height; y += kCellSize) {
    for (int32_t x = rect.x; x < rect.x + rect.width; x += kCellSize) {
      if (!cells.IsGathered(x, y)) continue;
      const Rect cell = {x, y, Min(kCellSize, rect.x + rect.width - x),
                         Min(kCellSize, rect.y + rect.height - y)};
      const size_t at =
          static_cast<size_t>(y - rect.y) * stride + 3 * static_cast<size_t>(x - rect.x);
      StoreSamples(p, samples + at, stride, cell);
    }
  }
}

// Blurs the cells of a block that need no views (gathering), and writes the completed block to the
// picture.
void GatherBlock(const BlockPass& p) {
  const EngineState& engine = p.engine;
  const Block& block = p.block;
  BlockPixels field;
  field.rgb = p.scratch->block_rgb;
  field.disparity = p.scratch->block_disparity;
  const BlockCells cells = {&engine.stripe.plan.gathered, block.rect, block.layer};
  const Tables& tables = *engine.tables;
  const GatherJob job = {&p.input,           &engine.stripe.cells, cells,
                         engine.lens.scale,  tables.psfs,          LastGatherPsf(engine.lens),
                         tables.mean_square, &p.scratch->cancel};
  const Rect frame = LayerFrame(block.rect, block.layer);
  size_t stride = 3 * static_cast<size_t>(frame.width);
  uint8_t* codes = nullptr;
  int16_t* samples = p.scratch->layer_samples;
  if (block.layer == 0 && p.writes_codes()) {
    stride = p.out.codes.stride;
    codes = At(p.out.codes, block.rect, 0);
  } else if (block.layer == 0) {
    samples = reinterpret_cast<int16_t*>(p.scratch->sums);  // which are stored already
  }
  p.scratch->counts.gathered_pixels += GatherCells(job, &field, codes, samples, stride);
  if (!p.scratch->cancel.Spend(0)) return;
  if (block.layer > 0) {
    FinishLayer(p);
  } else if (codes == nullptr) {
    StoreGathered(p, cells, samples);
  }
}

// Copies `rect` of a block, in which no view moves a pixel, from the centre view.
void CopyBlock(const EngineState& engine, const Block& block, const Rect& rect,
               const PictureRows& out, Scratch* scratch) {
  const Input& in = engine.input;
  const auto width = static_cast<size_t>(rect.width);
  const ptrdiff_t x = rect.x;
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    if (out.is_deep()) {
      std::memcpy(out.deep.Row(y) + 3 * x, in.deep_rows[0].Row(y) + 3 * x,
                  3 * width * sizeof(uint16_t));
      std::memcpy(out.alpha.Row(y) + x, in.deep_alpha[0].Row(y) + x, width * sizeof(uint16_t));
    } else {
      std::memcpy(out.codes.Row(y) + 3 * x, in.centre.Row(y) + 3 * x, 3 * width);
    }
  }
  scratch->counts.copied_pixels += Samples(rect) / 3;
  starfocus_layer_report& report = scratch->counts.layers[block.layer];
  report.views += 1;
  report.rendered_samples += Samples(rect);
}

// Sets the alpha of a block to opaque.
void FillAlpha(const Rect& rect, const PictureRows& out) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    std::fill_n(out.alpha.Row(y) + rect.x, rect.width, static_cast<uint16_t>(kLightWhite));
  }
}

void RefocusViews(const BlockPass& p) {
  const EngineState& engine = p.engine;
  const Block& block = p.block;
  const Lens& lens = engine.lens;
  const ViewGrid grid = ViewGridOf(engine, block, p.scratch->aperture_weights);
  const BlockCells cells = {&engine.stripe.plan.gathered, block.rect, block.layer};
  const BlockCells* const gathered = block.gathers ? &cells : nullptr;
  const RenderJob job = {&p.input,
                         block.layer,
                         &grid,
                         block.rendered,
                         block.border,
                         &p.scratch->cancel,
                         gathered,
                         lens.r_max,
                         IsBenchmark(lens),
                         &p.scratch->counts.layers[block.layer]};
  // If some cells of a block at layer 1 or 2 are blurred without views, GatherBlock upsamples the
  // whole block later.
  const bool in_part = block.layer > 0 && block.gathers;
  // Deep pixels are copied with their excess, but that of highlights must be added.
  const bool adds = !engine.input.is_deep() && block.passes[kExcessPass];
  const bool copies =
      !adds && !in_part && (WeightsOf(lens, block.n).n == 0 || lens.renderer->nothing_moves(job));
  if (!copies) return Render(p, job);
  if (p.pass != kLightPass) return;  // The copy has all light and the alpha.
  // At layer 0 the part that is rendered from views may be smaller than the block.
  CopyBlock(engine, block, block.layer == 0 ? block.rendered : block.rect, p.out, p.scratch);
}

void BlurBlock(const BlockPass& p) {
  const EngineState& engine = p.engine;
  const BlurJob job = {&p.input,     engine.lens.scale,   engine.tables->psfs,
                       p.block.rect, p.block.border.left, &p.scratch->cancel};
  BlurRectangle(job, p.scratch->block_rgb, p.scratch->sums,
                [&](const uint32_t* sums, const Rect& run, int bits) {
                  CheckSums(sums, Samples(run), bits);
                  StoreSums(p, sums, run, bits);
                });
}

// Not inlined, because it has two callers.
[[gnu::noinline]] void RefocusPass(const BlockPass& p) {
  if (p.engine.lens.params.mode == STARFOCUS_MODE_BLUR) return BlurBlock(p);
  if (p.block.rendered.width > 0) {
    RefocusViews(p);
  } else {
    // A block blurred entirely without views counts as one view.
    p.scratch->counts.layers[p.block.layer].views += 1;
  }
  // Rendering runs first, because the rendered rectangle may contain cells that GatherBlock
  // overwrites.
  if (p.block.gathers) GatherBlock(p);
}

// Not inlined, because its Input of more than 2 KiB would lie on the stack under every block.
[[gnu::noinline]] void RefocusOther(const EngineState& engine, const Block& block, Pass pass,
                                    const PictureRows& out, Scratch* scratch) {
  const Input input = InputOf(engine, pass, *scratch);
  RefocusPass({engine, block, input, pass, out, scratch});
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

void RefocusBlock(const EngineState& engine, const Block& block, const PictureRows& out,
                  Scratch* scratch) {
  const starfocus_observer& observer = engine.observer;
  const uint64_t start = observer.clock != nullptr ? observer.clock(observer.clock_data) : 0;
  starfocus_layer_report& report = scratch->counts.layers[block.layer];
  if (IsPinhole(engine.lens)) {
    CopyBlock(engine, block, block.rect, out, scratch);
  } else {
    if (out.is_deep()) FillAlpha(block.rect, out);
    RefocusPass({engine, block, engine.input, kLightPass, out, scratch});
    for (int pass = kExcessPass; pass < kPassCount; ++pass) {
      if (block.passes[pass]) RefocusOther(engine, block, static_cast<Pass>(pass), out, scratch);
    }
  }
  report.blocks += 1;
  report.pixels += Samples(block.rect) / 3;
  report.predicted_ps += block.cost;
  if (observer.clock != nullptr) {
    report.measured_ns += observer.clock(observer.clock_data) - start;
  }
}

}  // namespace starfocus
