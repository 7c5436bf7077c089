// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/coverage.h"

#include <algorithm>
#include <cstring>

#include "lib/depth/surface_votes.h"

namespace starfocus {
namespace {

// Distance from the ramp at which a pixel of the map counts as pure.
constexpr int32_t kPureDistance = 8;
// Weight of pure pixels that a mean takes. Near pixels are rarer.
constexpr int32_t kFarNeed = 8 * kMostColourWeight, kNearNeed = 4 * kMostColourWeight;
constexpr int32_t kFarWindow = 2, kNearWindow = 4;
// Squared colour distances have twice kMeanBits.
constexpr int32_t kSquare = 1 << (2 * kMeanBits);
// Below this squared distance of both surfaces' colours they do not tell the surfaces apart; from
// twice of it on they do.
constexpr int32_t kLeastContrast = 300 * kSquare;
// Noise of a picture: squared distance from the line of mixtures.
constexpr int32_t kNoise = 81 * kSquare;
// Pixels whose colours are trusted this much do not vote.
constexpr int32_t kNoVote = 128;
// Contrast that gives a near pixel full weight in the first pass.
constexpr int32_t kFullContrast = 16000 * kSquare;
// Radius of the window whose mixtures decide on pixels that are none, and the map's share in it.
constexpr int32_t kAround = 3, kMapWeight = 2 * 255;

// (1 - a)^8 of a coverage of 255, in weights.
uint8_t Eighth(int32_t value) {
  int32_t power = value;
  for (int k = 0; k < 3; ++k) power = (power * power + 127) / 255;
  return static_cast<uint8_t>((power * kMostColourWeight + 127) / 255);
}

struct Matte {
  const ColourMap& map;
  const MapLevels& levels;
  const Band& band;
  const CoverageScratch& scratch;
  const CoveragePlanes& planes;
  uint8_t eighth[256];

