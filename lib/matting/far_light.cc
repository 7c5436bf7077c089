// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/colour.h"
#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

// Returns a / b, rounded to the nearest integer; b > 0.
int64_t Rounded(int64_t a, int64_t b) { return (a + (a < 0 ? -(b / 2) : b / 2)) / b; }

using FourPatches = const FarLight* [4];

// Returns the disparity of the farthest patch with a nonzero weight; INT16_MAX if all weights are
// 0.
int32_t FarthestOf(const FourPatches& patches) {
  int32_t farthest = INT16_MAX;
  for (const FarLight* patch : patches) {
    if (patch->weight > 0) farthest = Min(farthest, patch->disparity);
  }
  return farthest;
}

// Returns the mean of the patches whose disparity differs from `disparity` by at most kThinStep.
// Each patch is weighted by its element of `parts` and by its confidence. The weight of the mean is
// the sum of the weights, at most kKnown. It is inlined, because `parts` are constants.
inline FarLight MeanOf(const FourPatches& patches, const int32_t (&parts)[4], int32_t disparity) {
  ColourSum<int64_t> sum;
  int64_t disparities = 0;
  for (int k = 0; k < 4; ++k) {
    if (patches[k]->weight == 0 || Abs(patches[k]->disparity - disparity) > kThinStep) continue;
    const int32_t part = parts[k] * patches[k]->weight;
    sum.Add(patches[k]->rgb, part);
    disparities += int64_t{part} * patches[k]->disparity;
  }
  if (sum.weight == 0) return {};
  FarLight mean;
  for (int c = 0; c < 3; ++c) mean.rgb[c] = static_cast<int16_t>(sum.Mean(c));
  mean.weight = static_cast<int16_t>(Min(static_cast<int32_t>(sum.weight), kKnown));
  mean.disparity = static_cast<int16_t>(Rounded(disparities, sum.weight));
  return mean;
}

// Fills in the unknown part of a patch's light with the mean light of patches in `above`. Only
// patches that show the surface at `disparity` are included.
void PushPatch(const FourPatches& above, int32_t disparity, FarLight* patch) {
  if (patch->weight >= kKnown) return;
  const FarLight mean = MeanOf(above, {9, 3, 3, 1}, disparity);
  if (mean.weight == 0) return;
  for (int c = 0; c < 3; ++c) {
    const int32_t more = (patch->rgb[c] - mean.rgb[c]) * patch->weight;
    patch->rgb[c] = static_cast<int16_t>(mean.rgb[c] + RoundShift(more, kFarKnownBits));
  }
  if (patch->weight == 0) patch->disparity = mean.disparity;
  patch->weight = kKnown;
}

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
// least 4 kKnown / kSeenFound, or 4 kKnown / kSeenGiven with given coverage. Found coverage may
// lack strands that cover a sample, so two samples are needed. Given coverage lacks none.
constexpr int32_t kSeenFound = 2, kSeenGiven = 16;

class BehindReader {
 public:
  BehindReader(const Input& input, int32_t column, int32_t row)
      : kernels_(*input.kernels),
        input_(input),
        map_(*input.coverage),
        left_(column * kCoverageTile),
        columns_(Min(kCoverageTile, map_.width - left_)),
        seen_(HasGiven(input) ? kSeenGiven : kSeenFound) {
    for (int side = 0; side < kSideCount; ++side) {
      for (const OcclusionView& behind : input_.occlusion_views.on[side]) AddView(behind);
    }
    if (count_ > 0) FindBins(column, row);
  }

  void ReadRow(int32_t y) {
    bool any = false;
    for (int32_t k = 0; k < kCoverageTile; ++k) {
      sums_[k] = {};
      far_[k] = map_.FarAt(left_ + k, y).disparity;
      split_[k] = k < columns_ && map_.alpha[map_.At(left_ + k, y)] != kUnsplit;
      any = any || split_[k];
    }
    if (!any) return;
    int16_t light[3 * kCoverageTile];
    input_.Light(0, left_, y, columns_, light);
    for (int32_t k = 0; k < columns_; ++k) {
      sums_[k].Add(light + 3 * k, FarWeight(map_.first[map_.At(left_ + k, y)]) >> kCentreBits);
    }
    for (int view = 0; view < count_; ++view) ReadView(views_[view], y);
    for (int32_t k = 0; k < columns_; ++k) {
      if (!split_[k]) continue;
      FarLight& patch = map_.FarAt(left_ + k, y);
      patch.weight = static_cast<int16_t>(Min(sums_[k].weight * seen_ / 4, kKnown));
      if (sums_[k].weight == 0) continue;
      for (int c = 0; c < 3; ++c) patch.rgb[c] = static_cast<int16_t>(sums_[k].Mean(c));
    }
  }

