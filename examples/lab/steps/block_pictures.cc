// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <vector>

#include "examples/lab/steps/step_pictures.h"
#include "lib/engine/stripe.h"
#include "lib/slices/compositor.h"
#include "lib/slices/slice_plane.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

// Colours of consecutive slices.
constexpr uint8_t kSliceColours[][3] = {
    {228, 40, 40},  {250, 140, 30}, {240, 225, 50}, {150, 210, 50}, {40, 150, 60},   {60, 210, 180},
    {60, 170, 240}, {50, 80, 210},  {130, 60, 190}, {225, 80, 200}, {250, 170, 190}, {130, 90, 60}};
constexpr uint8_t kNearer[3] = {255, 205, 40}, kFarther[3] = {40, 90, 255};
constexpr uint8_t kBlack[3] = {0, 0, 0};

// Returns the colour of a slice. Slices of one disparity have one colour in all blocks.
const uint8_t (&ColourOf(const Slice& slice))[3] {
  constexpr int kColourRange = 3 << kDisparityBits >> 3;  // 3/8 of a pixel of disparity.
  constexpr auto kCount = static_cast<int>(std::size(kSliceColours));
  const int number = (slice.disparity - INT16_MIN) / kColourRange;
  return kSliceColours[number % kCount];
}

uint8_t* PixelOf(Image* picture, int32_t x, int32_t y) { return picture->row(y) + 3 * x; }

void TurnGrey(uint8_t* pixel) {
  const int grey = (77 * pixel[0] + 150 * pixel[1] + 29 * pixel[2] + 128) >> 8;
  std::fill_n(pixel, 3, static_cast<uint8_t>(grey));
}

// Weights of the views, which are 0 for all views except the rightmost view of the lens. N is the
// largest N that every engine has memory for, so that the subaperture of the view is narrow.
class RightmostView {
 public:
  explicit RightmostView(const ApertureShape& opening) {
    const int32_t n = ViewsBySubaperture(STARFOCUS_MAX_BLUR, DemandOf(opening));
    memory_.resize(FullApertureSize(n));
    weights_ = MakeSubapertures(n, opening, memory_.data());
    std::fill(memory_.begin(), memory_.end(), uint16_t{0});
    weights_.full = true;
    weights_.views = 1;
    weights_.sum_bits = 15;
    memory_[static_cast<size_t>((weights_.last + n) * (2 * n + 1) + n)] = 1 << 15;
  }
  const ViewWeights& weights() const { return weights_; }

 private:
  std::vector<uint16_t> memory_;
  ViewWeights weights_;
};

// A row of RGB light values, with the padding that SIMD kernels require.
using LightRow = std::vector<int16_t>;
LightRow MakeRow(int32_t width) {
  return LightRow(3 * static_cast<size_t>(width) + simd::kPadding);
}

// Draws one block from the data that rendering leaves in the scratch memory of a worker.
class BlockArtist {
 public:
  BlockArtist(const PlannedBlock& planned, StepPictures* pictures)
      : planned_(planned),
        engine_(planned.engine),
        rect_(planned.block.rect),
        input_(engine_.input),
        memory_(
            static_cast<CompositorScratch*>(engine_.scratch[0].renderers[kSliceRenderer.index])),
        grid_(ViewGridOf(engine_, planned_.block, engine_.scratch[0].aperture_weights)),
        job_{&input_,
             0,
             &grid_,
             rect_,
             planned_.block.border,
             nullptr,
             nullptr,
             engine_.lens.r_max,
             false,
             &counts_},
        pictures_(*pictures) {}

  void Draw() {
    Render(job_);
    DrawSlices();
    LightRow hidden = MakeRow(rect_.width), mean = hidden;
    for (int32_t y = 0; y < rect_.height; ++y) {
      ReadHidden(y, &hidden);
      Encode(hidden, y, &pictures_.hidden);
      ReadMean(y, &mean);
      Encode(mean, y, &pictures_.mean);
      for (int32_t x = 0; x < rect_.width; ++x) DrawPixel(x, y);
    }
    DrawView();
  }

