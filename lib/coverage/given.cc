// SPDX-License-Identifier: Apache-2.0
#include "lib/coverage/given.h"

#include <cstring>

#include "lib/coverage/far_light.h"
#include "lib/coverage/patch.h"

namespace starfocus {
namespace {

// Pixels of the far and the near surface are looked for within so many pixels of a pixel: the
// outlines of maps of networks are off by as many.
constexpr int32_t kGivenReach = 32;
using GivenPatch = Patch<kGivenReach>;

// The ends of the range of disparities around a tile, an eighth of it each, are the surfaces;
// between them are ramps of the map.
constexpr int32_t kEnds = 8;

// A pixel is a mixture if its coverage differs by more from what the map says; kAlphaBits.
constexpr int32_t kLeastMixed = kWhole / 16;

// Disparities from low to high.
struct Range {
  int32_t low, high;

  bool Has(int32_t disparity) const { return disparity >= low && disparity <= high; }
};

// Finds the disparity of the nearest pixel, of those equally near the first by rows, in a range.
// Returns false if there is none within kGivenReach.
bool FindNearest(const GivenPatch& patch, int32_t at, const Range& range, int32_t* disparity) {
  *disparity = patch.disparity[at];
  if (range.Has(*disparity)) return true;
  int32_t nearest = INT32_MAX;
  for (int32_t r = 1; r <= kGivenReach && r * r < nearest; ++r) {
    for (int32_t y = -r; y <= r; ++y) {
      const int32_t step = Abs(y) == r ? 1 : 2 * r;
      for (int32_t x = -r; x <= r; x += step) {
        const int32_t there = patch.disparity[at + y * GivenPatch::kSide + x];
        if (!range.Has(there) || x * x + y * y >= nearest) continue;
        nearest = x * x + y * y;
        *disparity = there;
      }
    }
  }
  return nearest != INT32_MAX;
}

class GivenStarter {
 public:
  GivenStarter(const CoverageInput& in, int32_t column, int32_t row)
      : window_(*in.window),
        map_(*in.map),
        left_(column * kTileSide),
        top_(row * kTileSide),
        patch_(window_, column, row),
        tile_(map_.Tile(column, row)) {
    Range all = {INT16_MAX, INT16_MIN};
    for (const int16_t disparity : patch_.disparity) {
      all = {Min(all.low, disparity), Max(all.high, disparity)};
    }
    const int32_t end = (all.high - all.low) / kEnds;
    far_ = {all.low, all.low + end};
    near_ = {all.high - end, all.high};
  }

  void Start() {
    tile_.near_bins = 0;
    const int32_t columns = Min(kTileSide, map_.width - left_);
    for (int32_t y = top_; y < top_ + kTileSide; ++y) {
      int16_t light[3 * kTileSide] = {};
      const bool inside = y < map_.height;
      if (inside) window_.reader.Light(0, left_, y, columns, light);
      for (int32_t k = 0; k < kTileSide; ++k) {
        StartPixel(left_ + k, y);
        FarCell& far = map_.FarAt(left_ + k, y);
        std::memcpy(far.rgb, light + 3 * k, sizeof(far.rgb));
        if (inside && k < columns) continue;
        far.weight = 0;
        map_.near[map_.At(left_ + k, y)] = kNowhere;
      }
    }
  }

 private:
  void StartPixel(int32_t x, int32_t y) {
    const size_t to = map_.At(x, y);
    const int32_t at = GivenPatch::At(x - left_, y - top_);
    const int16_t here = patch_.disparity[at];
    FarCell& far = map_.FarAt(x, y);
    int32_t low, high;
    if (near_.high - far_.low <= kThinStep || !FindNearest(patch_, at, far_, &low) ||
        !FindNearest(patch_, at, near_, &high)) {
      map_.near[to] = here;
      far.disparity = here;
      map_.alpha[to] = kUnparted;
      map_.first[to] = kWhole;
      far.weight = kKnown;
    } else {
      map_.near[to] = SmoothNear(patch_, at, high);
      far.disparity = static_cast<int16_t>(low);
      map_.alpha[to] = 2 * here >= low + high ? uint8_t{kWhole} : uint8_t{0};
      TakePixel(x, y);
    }
    tile_.near_bins |= map_.BinOf(map_.near[to]);
  }

  // Takes the coverage of a pixel that has two surfaces.
  void TakePixel(int32_t x, int32_t y) {
    if (x >= map_.width || y >= map_.height) return;
    const size_t to = map_.At(x, y);
    FarCell& far = map_.FarAt(x, y);
    const int32_t alpha = (window_.given_coverage.Row(y)[x] * kWhole + 127) / 255;
    if (Abs(alpha - map_.alpha[to]) > kLeastMixed) tile_.mixed = 1;
    map_.first[to] = static_cast<uint8_t>(alpha);
    far.weight = static_cast<int16_t>(FarWeight(alpha));
    tile_.low = static_cast<int16_t>(Min(tile_.low, far.disparity));
    tile_.high = static_cast<int16_t>(Max(tile_.high, map_.near[to]));
  }

  const Window& window_;
  const CoverageMap& map_;
  const int32_t left_, top_;
  const GivenPatch patch_;
  CoverageTile& tile_;
  Range far_, near_;
};

}  // namespace

void StartGiven(const CoverageInput& in, int32_t column, int32_t row) {
  GivenStarter(in, column, row).Start();
  PullTile(column, row, *in.map);
}

void TakeGiven(const CoverageInput& in, int32_t column, int32_t row) {
  const CoverageMap& map = *in.map;
  FarTile far;
  PushTile(column, row, map, &far);
  for (int32_t y = 0; y < Min(kTileSide, map.height - row * kTileSide); ++y) {
    for (int32_t k = 0; k < Min(kTileSide, map.width - column * kTileSide); ++k) {
      const int32_t x = column * kTileSide + k;
      const size_t to = map.At(x, row * kTileSide + y);
      const FarCell& cell = far.cells[y * kTileSide + k];
      if (map.alpha[to] == kUnparted || cell.weight == 0) continue;
      map.alpha[to] = map.first[to];
      std::memcpy(map.FarAt(x, row * kTileSide + y).rgb, cell.rgb, sizeof(cell.rgb));
    }
  }
}

}  // namespace starfocus