 private:
  void AddView(const OcclusionView& behind) {
    if (behind.view == 0) return;
    for (int k = 0; k < count_; ++k) {
      if (views_[k].view == behind.view) return;
    }
    views_[count_++] = behind;
  }

  // Collects the disparities of near surfaces in and around the tile.
  void FindBins(int32_t column, int32_t row) {
    constexpr int32_t kAround = (kMostMove + kCoverageTile - 1) / kCoverageTile;
    ForPixels(Clipped(Around(column, row, kAround), map_.columns, map_.Rows()),
              [&](int32_t x, int32_t y) { bins_ |= map_.Tile(x, y).near_bins; });
  }

  // Reads the light of the far surface in row y from a view, and adds the light to sums_. Adjacent
  // pixels of equal disparity are read together.
  void ReadView(const OcclusionView& behind, int32_t y) {
    int16_t covered[kCoverageTile] = {};
    if (!FindCovered(behind.at, y, covered)) return;
    for (int32_t k = 0, end; k < columns_; k = end) {
      end = k + 1;
      if (!split_[k]) continue;
      while (end < columns_ && split_[end] && far_[end] == far_[k]) ++end;
      int32_t all = 0, weights[kCoverageTile];
      for (int32_t n = k; n < end; ++n) all |= weights[n] = FarWeight(covered[n]);
      if (all == 0) continue;
      constexpr int kBits = kViewBits + kDisparityBits - kShiftBits;
      const CapturedLine line = {
          (left_ + k) * kShiftOne - ScaledByView(behind.at.u, far_[k], kBits),
          y * kShiftOne - ScaledByView(behind.at.v, far_[k], kBits), 1, 0};
      int16_t light[3 * kCoverageTile];
      ReadCaptured(input_, 0, behind.view, line, end - k, light);
      for (int32_t n = k; n < end; ++n) sums_[n].Add(light + 3 * (n - k), weights[n]);
    }
  }

  // Finds, for each pixel of a row, an upper bound of the coverage by nearer surfaces in the view.
  // Returns false if a nearer surface may move by more than kMostMove pixels.
  bool FindCovered(const ViewPosition& view, int32_t y, int16_t* covered) const {
    // comes[m]: true if a nearer surface may move onto the row from m pixels away.
    bool comes[kMostMove + 1] = {};
    if (!FindMoves(Max(Abs(view.u), Abs(view.v)), comes)) return false;
    for (int32_t m = 0; m <= kMostMove; ++m) {
      if (comes[m]) CoverFrom(view, y, m, covered);
    }
    return true;
  }

