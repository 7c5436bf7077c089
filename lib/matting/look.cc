// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/look.h"

#include "lib/matting/far_light.h"

namespace starfocus {
namespace {

// Smallest difference of disparity at which a nearer surface occludes a farther surface,
// kDisparityBits.
constexpr int32_t kBefore = 1 << kDisparityBits;
// A nearer pixel may cover a far pixel in a view if the view shows the pixels at most 1.5 pixels
// apart (kDisparityBits). The limit exceeds one pixel because views are interpolated, and because
// strands are wider in views than in the map.
constexpr int32_t kWithin = 3 << (kDisparityBits - 1);

// log2 of the factor by which the weight of the centre view is reduced. Near edges, all pixels of
// the centre view are mixtures.
constexpr int kCentreBits = 3;
// At a pixel, the light of the far surface is fully known if the weights of its samples sum to at
// least 2^kEnoughBits * kKnown.
constexpr int kEnoughBits = 1;

// A side view from which the light of the far surface is read.
struct SideLook {
  OcclusionView look;
  bool down;      // True if the search for occluders runs along columns, false if along rows.
  int32_t along;  // Position of the view on the axis of the search, kViewBits.
  // Movement at right angles to the axis for each pixel of movement along the axis, kViewBits.
  int32_t slant;
};

class TileLooker {
 public:
  TileLooker(const CoverageInput& in, int32_t column, int32_t row)
      : kernels_(*in.input->kernels),
        input_(*in.input),
        map_(*in.map),
        left_(column * kCoverageTile),
        columns_(Min(kCoverageTile, map_.width - left_)) {
    for (int side = 0; side < kSideCount; ++side) {
      for (const OcclusionView& look : input_.occlusion_views.on[side]) AddView(look);
    }
    if (count_ > 0) FindBins(column, row);
  }

  void LookRow(int32_t y) {
    bool any = false;
    for (int32_t k = 0; k < kCoverageTile; ++k) {
      sums_[k] = {};
      far_[k] = map_.FarAt(left_ + k, y).disparity;
      parted_[k] = k < columns_ && map_.alpha[map_.At(left_ + k, y)] != kUnparted;
      any = any || parted_[k];
    }
    if (!any) return;
    int16_t light[3 * kCoverageTile];
    input_.Light(0, left_, y, columns_, light);
    for (int32_t k = 0; k < columns_; ++k) {
      Add(light + 3 * k, FarWeight(map_.first[map_.At(left_ + k, y)]) >> kCentreBits, &sums_[k]);
    }
    for (int view = 0; view < count_; ++view) LookInto(views_[view], y);
    for (int32_t k = 0; k < columns_; ++k) {
      if (parted_[k]) Store(sums_[k], &map_.FarAt(left_ + k, y));
    }
  }

 private:
  struct Sum {
    int32_t rgb[3], weight;
  };

  void AddView(const OcclusionView& look) {
    if (look.view == 0) return;
    for (int k = 0; k < count_; ++k) {
      if (views_[k].look.view == look.view) return;
    }
    const bool down = Abs(look.at.v) > Abs(look.at.u);
    const int32_t along = down ? look.at.v : look.at.u, across = down ? look.at.u : look.at.v;
    views_[count_++] = {look, down, along, across * kViewOne / along};
  }

  // Collects the disparities of near surfaces in and around the tile.
  void FindBins(int32_t column, int32_t row) {
    constexpr int32_t kAround = (kMostMove + kCoverageTile - 1) / kCoverageTile;
    for (int32_t y = row - kAround; y <= row + kAround; ++y) {
      for (int32_t x = column - kAround; x <= column + kAround; ++x) {
        if (map_.HasTile(x, y)) bins_ |= map_.Tile(x, y).near_bins;
      }
    }
  }

  static void Add(const int16_t* rgb, int32_t weight, Sum* sum) {
    for (int c = 0; c < 3; ++c) sum->rgb[c] += weight * rgb[c];
    sum->weight += weight;
  }

  static void Store(const Sum& sum, FarCell* cell) {
    cell->weight = static_cast<int16_t>(Min(sum.weight >> kEnoughBits, kKnown));
    for (int c = 0; c < 3 && sum.weight > 0; ++c) {
      cell->rgb[c] = static_cast<int16_t>((sum.rgb[c] + sum.weight / 2) / sum.weight);
    }
  }

