// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/given.h"

#include <cstring>

#include "lib/matting/far_light.h"
#include "lib/matting/surface_search.h"

namespace starfocus {
namespace {

// A pixel is a mixture if its given coverage differs from the coverage implied by the disparity map
// by more than kLeastMixed (kAlphaBits).
constexpr int32_t kLeastMixed = kWhole / 16;

class GivenStarter {
 public:
  GivenStarter(const CoverageInput& in, int32_t column, int32_t row)
      : input_(*in.input),
        map_(*in.map),
        left_(column * kCoverageTile),
        top_(row * kCoverageTile),
        around_(input_, column, row),
        search_(around_),
        tile_(map_.Tile(column, row)) {}

  void Start() {
    tile_.near_bins = 0;
    const int32_t columns = Min(kCoverageTile, map_.width - left_);
    for (int32_t y = top_; y < top_ + kCoverageTile; ++y) {
      int16_t light[3 * kCoverageTile] = {};
      const bool inside = y < map_.height;
      if (inside) input_.Light(0, left_, y, columns, light);
      for (int32_t k = 0; k < kCoverageTile; ++k) {
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
    const int32_t at = GivenDisparities::At(x - left_, y - top_);
    const int16_t here = around_.disparity[at];
    FarCell& far = map_.FarAt(x, y);
    Surfaces surfaces;
    if (search_.FindSurfaces(at, &surfaces)) {
      map_.near[to] = SmoothNear(around_, at, surfaces.high);
      far.disparity = static_cast<int16_t>(surfaces.low);
      map_.alpha[to] = surfaces.IsNear(here) ? uint8_t{kWhole} : uint8_t{0};
      TakePixel(x, y);
    } else {
      map_.near[to] = here;
      far.disparity = here;
      map_.alpha[to] = kUnparted;
      map_.first[to] = kWhole;
      far.weight = kKnown;
    }
    tile_.near_bins |= map_.BinOf(map_.near[to]);
  }

  // Stores the given coverage of a pixel that has two surfaces.
  void TakePixel(int32_t x, int32_t y) {
    if (x >= map_.width || y >= map_.height) return;
    const size_t to = map_.At(x, y);
    FarCell& far = map_.FarAt(x, y);
    const int32_t alpha = (input_.given_coverage.Row(y)[x] * kWhole + 127) / 255;
    if (Abs(alpha - map_.alpha[to]) > kLeastMixed) tile_.mixed = 1;
    map_.first[to] = static_cast<uint8_t>(alpha);
    far.weight = static_cast<int16_t>(FarWeight(alpha));
    tile_.low = static_cast<int16_t>(Min(tile_.low, far.disparity));
    tile_.high = static_cast<int16_t>(Max(tile_.high, map_.near[to]));
  }

  const Input& input_;
  const CoverageMap& map_;
  const int32_t left_, top_;
  const GivenDisparities around_;
  const SurfaceSearch search_;
  CoverageTile& tile_;
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
  for (int32_t y = 0; y < Min(kCoverageTile, map.height - row * kCoverageTile); ++y) {
    for (int32_t k = 0; k < Min(kCoverageTile, map.width - column * kCoverageTile); ++k) {
      const int32_t x = column * kCoverageTile + k;
      const size_t to = map.At(x, row * kCoverageTile + y);
      const FarCell& cell = far.cells[y * kCoverageTile + k];
      if (map.alpha[to] == kUnparted) continue;
      // A pixel cannot be split if the light of the far surface is not known nearby.
      map.alpha[to] = cell.weight == 0 ? kUnparted : map.first[to];
      std::memcpy(map.FarAt(x, row * kCoverageTile + y).rgb, cell.rgb, sizeof(cell.rgb));
    }
  }
}

}  // namespace starfocus