  // `size` is the distance of the view from the centre view along the axis of the search.
  bool FindMoves(int32_t size, bool* comes) const {
    int32_t nearest_far = INT16_MAX, farthest_far = INT16_MIN;
    for (int32_t k = 0; k < columns_; ++k) {
      if (!split_[k]) continue;
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
  // along the axis of the search, on the side of the view. The axis is the one on which the view is
  // farther away.
  void CoverFrom(const ViewPosition& view, int32_t y, int32_t m, int16_t* covered) const {
    const bool down = Abs(view.v) > Abs(view.u);
    const int32_t along = down ? view.v : view.u, across = down ? view.u : view.v;
    // Movements have kDisparityBits - 1 fractional bits, because the SIMD kernel interprets `along`
    // with 15 fractional bits and kViewOne has 14. `moved` and `along` have the same sign, which is
    // left away, so that products are rounded alike on both sides.
    const simd::CoverView cover = {
        static_cast<int16_t>(Abs(along)), static_cast<int16_t>(m * (1 << (kDisparityBits - 1))),
        static_cast<int16_t>(kWithin / 2), static_cast<int16_t>(kBefore)};
    // Movement at right angles to the axis for each pixel of movement along the axis, kViewBits.
    const int32_t slant = across * kViewOne / along, moved = along < 0 ? -m : m;
    const auto middle = static_cast<int32_t>(RoundShift(int64_t{moved} * slant, kViewBits));
    for (int32_t beside = middle - 1; beside <= middle + 1; ++beside) {
      const int32_t dx = down ? beside : moved, row = y + (down ? moved : beside);
      if (row < 0 || row >= map_.height) continue;
      const size_t at = map_.At(left_ + dx, row);
      kernels_.CoverPlaces(map_.near + at, map_.first + at, far_, cover, covered);
    }
  }

  const simd::Kernels& kernels_;
  const Input& input_;
  const CoverageMap& map_;
  const int32_t left_, columns_;
  const int32_t seen_;  // kSeenFound or kSeenGiven
  OcclusionView views_[kSideCount * kOcclusionViews];
  int count_ = 0;
  uint64_t bins_ = 0;
  // State of one row of the tile.
  int16_t far_[kCoverageTile];  // disparity of the far surface at each pixel of the row
  bool split_[kCoverageTile];
  ColourSum<int32_t> sums_[kCoverageTile];
};

// Largest distance, along each axis, from a pixel to the pixels that contribute to the mean light
// of the near surface at the pixel.
constexpr int32_t kNearRadius = 3;

// The light of the near surface is known if the weights around a pixel sum to 2^kNearKnownBits, as
// for four pixels of coverage 1/2.
constexpr int kNearKnownBits = 2;

// Returns the trust in the mean light of the near surface, with kNearKnownBits fractional bits.
int32_t TrustIn(const ColourSum<int32_t>& near) { return Min(near.weight, 1 << kNearKnownBits); }

// Calls visit(x, y, alpha, light, near) for each pixel (x, y) of the picture in a tile whose
// coverage in `plane`, CoverageMap::first or CoverageMap::alpha, is between 0 and 1. `light` is the
// pixel's light, and `near` the sum of the light of the near surface around the pixel. The weight
// of the sum is kKnown for one pixel that the surface covers.
template <class Visit>
void ForEachMixture(const Input& input, int32_t column, int32_t row, const uint8_t* plane,
                    const Visit& visit) {
  constexpr int32_t kSide = kCoverageTile + 2 * kNearRadius;
  const CoverageMap& map = *input.coverage;
  const int32_t left = column * kCoverageTile - kNearRadius,
                top = row * kCoverageTile - kNearRadius;
  // Light and weights (EighthPower of the given coverage) of the tile and of kNearRadius pixels on
  // each side. Pixels beyond the picture have weight 0.
  int16_t light[kSide][3 * kSide] = {}, weights[kSide][kSide] = {};
  const Rect inside = Clipped({left, top, kSide, kSide}, map.width, map.height);
  for (int32_t y = inside.y; y < inside.y + inside.height; ++y) {
    input.Light(0, inside.x, y, inside.width, light[y - top] + 3 * (inside.x - left));
    for (int32_t x = inside.x; x < inside.x + inside.width; ++x) {
      const int32_t alpha = GivenAlpha(input.given_coverage.Row(y)[x]);
      weights[y - top][x - left] = static_cast<int16_t>(EighthPower(alpha));
    }
  }
  ForPixels(map.PixelsOf(column, row), [&](int32_t x, int32_t y) {
    const int32_t alpha = plane[map.At(x, y)];
    if (alpha == 0 || alpha >= kWhole) return;
    ColourSum<int32_t> near;
    ForPixels(Around(x - left, y - top, kNearRadius),
              [&](int32_t u, int32_t v) { near.Add(light[v] + 3 * u, weights[v][u]); });
    visit(x, y, alpha, light[y - top] + 3 * (x - left), near);
  });
}

}  // namespace

void PullTile(int32_t column, int32_t row, const CoverageMap& map) {
  for (int level = 1; level < kFarLevels; ++level) {
    const int32_t side = kCoverageTile >> level;
    ForPixels({column * side, row * side, side, side}, [&](int32_t x, int32_t y) {
      const FarLight* const below = map.far[level - 1];
      const FourPatches four = {below + map.PatchAt(2 * x, 2 * y, level - 1),
                                below + map.PatchAt(2 * x + 1, 2 * y, level - 1),
                                below + map.PatchAt(2 * x, 2 * y + 1, level - 1),
                                below + map.PatchAt(2 * x + 1, 2 * y + 1, level - 1)};
      map.far[level][map.PatchAt(x, y, level)] = MeanOf(four, {1, 1, 1, 1}, FarthestOf(four));
    });
  }
}

void PushTile(int32_t column, int32_t row, const CoverageMap& map, FarTile* far) {
  bool known[3][3];  // whether the tiles around the tile have patches
  ForPixels({0, 0, 3, 3}, [&](int32_t x, int32_t y) {
    known[y][x] =
        map.HasTile(column + x - 1, row + y - 1) && map.IsStarted(column + x - 1, row + y - 1);
  });
  FarTile levels[2];
  for (int level = kFarLevels - 1; level >= 0; --level) {
    FarTile& patches = level == 0 ? *far : levels[level & 1];
    FarTile& above = levels[(level + 1) & 1];
    const int32_t side = kCoverageTile >> level, border = level == 0 ? 0 : 1;
    const auto tile_of = [side](int32_t k) { return k < 0 ? 0 : k < side ? 1 : 2; };
    ForPixels({-border, -border, side + 2 * border, side + 2 * border}, [&](int32_t x, int32_t y) {
      FarLight& patch = patches.At(x, y);
      patch = known[tile_of(y)][tile_of(x)]
                  ? map.far[level][map.PatchAt(column * side + x, row * side + y, level)]
                  : FarLight{};
      if (level == kFarLevels - 1) return;
      // The four patches of the level above that are nearest to the patch, the nearest first.
      const int32_t u = x >> 1, v = y >> 1;
      const int32_t beside = u + ((x & 1) != 0 ? 1 : -1), next = v + ((y & 1) != 0 ? 1 : -1);
      const FourPatches four = {&above.At(u, v), &above.At(beside, v), &above.At(u, next),
                                &above.At(beside, next)};
      const int16_t own = patch.disparity;
      PushPatch(four, level == 0 || patch.weight > 0 ? own : FarthestOf(four), &patch);
      if (level == 0) patch.disparity = own;
    });
  }
}

void ReadBehindTile(const Input& input, int32_t column, int32_t row) {
  BehindReader reader(input, column, row);
  const Rect pixels = input.coverage->PixelsOf(column, row);
  for (int32_t y = pixels.y; y < pixels.y + pixels.height; ++y) reader.ReadRow(y);
  PullTile(column, row, *input.coverage);
}

void UnmixFar(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  const auto unmix = [&](int32_t x, int32_t y, int32_t alpha, const int16_t*,
                         const ColourSum<int32_t>& near) {
    FarLight& far = map.FarAt(x, y);
    const int32_t rest = kWhole - alpha;
    // far = mixed + (mixed - near) alpha / (1 - alpha). If the light of the near surface is not
    // known, it is assumed to equal the light of the pixel. The weight is (1 - alpha)^5.
    for (int c = 0; c < 3; ++c) {
      const int32_t contrast = TrustIn(near) * alpha * (far.rgb[c] - near.Mean(c));
      far.rgb[c] = LimitedLight(far.rgb[c] +
                                static_cast<int32_t>(Rounded(contrast, rest << kNearKnownBits)));
    }
    const int64_t square = int64_t{rest} * rest;
    far.weight = static_cast<int16_t>(square * square * rest >> (5 * kAlphaBits - kFarKnownBits));
  };
  ForEachMixture(input, column, row, map.first, unmix);
}

void AddFarDetail(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  // The far surface gets half of (1 - alpha)^3 of the light that the means of both surfaces do not
  // explain, per part of the pixel that it covers. The other half is left away because the light
  // from side views already has detail.
  const auto add = [&](int32_t x, int32_t y, int32_t alpha, const int16_t* mixed,
                       const ColourSum<int32_t>& near) {
    int16_t* const far = map.FarAt(x, y).rgb;
    const int32_t rest = kWhole - alpha, cube = rest * rest * rest;
    // If the light of the near surface is not known, it is assumed to equal the light of the far
    // surface.
    for (int c = 0; c < 3; ++c) {
      const int32_t contrast = TrustIn(near) * (near.Mean(c) - far[c]) >> kNearKnownBits;
      const int64_t detail = (mixed[c] - far[c]) * kWhole - alpha * contrast;
      far[c] = LimitedLight(far[c] +
                            static_cast<int32_t>(RoundShift(detail * cube, 4 * kAlphaBits + 1)));
    }
  };
  ForEachMixture(input, column, row, map.alpha, add);
}

}  // namespace starfocus