 private:
  // Renders the views of the job. The scratch memory then contains the surfaces of the block.
  void Render(const RenderJob& job) {
    kSliceRenderer.render(job, memory_, engine_.scratch[0].sums);
  }

  void DrawView() {
    const RightmostView view(engine_.tables->opening);
    const ViewWeights& weights = view.weights();
    const FullParams& lens = engine_.lens.params;
    const ViewGrid grid = MakeViewGrid(weights, grid_.focus, lens.aperture * weights.extent, 0);
    RenderJob job = job_;
    job.grid = &grid;
    Render(job);
    const size_t samples = 3 * static_cast<size_t>(rect_.width);
    for (int32_t y = 0; y < rect_.height; ++y) {
      engine_.kernels->Finish(engine_.scratch[0].sums + static_cast<size_t>(y) * samples, samples,
                              kSliceRenderer.sum_bits(weights), *input_.transfer,
                              PixelOf(&pictures_.view, rect_.x, rect_.y + y));
    }
  }

  // Returns the index in the surfaces of pixel (x, y) of the block.
  size_t At(int32_t x, int32_t y) const {
    const Border& border = planned_.block.border;
    return memory_->surfaces.At(border.left + x, border.top + y);
  }

  // Returns the index of the first hidden surface behind the pixel, or 0 if no surface is hidden.
  // Skips surfaces within kMostCopy of the visible disparity, because these are copies that close
  // gaps in the visible surface.
  int FirstHidden(int32_t x, int32_t y) const {
    const LayeredDepth& surfaces = memory_->surfaces;
    const Border& border = planned_.block.border;
    const int32_t strip = (border.left + x) / simd::kStripColumns;
    if ((surfaces.hiding[border.top + y] >> strip & 1) == 0) return 0;
    const size_t at = At(x, y);
    for (int k = 1; k < simd::kSurfaces && surfaces.disparity[k][at] != kNoSurface; ++k) {
      if (surfaces.disparity[0][at] - surfaces.disparity[k][at] > kMostCopy) return k;
    }
    return 0;
  }

  void ReadHidden(int32_t y, LightRow* row) const {
    const LayeredDepth& surfaces = memory_->surfaces;
    for (int32_t x = 0; x < rect_.width; ++x) {
      const int16_t* const light = surfaces.rgb[FirstHidden(x, y)] + At(x, y);
      for (size_t c = 0; c < 3; ++c) {
        (*row)[3 * static_cast<size_t>(x) + c] = light[c * surfaces.plane];
      }
    }
  }

  // Reads the mean of the captured views. View (u, v) shows a point in focus at
  // (x - u * focus, y - v * focus).
  void ReadMean(int32_t y, LightRow* mean) const {
    constexpr int kBits = kViewBits + kDisparityBits - kShiftBits;
    ViewSet views;
    FindViews(engine_.config.views, engine_.config.positions, engine_.config.problem, &views);
    const int32_t count = views.count;
    std::vector<int32_t> sums(mean->size());
    LightRow row = MakeRow(rect_.width);
    for (int32_t view = 0; view < count; ++view) {
      const ViewPosition& at = views.at[view];
      const CapturedLine line = {
          rect_.x * kShiftOne - ScaledByView(at.u, grid_.focus.far, kBits),
          (rect_.y + y) * kShiftOne - ScaledByView(at.v, grid_.focus.far, kBits), 1, 0};
      ReadCaptured(input_, 0, view, line, rect_.width, row.data());
      for (size_t k = 0; k < row.size(); ++k) sums[k] += row[k];
    }
    for (size_t k = 0; k < row.size(); ++k) {
      (*mean)[k] = static_cast<int16_t>((sums[k] + count / 2) / count);
    }
  }

  void Encode(const LightRow& row, int32_t y, Image* picture) const {
    engine_.kernels->Encode(row.data(), 3 * static_cast<size_t>(rect_.width), *input_.transfer,
                            PixelOf(picture, rect_.x, rect_.y + y));
  }

