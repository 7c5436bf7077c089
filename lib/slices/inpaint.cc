// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/inpaint.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

class HiddenFiller {
 public:
  HiddenFiller(const simd::Kernels& kernels, int32_t layer, const FillScratch& scratch,
               LayeredDepth* surfaces)
      : kernels_(kernels),
        scratch_(scratch),
        surfaces_(*surfaces),
        stride_(FillStride(static_cast<size_t>(surfaces->width))),
        unit_(static_cast<int16_t>(1 << (kDisparityBits + layer))) {}

  void Fill() {
    const int32_t height = surfaces_.height;
    for (int32_t y = 0; y < height; ++y) CopyRow(y);
    Separate(RowAt(height));
    for (int32_t y = 0; y < height; ++y) CopySources(y);
    for (int32_t step = kFillStep; step > 0; step /= 2) {
      Pass(step,
           [&](const simd::FarRows& rows, int16_t* out) { kernels_.SmoothFar(rows, step, out); });
    }
    Pass(1, [&](const simd::FarRows& rows, int16_t* out) { kernels_.LimitFar(rows, out); });
    for (int32_t y = 0; y < height; ++y) {
      if (scratch_.farthest[y] != 0) PutRow(y);
    }
  }

 private:
  static size_t Column(int32_t x) { return static_cast<size_t>(kFillStep + x); }
  size_t RowAt(int32_t y) const { return static_cast<size_t>(y) * stride_; }
  int16_t* Colours(int32_t y) const { return scratch_.rgb + 3 * RowAt(y); }
  int16_t* Saved(int32_t y, int32_t step) const {
    return scratch_.saved + 3 * RowAt(y % (step + 1));
  }
  simd::FarRow FarOf(int32_t y) const {
    const size_t at = RowAt(y) + Column(0);
    return {scratch_.disparity + at, Colours(y) + Column(0), scratch_.source + at, stride_};
  }

  bool Takes(int32_t y, int32_t step) const { return step <= 2 * scratch_.farthest[y]; }

  // Sets the gap before a row of disparities to kNoSurface.
  void Separate(size_t at) const {
    for (size_t x = 0; x < Column(0); ++x) scratch_.disparity[at + x] = kNoSurface;
  }

  void CopyRow(int32_t y) {
    const size_t at = surfaces_.At(0, y);
    simd::SurfaceRow row = {};
    const uint16_t* source[simd::kSurfaces - 1];
    for (int k = 0; k < simd::kSurfaces; ++k) {
      row.disparity[k] = surfaces_.disparity[k] + at;
      row.rgb[k] = surfaces_.rgb[k] + at;
      if (k > 0) source[k - 1] = surfaces_.sources[k - 1] + at;
    }
    row.share = surfaces_.share + at;
    row.plane = surfaces_.plane;
    row.hiding = surfaces_.hiding[y];
    const int32_t farthest = kernels_.CopyFarthest(
        row, source, static_cast<size_t>(surfaces_.width), FarOf(y), &scratch_.strips[y]);
    Separate(RowAt(y));
    scratch_.farthest[y] = static_cast<uint8_t>(farthest);
  }

  void PutRow(int32_t y) {
    for (int k = 1; k < simd::kSurfaces; ++k) {
      const size_t at = surfaces_.At(0, y);
      kernels_.PutFarthest(FarOf(y), surfaces_.disparity[k] + at, scratch_.strips[y],
                           surfaces_.plane, surfaces_.rgb[k] + at);
    }
  }

  // Copies the colours of source pixels to all repeated pixels of a row.
  void CopySources(int32_t y) {
    if (scratch_.farthest[y] == 0) return;
    const uint16_t* const sources = scratch_.source + RowAt(y) + Column(0);
    int32_t first = 0;
    for (uint64_t strips = scratch_.strips[y]; strips != 0;
         strips >>= 1, first += simd::kStripColumns) {
      if ((strips & 1) == 0) continue;
      for (int32_t x = first; x < first + simd::kStripColumns; ++x) {
        if (sources[x] != 0) CopySource(x, y, sources[x]);
      }
    }
  }

  // Copies the colour of the source pixel to pixel (x, y). If the pixel has sources on several
  // sides, copies the mean of the sources. Copies nothing if a source itself repeats another pixel,
  // or belongs to another surface.
  void CopySource(int32_t x, int32_t y, uint32_t source) {
    const auto distance = static_cast<int32_t>(source >> simd::kSourceDistance);
    const int16_t disparity = scratch_.disparity[RowAt(y) + Column(x)];
    int32_t sums[3] = {0, 0, 0}, count = 0;
    bool same = true;
    ForEachBit(source & 15, [&](int32_t side) {
      const int32_t row = y + distance * kSides[side][1];
      const size_t column = Column(x + distance * kSides[side][0]), there = RowAt(row) + column;
      same = same && scratch_.source[there] == 0 && scratch_.disparity[there] == disparity;
      for (size_t c = 0; c < 3; ++c) sums[c] += Colours(row)[c * stride_ + column];
      ++count;
    });
    if (!same) return;
    for (size_t c = 0; c < 3; ++c) {
      Colours(y)[c * stride_ + Column(x)] = static_cast<int16_t>((sums[c] + count / 2) / count);
    }
  }

  // Calls change(rows, out) for all rows with colours that are repeated over a distance of at least
  // step / 2. It reads the colours that neighbours `step` pixels away had before the pass. The
  // old colours of a row are therefore saved until the row `step` rows below has been changed. At
  // the upper and lower end of the surfaces, the row itself replaces the missing neighbouring row.
  template <class Change>
  void Pass(int32_t step, const Change& change) {
    for (int32_t y = 0; y < surfaces_.height; ++y) {
      if (!Takes(y, step)) continue;
      const int32_t above = y >= step ? y - step : y, below = y + step;
      const int32_t next = below < surfaces_.height ? below : y;
      int16_t* const row = Colours(y);
      int16_t* const here = Saved(y, step);
      std::memcpy(here, row, 3 * stride_ * sizeof(*row));
      const int16_t* const first = scratch_.disparity + Column(0);
      const int16_t* const from = Takes(above, step) ? Saved(above, step) : Colours(above);
      const int16_t* const to = next == y ? here : Colours(next);
      change({{first + RowAt(above), first + RowAt(y), first + RowAt(next)},
              {from + Column(0), here + Column(0), to + Column(0)},
              stride_,
              scratch_.source + RowAt(y) + Column(0),
              scratch_.strips[y],
              unit_},
             row + Column(0));
    }
  }

  const simd::Kernels& kernels_;
  const FillScratch& scratch_;
  LayeredDepth& surfaces_;
  const size_t stride_;
  const int16_t unit_;  // disparity of a point that moves by one pixel in a view at distance 1
};

}  // namespace

void InpaintHidden(const simd::Kernels& kernels, int32_t layer, const FillScratch& scratch,
                   LayeredDepth* surfaces) {
  if (surfaces->repeats) HiddenFiller(kernels, layer, scratch, surfaces).Fill();
}

}  // namespace starfocus