  // Reads the light of the far surface in row y from a view, and adds the light to sums_. Adjacent
  // pixels of equal disparity are read together.
  void LookInto(const SideLook& view, int32_t y) {
    int16_t covered[kCoverageTile] = {};
    if (!FindCovered(view, y, covered)) return;
    for (int32_t k = 0, end; k < columns_; k = end) {
      end = k + 1;
      if (!parted_[k]) continue;
      while (end < columns_ && parted_[end] && far_[end] == far_[k]) ++end;
      int32_t all = 0, weights[kCoverageTile];
      for (int32_t n = k; n < end; ++n) all |= weights[n] = FarWeight(covered[n]);
      if (all == 0) continue;
      constexpr int kBits = kViewBits + kDisparityBits - kShiftBits;
      const CapturedLine line = {
          (left_ + k) * kShiftOne - ScaledByView(view.look.at.u, far_[k], kBits),
          y * kShiftOne - ScaledByView(view.look.at.v, far_[k], kBits), 1, 0};
      int16_t light[3 * kCoverageTile];
      ReadCaptured(input_, 0, view.look.view, line, end - k, light);
      for (int32_t n = k; n < end; ++n) Add(light + 3 * (n - k), weights[n], &sums_[n]);
    }
  }

  // Finds, for each pixel of a row, an upper bound of the coverage by nearer surfaces in the view.
  // Returns false if a nearer surface may move by more than kMostMove pixels.
  bool FindCovered(const SideLook& view, int32_t y, int16_t* covered) const {
    // comes[m]: true if a nearer surface may move onto the row from m pixels away.
    bool comes[kMostMove + 1] = {};
    if (!FindMoves(view, comes)) return false;
    const int32_t sign = view.along < 0 ? -1 : 1;
    for (int32_t m = 0; m <= kMostMove; ++m) {
      if (comes[m]) CoverFrom(view, y, sign * m, covered);
    }
    return true;
  }

  bool FindMoves(const SideLook& view, bool* comes) const {
    const int32_t size = Abs(view.along);
    int32_t nearest_far = INT16_MAX, farthest_far = INT16_MIN;
    for (int32_t k = 0; k < columns_; ++k) {
      if (!parted_[k]) continue;
      nearest_far = Min(nearest_far, far_[k]);
      farthest_far = Max(farthest_far, far_[k]);
    }
    for (int bin = 0; bin < 64; ++bin) {
      if ((bins_ >> bin & 1) == 0) continue;
      const int32_t low = map_.disparity_min + (bin << map_.bin_bits);
      const int32_t high = low + (1 << map_.bin_bits) - 1;
      if (high - nearest_far <= kBefore) continue;
      const int32_t least = Max(low - farthest_far, kBefore), most = high - nearest_far;
      const int32_t first = ((least * size >> kViewBits) - kWithin) >> kDisparityBits;
      const int32_t last = (((most * size >> kViewBits) + kWithin) >> kDisparityBits) + 1;
      if (last > kMostMove) return false;
      for (int32_t m = Max(0, first); m <= last; ++m) comes[m] = true;
    }
    return true;
  }

  // Updates `covered` with the surfaces that may move onto row y from a distance of `m` pixels
  // along the view's axis.
  void CoverFrom(const SideLook& view, int32_t y, int32_t m, int16_t* covered) const {
    // Movements have kDisparityBits - 1 fractional bits, because the SIMD kernel interprets `along`
    // with 15 fractional bits and kViewOne has 14.
    const simd::CoverView cover = {
        static_cast<int16_t>(view.along), static_cast<int16_t>(m * (1 << (kDisparityBits - 1))),
        static_cast<int16_t>(kWithin / 2), static_cast<int16_t>(kBefore)};
    const auto across = static_cast<int32_t>(RoundShift(int64_t{m} * view.slant, kViewBits));
    for (int32_t beside = across - 1; beside <= across + 1; ++beside) {
      const int32_t dx = view.down ? beside : m, row = y + (view.down ? m : beside);
      if (row < 0 || row >= map_.height) continue;
      const size_t at = map_.At(left_ + dx, row);
      kernels_.CoverPlaces(map_.near + at, map_.first + at, far_, cover, covered);
    }
  }

  const simd::Kernels& kernels_;
  const Input& input_;
  const CoverageMap& map_;
  const int32_t left_, columns_;
  SideLook views_[kSideCount * kOcclusionViews];
  int count_ = 0;
  uint64_t bins_ = 0;
  // State of one row of the tile.
  int16_t far_[kCoverageTile];  // disparity of the far surface at each pixel of the row
  bool parted_[kCoverageTile];
  Sum sums_[kCoverageTile];
};

}  // namespace

void LookBehindTile(const CoverageInput& in, int32_t column, int32_t row) {
  TileLooker looker(in, column, row);
  const int32_t end = Min((row + 1) * kCoverageTile, in.map->height);
  for (int32_t y = row * kCoverageTile; y < end; ++y) looker.LookRow(y);
  PullTile(column, row, *in.map);
}

}  // namespace starfocus