  // Tints the pixels of each tile by the slices that the compositor makes for this tile.
  void DrawSlices() {
    Rect tile = {0, 0, 0, 0};
    for (; tile.y < rect_.height; tile.y += tile.height) {
      tile.height = SideOfBucket(rect_.height - tile.y);
      for (tile.x = 0; tile.x < rect_.width; tile.x += tile.width) {
        tile.width = SideOfBucket(rect_.width - tile.x);
        DrawSlicesOf(tile);
      }
    }
  }

  void DrawSlicesOf(const Rect& tile) {
    const Border& border = planned_.block.border;
    const Rect in_surfaces = {border.left + tile.x, border.top + tile.y, tile.width, tile.height};
    Slice slices[kMaxSlices];
    const int32_t count = FindSlices(*job_.input->kernels, memory_->surfaces, grid_,
                                     SliceRuleOf(job_), in_surfaces, slices);
    for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
      for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
        const int16_t disparity = memory_->surfaces.disparity[0][At(x, y)];
        const auto slice = std::find_if(slices, slices + count,
                                        [&](const Slice& one) { return one.low <= disparity; });
        uint8_t* const pixel = PixelOf(&pictures_.slices, rect_.x + x, rect_.y + y);
        TurnGrey(pixel);
        Tint(ColourOf(*slice), 65, pixel);
      }
    }
  }

  void DrawPixel(int32_t x, int32_t y) {
    const int32_t left = rect_.x + x, top = rect_.y + y;
    if (FirstHidden(x, y) == 0) {
      uint8_t* const hidden = PixelOf(&pictures_.hidden, left, top);
      std::copy_n(planned_.light_field.views[0].row(top) + 3 * left, 3, hidden);
      TurnGrey(hidden);
    }
    uint8_t* const matte = PixelOf(&pictures_.matte, left, top);
    const int share = memory_->surfaces.share[At(x, y)];
    if (share < simd::kSliceWhole) {
      std::copy_n(kFarther, 3, matte);
      Tint(kNearer, 100 * share / simd::kSliceWhole, matte);
    } else {
      TurnGrey(matte);
      Tint(kBlack, 60, matte);
    }
    DrawCoverage(left, top);
  }

  void DrawCoverage(int32_t x, int32_t y) {
    uint8_t* const pixel = PixelOf(&pictures_.coverage, x, y);
    const CoverageMap& map = *input_.coverage;
    const int alpha = map.alpha[map.At(x, y)];
    if (map.Tile(x / kCoverageTile, y / kCoverageTile).thin != 0 && alpha != kUnsplit) {
      std::fill_n(pixel, 3, static_cast<uint8_t>(alpha * 255 / kWhole));
    } else {
      Tint(kFarther, 40, pixel);
      Tint(kBlack, 50, pixel);
    }
  }

  const PlannedBlock& planned_;
  const EngineState& engine_;
  const Rect& rect_;
  const Input& input_;
  CompositorScratch* const memory_;
  const ViewGrid grid_;                 // Grid of the engine.
  starfocus_layer_report counts_ = {};  // not shown
  const RenderJob job_;                 // The engine's job for this block.
  StepPictures& pictures_;
};

}  // namespace

void DrawRendered(const PlannedBlock& planned, StepPictures* pictures) {
  BlockArtist(planned, pictures).Draw();
}

void MarkGathered(const PlannedBlock& planned, StepPictures* pictures) {
  const Rect& rect = planned.block.rect;
  const BlockCells cells = {&planned.engine.stripe.plan.gathered, rect, planned.block.layer};
  if (!planned.block.gathers) return;
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x) {
      if (cells.IsGathered(x, y)) std::fill_n(PixelOf(&pictures->gathered, x, y), 3, uint8_t{255});
    }
  }
}

void Tint(const uint8_t (&colour)[3], int percent, uint8_t* pixel) {
  for (int c = 0; c < 3; ++c) {
    pixel[c] = static_cast<uint8_t>((colour[c] * percent + pixel[c] * (100 - percent) + 50) / 100);
  }
}

}  // namespace starfocus