  bool IsNear(size_t at) const { return (levels.place[at] & kNearSide) != 0; }
  int32_t Distance(size_t at) const { return levels.place[at] & kDistanceMask; }
  // Weight of a pixel as a pure one by its distance from the ramp.
  uint8_t Pure(size_t at) const {
    const int32_t d = Min(Distance(at), kPureDistance);
    return static_cast<uint8_t>(kMostColourWeight * d * d / (kPureDistance * kPureDistance));
  }
  uint8_t FarWeight(size_t at) const {
    if (levels.place[at] == kNoEdge) return 0;
    if (planes.before == nullptr) return IsNear(at) ? uint8_t{0} : Pure(at);
    if (IsNear(at) && !IsInBand(levels, band, at)) return 0;
    return eighth[kCovered - planes.before[at]];
  }
  uint8_t NearWeight(size_t at, const MeanColour* far_mean, const uint8_t* colour) const {
    if (levels.place[at] == kNoEdge) return 0;
    if (planes.before != nullptr) return eighth[planes.before[at]];
    if (!IsNear(at)) return 0;
    const int32_t pure = Pure(at);
    if (!band.by_contrast) return static_cast<uint8_t>(pure);
    if (far_mean == nullptr || far_mean->trust == 0) return 0;
    int32_t squares = 0;
    for (int k = 0; k < 3; ++k) {
      const int32_t difference = colour[k] * (1 << kMeanBits) - far_mean->rgb[k];
      squares += difference * difference;
    }
    const int32_t share = Min(squares, kFullContrast) / (kFullContrast >> 8);
    return static_cast<uint8_t>((pure * share * share) >> 16);
  }
};

// A mixture's coverage and how far the colours are trusted, both up to 255.
struct Mixture {
  int32_t coverage, trust;
};

int32_t Rising(int64_t value, int64_t full) {
  return value <= 0 ? 0 : value >= full ? 255 : static_cast<int32_t>(255 * value / full);
}

Mixture Unmix(const uint8_t* colour, const MeanColour& back, const MeanColour& front,
              int32_t variance) {
  int32_t direction[3], own[3], length = 0;
  int64_t along = 0;
  for (int k = 0; k < 3; ++k) {
    direction[k] = front.rgb[k] - back.rgb[k];
    own[k] = colour[k] * (1 << kMeanBits) - back.rgb[k];
    length += direction[k] * direction[k];
    along += int64_t{direction[k]} * own[k];
  }
  if (length <= kLeastContrast) return {0, 0};
  const int32_t coverage = Rising(along + length / 510, length);
  int64_t off = 0;
  for (int k = 0; k < 3; ++k) {
    const int32_t difference = own[k] - direction[k] * coverage / 255;
    off += int64_t{difference} * difference;
  }
  const int64_t spread = kNoise + length / 16;
  int32_t trust = Rising(9 * spread - 4 * off, 8 * spread);
  trust = trust * Rising(length - kLeastContrast, kLeastContrast) / 255;
  trust = trust * Rising(length - int64_t{4} * variance, int64_t{4} * variance + 1) / 255;
  trust = trust * Min(255, 2 * Min(back.trust, front.trust)) / 255;
  return {coverage, trust};
}

// Makes a table of the far colours around the tile, and then the far colour of each pixel.
void FindFarColours(const Matte& matte, const Rect& outer, const Rect& inner) {
  ColourSums sums(outer, matte.scratch.far_sums);
  for (int32_t y = outer.y; y < outer.y + outer.height; ++y) {
    const size_t row = matte.map.At(outer.x, y);
    for (int32_t x = 0; x < outer.width; ++x) {
      matte.scratch.weights[x] = matte.FarWeight(row + static_cast<size_t>(x));
    }
    sums.AddRow(y, matte.map.Pixel(outer.x, y), matte.scratch.weights);
  }
  MeanColour* mean = matte.scratch.far_means;
  for (int32_t y = inner.y; y < inner.y + inner.height; ++y) {
    for (int32_t x = inner.x; x < inner.x + inner.width; ++x, ++mean) {
      if (!IsInBand(matte.levels, matte.band, matte.map.At(x, y))) continue;
      *mean = sums.MeanAt(x, y, {kFarWindow, matte.band.window, kFarNeed});
    }
  }
}

// Finds the mixtures of the pixels of `rect` from the far colours of `inner`.
void FindMixtures(const Matte& matte, const Rect& inner, const Rect& rect) {
  const CoverageScratch& scratch = matte.scratch;
  ColourSums sums(inner, scratch.near_sums);
  const MeanColour* means = scratch.far_means;
  for (int32_t y = inner.y; y < inner.y + inner.height; ++y, means += inner.width) {
    for (int32_t x = 0; x < inner.width; ++x) {
      const size_t at = matte.map.At(inner.x + x, y);
      const bool mixes = IsInBand(matte.levels, matte.band, at);
      scratch.weights[x] =
          matte.NearWeight(at, mixes ? means + x : nullptr, matte.map.Pixel(inner.x + x, y));
    }
    sums.AddRow(y, matte.map.Pixel(inner.x, y), scratch.weights);
  }
  size_t k = 0;
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    const MeanColour* row =
        scratch.far_means + static_cast<ptrdiff_t>(y - inner.y) * inner.width - inner.x;
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x, ++k) {
      const size_t at = matte.map.At(x, y);
      Mixture mixture = {matte.IsNear(at) ? kCovered : 0, 0};
      if (IsInBand(matte.levels, matte.band, at) && row[x].trust > 0) {
        const int32_t first = matte.planes.before == nullptr ? kNearWindow : kFarWindow;
        const MeanColour front = sums.MeanAt(x, y, {first, matte.band.window, kNearNeed});
        const int32_t variance =
            matte.band.by_votes ? Max(row[x].variance, front.variance) : row[x].variance;
        mixture = Unmix(matte.map.Pixel(x, y), row[x], front, variance);
      }
      scratch.mixture[k] = static_cast<uint8_t>(mixture.coverage);
      scratch.trust[k] = static_cast<uint8_t>(mixture.trust);
    }
  }
}

// Returns the coverage of a pixel whose colours are not trusted in full: that of the trusted ones
// around, and a little of the map's.
int32_t CoverageAround(const Matte& matte, const Rect& rect, int32_t x, int32_t y) {
  const Rect around = Widened(matte.map.plan, {x, y, 1, 1}, kAround);
  const int32_t by_map = matte.IsNear(matte.map.At(x, y)) ? kCovered : 0;
  int32_t sum = kMapWeight * by_map, weights = kMapWeight;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const size_t k = static_cast<size_t>(row - rect.y) * static_cast<size_t>(rect.width) +
                     static_cast<size_t>(around.x - rect.x);
    for (size_t n = k; n < k + static_cast<size_t>(around.width); ++n) {
      sum += matte.scratch.trust[n] * matte.scratch.mixture[n];
      weights += matte.scratch.trust[n];
    }
  }
  return (sum + weights / 2) / weights;
}

// Enters the votes of the pixels of `rect`, and which pixels those of the tile are most alike.
void FindVotes(const Matte& matte, const Rect& rect, const Rect& tile) {
  int8_t* vote = matte.scratch.votes;
  size_t k = 0;
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x, ++vote, ++k) {
      const size_t at = matte.map.At(x, y);
      *vote = matte.IsNear(at) ? INT8_MAX : -INT8_MAX;
      if (!IsInBand(matte.levels, matte.band, at)) continue;
      Likeness best = {{0, 0}, {matte.levels.far_level[at], matte.levels.near_level[at]}};
      if (matte.scratch.trust[k] < kNoVote) {
        best = CompareAround(matte.map, matte.levels, x, y);
        *vote = static_cast<int8_t>(best.Vote());
      } else {
        *vote = static_cast<int8_t>(Max(matte.scratch.mixture[k] - 128, -INT8_MAX));
      }
      if (x < tile.x || x >= tile.x + tile.width || y < tile.y || y >= tile.y + tile.height)
        continue;
      for (int side = 0; side < 2; ++side) {
        matte.planes.alike[side][at] = static_cast<int16_t>(best.disparities[side]);
      }
    }
  }
}

void WriteCoverage(const Matte& matte, const Rect& rect, const Rect& tile) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = matte.map.At(x, y);
      const size_t k = static_cast<size_t>(y - rect.y) * static_cast<size_t>(rect.width) +
                       static_cast<size_t>(x - rect.x);
      int32_t coverage = matte.IsNear(at) ? kCovered : 0, trust = 0;
      if (IsInBand(matte.levels, matte.band, at)) {
        trust = matte.scratch.trust[k];
        coverage = matte.scratch.mixture[k];
        if (trust < 255) {
          const int32_t around = matte.band.by_votes
                                     ? CoverageByVotes(matte.map, rect, matte.scratch.votes, x, y)
                                     : CoverageAround(matte, rect, x, y);
          coverage = (trust * coverage + (255 - trust) * around + 127) / 255;
        }
      }
      matte.planes.coverage[at] = static_cast<uint8_t>(coverage);
      matte.planes.trust[at] = static_cast<uint8_t>(trust);
    }
  }
}

// Returns the smallest rectangle that holds the tile's pixels of the band.
Rect FindBandIn(const Matte& matte, const Rect& tile) {
  int32_t left = INT32_MAX, top = INT32_MAX, right = -1, bottom = -1;
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      if (!IsInBand(matte.levels, matte.band, matte.map.At(x, y))) continue;
      left = Min(left, x), right = Max(right, x);
      top = Min(top, y), bottom = y;
    }
  }
  if (right < 0) return {tile.x, tile.y, 0, 0};
  return {left, top, right - left + 1, bottom - top + 1};
}

}  // namespace

CoverageScratch TakeCoverageScratch(size_t width, size_t height, Carver* carver) {
  CoverageScratch scratch;
  scratch.far_sums = carver->Take<ColourSum>(width + 1, height + 1);
  scratch.near_sums = carver->Take<ColourSum>(width + 1, height + 1);
  scratch.far_means = carver->Take<MeanColour>(width, height);
  scratch.weights = carver->Take<uint8_t>(width);
  scratch.mixture = carver->Take<uint8_t>(width, height);
  scratch.trust = carver->Take<uint8_t>(width, height);
  scratch.votes = carver->Take<int8_t>(width, height);
  return scratch;
}

void FindCoverage(const ColourMap& map, const MapLevels& levels, const Band& band, const Rect& tile,
                  const CoverageScratch& scratch, const CoveragePlanes& planes) {
  Matte matte = {map, levels, band, scratch, planes, {}};
  for (int32_t a = 0; a <= kCovered; ++a) matte.eighth[a] = Eighth(a);
  const Rect found = FindBandIn(matte, tile);
  const Rect rect = found.width > 0 ? Widened(map.plan, found, kVoteRadius) : Rect{0, 0, 0, 0};
  if (found.width > 0) {
    const Rect inner = Widened(map.plan, rect, band.window);
    FindFarColours(matte, Widened(map.plan, inner, band.window), inner);
    FindMixtures(matte, inner, rect);
    if (matte.band.by_votes) FindVotes(matte, rect, tile);
  }
  WriteCoverage(matte, rect, tile);
}

}  // namespace starfocus
