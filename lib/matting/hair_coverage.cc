// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/hair_coverage.h"

#include <algorithm>

#include "lib/matting/colour.h"

namespace starfocus {

namespace {

// Radius in patches of the range HairMemory::low to HairMemory::high.
constexpr int32_t kSurfaceRadius = 10;
// Radii in patches. An inside patch has far pixels within kMostInside but not within kBeside. An
// outside patch has near pixels within kMostInside but not within kBeside.
constexpr int32_t kBeside = 1, kMostInside = 4;
// Squared contrast from which on pixels are compared with it, in squared codes.
constexpr int32_t kClearContrast = 1600;
// Squared difference of colours that are nearly equal, in squared codes.
constexpr int32_t kSame = 100;
// Hair from which on a patch keeps its disparities.
constexpr uint8_t kHairy = 128;

// Calls add(column, row, weight) for the four of columns x rows patches, with sides of kSide
// samples, whose centres are nearest to the centre of sample (x, y). The weights are those of
// bilinear interpolation, and their sum is 4 kSide^2.
template <int32_t kSide, class Add>
void Interpolate(int32_t columns, int32_t rows, int32_t x, int32_t y, const Add& add) {
  constexpr int32_t kStep = 2 * kSide;  // between two centres, in half samples
  // Position in half samples, from the centre of the patch before the first patch.
  const int32_t across = 2 * x + 1 + kSide, down = 2 * y + 1 + kSide;
  const int32_t left = Max(across / kStep - 1, 0), right = Min(across / kStep, columns - 1);
  const int32_t top = Max(down / kStep - 1, 0), bottom = Min(down / kStep, rows - 1);
  const int32_t dx = across % kStep, dy = down % kStep;
  add(left, top, (kStep - dx) * (kStep - dy));
  add(right, top, dx * (kStep - dy));
  add(left, bottom, (kStep - dx) * dy);
  add(right, bottom, dx * dy);
}

// Interpolates the colour of a level at the centre of sample (x, y). Patches have sides of kSide
// samples.
template <int32_t kSide>
void ColourOfLevel(const ColourPyramid& pyramid, int level, int32_t x, int32_t y, int32_t* rgb) {
  std::fill_n(rgb, 3, 2 * kSide * kSide);
  Interpolate<kSide>(pyramid.Columns(level), pyramid.Rows(level), x, y,
                     [&](int32_t column, int32_t row, int32_t weight) {
                       const ColourMean& mean = pyramid.At(level, column, row);
                       for (int c = 0; c < 3; ++c) rgb[c] += weight * mean.rgb[c];
                     });
  for (int c = 0; c < 3; ++c) rgb[c] /= 4 * kSide * kSide;
}

// Weights of a pixel or patch in a ColourSum: kFull if its colour is fully known, so that sums of
// 16 pixels fit in 46 bits, and kUnit for the weight 1 of a ColourMean.
constexpr int64_t kFull = int64_t{1} << 28, kUnit = kFull / kFullyKnown;

ColourMean MeanOf(const ColourSum<int64_t>& sum) {
  ColourMean mean;
  for (int c = 0; c < 3; ++c) mean.rgb[c] = static_cast<uint16_t>(sum.Mean(c));
  // A mean of faint colours has the weight 1, so that it counts where no other colour is known.
  mean.weight =
      static_cast<uint16_t>(std::min<int64_t>((sum.weight + kUnit - 1) / kUnit, kFullyKnown));
  return mean;
}

// One pixel of a patch.
struct PatchPixel {
  int32_t x, y;  // Position in the picture.
  bool is_near;
  uint8_t* coverage;
  int32_t rgb[3];  // kMeanBits
};

// Returns true for half of the pixels of a patch, in a pattern that is the same in a mirrored
// patch.
bool IsSample(const PatchPixel& pixel) {
  return ((pixel.x ^ pixel.x >> 1 ^ pixel.y ^ pixel.y >> 1) & 1) == 0;
}

// Replaces each of `count` values, which are `stride` values apart, with the reduction by `join`
// over the kSurfaceRadius values before and after it. With growing shifts, each value is joined
// with the values after it, and then with those before it.
template <class Join>
void JoinAround(int32_t count, int32_t stride, const Join& join, int16_t* values) {
  for (const bool after : {true, false}) {
    for (const int32_t shift : {1, 2, 4, kSurfaceRadius - 7}) {
      for (int32_t k = 0; k + shift < count; ++k) {
        const ptrdiff_t to = after ? k : count - 1 - k, from = after ? to + shift : to - shift;
        values[to * stride] = join(values[to * stride], values[from * stride]);
      }
    }
  }
}

// Returns the squared difference of two colours, in squared codes.
int32_t SquaredDifference(const int32_t* a, const int32_t* b) {
  int32_t sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum >> (2 * kMeanBits);
}

constexpr int32_t kWhole = 256;
// ShareOf converts a coverage of 0 to 255 to a fraction of kWhole. FourthPower computes the fourth
// power of a fraction of kWhole.
constexpr int32_t ShareOf(uint8_t coverage) { return coverage + coverage / 128; }
constexpr int32_t FourthPower(int32_t share) {
  const int32_t square = share * share / kWhole;
  return square * square / kWhole;
}

// Squared contrast, in squared codes, below which coverage cannot be measured. It is fully measured
// from twice this contrast on.
constexpr int32_t kLeastContrast = 300;
// Largest coverage that is attributed to the texture of the background.
constexpr int32_t kTexture = kWhole / 8;

// Result of the comparison of a pixel with the foreground and background colours at the pixel.
struct Unmixed {
  int32_t share;             // coverage, as a fraction of kWhole
  int32_t beside, contrast;  // squared differences of pixel and foreground from the background
};

// Returns 0 up to `low`, 256 from `high` on, and values between.
int32_t Fade(int64_t value, int32_t low, int32_t high) {
  return Clamp(256 * (static_cast<int32_t>(value) - low) / (high - low), 0, 256);
}

// Returns the share `to` where `hair` is 255, the share `from` where it is 0, and mixtures between.
int32_t Faded(int32_t from, int32_t to, uint8_t hair) {
  return from + (to - from) * ShareOf(hair) / kWhole;
}

// The phases of FindHairCoverage. Each phase processes rows of blocks.
struct HairSearch {
  const Plane<const uint8_t> rgb;
  const Plane<const int16_t> disparity;
  const Plane<uint8_t> coverage;
  const HairMemory& memory;

  // Measures the range of the disparities of each patch.
  void MeasurePatches(const Range& blocks) const {
    ForPatches(blocks, [&](int32_t column, int32_t row, size_t at) {
      int16_t least = INT16_MAX, greatest = INT16_MIN;
      ForPixels(PatchAt(column, row), [&](int32_t x, int32_t y) {
        least = std::min(least, disparity.Row(y)[x]);
        greatest = std::max(greatest, disparity.Row(y)[x]);
      });
      memory.low[at] = memory.least[at] = least;
      memory.high[at] = memory.greatest[at] = greatest;
    });
  }

  // Computes `low` and `high` from the ranges of the patches. Returns true.
  bool JoinPatches() const {
    const auto least = [](int16_t a, int16_t b) { return std::min(a, b); };
    const auto most = [](int16_t a, int16_t b) { return std::max(a, b); };
    for (int32_t row = 0; row < memory.rows; ++row) {
      JoinAround(memory.columns, 1, least, memory.low + memory.At(0, row));
      JoinAround(memory.columns, 1, most, memory.high + memory.At(0, row));
    }
    for (int32_t column = 0; column < memory.columns; ++column) {
      JoinAround(memory.rows, memory.columns, least, memory.low + column);
      JoinAround(memory.rows, memory.columns, most, memory.high + column);
    }
    return true;
  }

  // Computes background colours for the first pass, from far patches.
  void PullFar(const Range& blocks) const {
    ForPatches(blocks, [&](int32_t column, int32_t row, size_t at) {
      ColourSum<int64_t> sum;
      if (memory.HasEdge(at) && !HasWithin(column, row, kBeside, true)) {
        ForPatch(column, row, [&](const PatchPixel& pixel) { sum.Add(pixel.rgb, kFull); });
      }
      memory.far.At(0, column, row) = MeanOf(sum);
    });
  }

  // Computes foreground colours for the first pass, from near pixels weighted by the eighth power
  // of their contrast to the background. A contrast of 181 codes has the full weight.
  void PullNear(const Range& blocks) const {
    ForPatches(blocks, [&](int32_t column, int32_t row, size_t) {
      ColourSum<int64_t> sum;
      if (HasWithin(column, row, 0, true)) {
        ForPatch(column, row, [&](const PatchPixel& pixel) {
          if (!pixel.is_near || !IsSample(pixel)) return;
          int32_t far[3];
          ColourAt(memory.far, pixel.x, pixel.y, far);
          const int64_t contrast = SquaredDifference(far, pixel.rgb) / 16;
          const int64_t fourth = contrast * contrast / 256;
          sum.Add(pixel.rgb, std::min(fourth * fourth, kFull));
        });
      }
      memory.near.At(0, column, row) = MeanOf(sum);
    });
  }

  void CountVotes(const Range& blocks) const {
    std::fill(&memory.VotesAt(0, blocks.first), &memory.VotesAt(0, blocks.last), HairVotes{});
    ForPatches(blocks, [&](int32_t column, int32_t row, size_t at) {
      memory.hair[at] = 0;
      if (!memory.HasEdge(at)) return;
      const bool near = HasWithin(column, row, kBeside, true);
      if (near == HasWithin(column, row, kBeside, false)) return;
      if (!HasWithin(column, row, kMostInside, !near)) return;
      HairVotes* const votes = &memory.VotesAt(column / kHairBlock, row / kHairBlock);
      if (near) return CountInside(column, row, votes);
      ForPatch(column, row, [&](const PatchPixel& pixel) {
        if (!IsSample(pixel)) return;
        ++votes->outside;
        votes->beyond += Unmix(pixel, 0).share;
      });
    });
  }

  // Decides which patches show hair. Hair extends to the blocks around those with the colours of
  // hair, because its tips have few pixels inside outlines. Between the centres of blocks, the
  // degree is interpolated. Returns true if any block has hair.
  bool FillHair() const {
    bool any = false;
    ForPixels({0, 0, memory.block_columns, memory.block_rows}, [&](int32_t column, int32_t row) {
      const int32_t found = FindHair(column, row);
      memory.VotesAt(column, row).found = found;
      any = any || found >= kHairy;
    });
    if (!any) return false;
    ForPatches({0, memory.block_rows}, [&](int32_t column, int32_t row, size_t at) {
      if (!memory.HasEdge(at)) return;
      int32_t hair = 0;
      Interpolate<kHairBlock>(memory.block_columns, memory.block_rows, column, row,
                              [&](int32_t x, int32_t y, int32_t weight) {
                                int32_t most = 0;
                                ForBlocksAround(x, y, 1, [&](const HairVotes& votes, int32_t) {
                                  most = Max(most, votes.found);
                                });
                                hair += weight * most;
                              });
      memory.hair[at] = static_cast<uint8_t>(Min(hair / (4 * kHairBlock * kHairBlock), UINT8_MAX));
    });
    return true;
  }

  // Writes the coverage of patches with hair. In the second pass (kAgain), the background colour of
  // a pixel is mixed with the pixel's own colour. The share of the pixel's own colour increases as
  // the coverage from the first pass decreases.
  template <bool kAgain>
  void UnmixPatches(const Range& blocks) const {
    ForPatches(blocks, [&](int32_t column, int32_t row, size_t at) {
      if (memory.hair[at] == 0) return;
      ForPatch(column, row, [&](const PatchPixel& pixel) {
        const int32_t own = kAgain ? FourthPower(kWhole - ShareOf(*pixel.coverage)) : 0;
        const int32_t texture = pixel.is_near ? 0 : kTexture;
        const int32_t unmixed = Unmix(pixel, own).share;
        const int32_t share = Max(0, unmixed - texture) * kWhole / (kWhole - texture);
        *pixel.coverage = static_cast<uint8_t>((share * UINT8_MAX + kWhole / 2) / kWhole);
      });
    });
  }

  // Computes foreground and background colours for the second pass, from all pixels weighted by the
  // coverage of the first pass.
  void PullBoth(const Range& blocks) const {
    ForPatches(blocks, [&](int32_t column, int32_t row, size_t at) {
      ColourSum<int64_t> near, far;
      if (memory.HasEdge(at)) {
        ForPatch(column, row, [&](const PatchPixel& pixel) {
          const int32_t given = pixel.is_near ? kWhole : 0;
          // The coverage of patches without hair has not been written.
          const int32_t found = memory.hair[at] == 0 ? given : ShareOf(*pixel.coverage);
          const int32_t share = Faded(given, found, memory.hair[at]);
          near.Add(pixel.rgb, kUnit * FourthPower(share));
          far.Add(pixel.rgb, kUnit * FourthPower(kWhole - share));
        });
      }
      memory.near.At(0, column, row) = MeanOf(near);
      memory.far.At(0, column, row) = MeanOf(far);
    });
  }

  // Calls act(column, row, at) for all patches of the rows of blocks.
  template <class Act>
  void ForPatches(const Range& blocks, const Act& act) const {
    const int32_t first = kHairBlock * blocks.first;
    const int32_t last = Min(kHairBlock * blocks.last, memory.rows);
    ForPixels({0, first, memory.columns, last - first},
              [&](int32_t column, int32_t row) { act(column, row, memory.At(column, row)); });
  }

  Rect PatchAt(int32_t column, int32_t row) const {
    return Clipped({column * kHairPatch, row * kHairPatch, kHairPatch, kHairPatch}, memory.width,
                   memory.height);
  }

  // Calls act(pixel) for all pixels of a patch.
  template <class Act>
  void ForPatch(int32_t column, int32_t row, const Act& act) const {
    const size_t at = memory.At(column, row);
    ForPixels(PatchAt(column, row), [&](int32_t x, int32_t y) {
      const bool is_near = memory.IsNear(at, disparity.Row(y)[x]);
      PatchPixel pixel = {x, y, is_near, coverage.Row(y) + x, {}};
      const uint8_t* from = rgb.Row(y) + 3 * ptrdiff_t{x};
      for (int c = 0; c < 3; ++c) pixel.rgb[c] = from[c] << kMeanBits;
      act(pixel);
    });
  }

  // Returns true if a patch within `reach` of patch (column, row) has pixels of the nearer surface
  // of an edge or, if `near` is false, of the farther surface.
  bool HasWithin(int32_t column, int32_t row, int32_t reach, bool near) const {
    return AnyPixel(Clipped(Around(column, row, reach), memory.columns, memory.rows),
                    [&](int32_t x, int32_t y) {
                      const size_t at = memory.At(x, y);
                      if (!memory.HasEdge(at)) return false;
                      return near ? memory.IsNear(at, memory.greatest[at])
                                  : !memory.IsNear(at, memory.least[at]);
                    });
  }

  // Finds the position of a pixel's colour on the line from the background colour to the foreground
  // colour. Without contrast, the share is the one that the map implies. `own` is the share of the
  // pixel's own colour in the background colour, as a fraction of kWhole.
  Unmixed Unmix(const PatchPixel& pixel, int32_t own) const {
    int32_t far[3], near[3];
    ColourAt(memory.far, pixel.x, pixel.y, far);
    ColourAt(memory.near, pixel.x, pixel.y, near);
    for (int c = 0; c < 3; ++c) {
      far[c] = (own * pixel.rgb[c] + (kWhole - own) * far[c] + kWhole / 2) / kWhole;
    }
    const int32_t given = pixel.is_near ? kWhole : 0;
    const int32_t beside = SquaredDifference(far, pixel.rgb);
    const int32_t contrast = SquaredDifference(far, near);
    const int32_t known = Clamp(contrast - kLeastContrast, 0, kLeastContrast);
    if (known == 0) return {given, beside, contrast};
    // By the law of cosines, the position is (beside + contrast - distance to `near`) / 2 contrast.
    const int32_t twice = beside + contrast - SquaredDifference(near, pixel.rgb);
    const int32_t share = Clamp(twice, 0, 2 * contrast) * (kWhole / 2) / contrast;
    return {given + (share - given) * known / kLeastContrast, beside, contrast};
  }

  // Counts the pixels of an inside patch.
  void CountInside(int32_t column, int32_t row, HairVotes* votes) const {
    int32_t count = 0, sum = 0, squares = 0;
    ForPatch(column, row, [&](const PatchPixel& pixel) {
      if (!IsSample(pixel)) return;
      const Unmixed unmixed = Unmix(pixel, 0);
      ++count;
      sum += unmixed.share;
      squares += unmixed.share * unmixed.share;
      const bool clear = unmixed.contrast > kClearContrast;
      votes->far += clear && 9 * unmixed.beside < unmixed.contrast ? 1 : 0;
      votes->same += unmixed.beside < kSame ? 1 : 0;
    });
    votes->inside += count;
    votes->sum += sum;
    votes->squares += squares;
    votes->fine += squares - sum * sum / Max(count, 1);
  }

  // Calls act(votes, weight) for the blocks that are at most `reach` blocks away. The weight
  // decreases with the distance, from (reach + 1)^2 to 1.
  template <class Act>
  void ForBlocksAround(int32_t column, int32_t row, int32_t reach, const Act& act) const {
    ForPixels(Clipped(Around(column, row, reach), memory.block_columns, memory.block_rows),
              [&](int32_t x, int32_t y) {
                act(memory.VotesAt(x, y),
                    (reach + 1 - Abs(x - column)) * (reach + 1 - Abs(y - row)));
              });
  }

  // Decides to what degree the colours in and around a block are those of hair, 0 to 256. They are
  // if three shares are large: the share of pixels that look like background; the share of pixels
  // that have nearly its colour, which surfaces that happen to resemble the background rarely have;
  // and the part of the variance of the coverage that lies within patches, because shading varies
  // slowly. They are not if pixels outside look like foreground: the foreground colour is then one
  // of a pattern of the background, which the map covers by mistake. All limits lie between the
  // values of scenes with hair and those of scenes and photographs without (docs/constants.md).
  int32_t FindHair(int32_t column, int32_t row) const {
    // 2048 votes against hair decide where there are few pixels.
    int64_t inside = 2048, outside = 1, far = 0, same = 0, beyond = 0, coarse = 1, fine = 0;
    ForBlocksAround(column, row, 3, [&](const HairVotes& votes, int32_t weight) {
      const int64_t sum = votes.sum;
      inside += weight * votes.inside;
      far += weight * votes.far;
      same += weight * votes.same;
      if (votes.inside > 0) coarse += weight * (votes.squares - sum * sum / votes.inside);
      fine += weight * votes.fine;
      outside += weight * votes.outside;
      beyond += weight * votes.beyond;
    });
    // Product of both shares of colours, in units of 1/16384.
    const int64_t colours = (far << 14) / inside * same / inside;
    // Strands as wide as a patch are less fine, but many pixels between them have equal colours.
    const int64_t fineness = 1024 * fine / coarse + std::min<int64_t>(colours / 16, 120);
    const int32_t like = Fade(colours, 50, 70) * Fade(fineness, 652, 678) / 256;
    return like * (256 - Fade(1024 * beyond / (kWhole * outside), 36, 48)) / 256;
  }
};

}  // namespace

ColourPyramid TakeColourPyramid(int32_t width, int32_t height, Arena* arena) {
  ColourPyramid pyramid = {};
  pyramid.columns = (width + kHairPatch - 1) / kHairPatch;
  pyramid.rows = (height + kHairPatch - 1) / kHairPatch;
  int32_t patches = 0;
  for (int32_t k = 0; patches != 1; pyramid.count = ++k) {
    patches = pyramid.Columns(k) * pyramid.Rows(k);
    pyramid.levels[k] = arena->Take<ColourMean>(static_cast<size_t>(patches));
  }
  return pyramid;
}

bool CarryOnColours(const ColourPyramid& pyramid) {
  const int32_t last = pyramid.count - 1;
  for (int32_t k = 1; k <= last; ++k) {
    const int32_t columns = pyramid.Columns(k - 1), rows = pyramid.Rows(k - 1);
    ForPixels({0, 0, pyramid.Columns(k), pyramid.Rows(k)}, [&](int32_t x, int32_t y) {
      ColourSum<int64_t> sum;
      ForPixels(Clipped({2 * x, 2 * y, 2, 2}, columns, rows), [&](int32_t column, int32_t row) {
        const ColourMean& mean = pyramid.At(k - 1, column, row);
        sum.Add(mean.rgb, kUnit * mean.weight);
      });
      pyramid.At(k, x, y) = MeanOf(sum);
    });
  }
  for (int32_t k = last - 1; k >= 0; --k) {
    ForPixels({0, 0, pyramid.Columns(k), pyramid.Rows(k)}, [&](int32_t x, int32_t y) {
      ColourMean& patch = pyramid.At(k, x, y);
      const int32_t known = patch.weight;
      int32_t around[3];
      ColourOfLevel<2>(pyramid, k + 1, x, y, around);
      for (int c = 0; c < 3; ++c) {
        const int32_t mixed = known * patch.rgb[c] + (kFullyKnown - known) * around[c];
        patch.rgb[c] = static_cast<uint16_t>((mixed + kFullyKnown / 2) >> kKnownBits);
      }
    });
  }
  return pyramid.At(last, 0, 0).weight != 0;
}

void ColourAt(const ColourPyramid& pyramid, int32_t x, int32_t y, int32_t* rgb) {
  ColourOfLevel<kHairPatch>(pyramid, 0, x, y, rgb);
}

HairMemory TakeHairMemory(int32_t width, int32_t height, Arena* arena) {
  const auto divided = [](int32_t size, int32_t by) { return (size + by - 1) / by; };
  HairMemory memory = {};
  memory.width = width;
  memory.height = height;
  memory.columns = divided(width, kHairPatch);
  memory.rows = divided(height, kHairPatch);
  memory.block_columns = divided(memory.columns, kHairBlock);
  memory.block_rows = divided(memory.rows, kHairBlock);
  const size_t patches = memory.At(0, memory.rows);
  for (int16_t** range : {&memory.least, &memory.greatest, &memory.low, &memory.high}) {
    *range = arena->Take<int16_t>(patches);
  }
  memory.hair = arena->Take<uint8_t>(patches);
  memory.far = TakeColourPyramid(width, height, arena);
  memory.near = TakeColourPyramid(width, height, arena);
  memory.votes =
      arena->Take<HairVotes>(static_cast<size_t>(memory.block_columns * memory.block_rows));
  return memory;
}

bool FindHairCoverage(const Plane<const uint8_t>& rgb, const Plane<const int16_t>& disparity,
                      const Plane<uint8_t>& coverage, const HairMemory& memory, Sequence* run) {
  const HairSearch search = {rgb, disparity, coverage, memory};
  bool found = true;
  // Runs a phase of the search. When the phase has finished all patches, `conclude` processes the
  // results for the whole picture. The search ends if `conclude` returns false.
  const auto phase = [&](void (HairSearch::*work)(const Range&) const, const auto& conclude) {
    if (!found) return run->Skip();
    run->Run([&](int32_t index, int32_t) {
      (search.*work)(PartOf({0, memory.block_rows}, index, run->count()));
    });
    found = run->status() == STARFOCUS_OK && conclude();
  };
  const auto always = [] { return true; };
  phase(&HairSearch::MeasurePatches, [&] { return search.JoinPatches(); });
  phase(&HairSearch::PullFar, [&] { return CarryOnColours(memory.far); });
  phase(&HairSearch::PullNear, [&] { return CarryOnColours(memory.near); });
  phase(&HairSearch::CountVotes, [&] { return search.FillHair(); });
  phase(&HairSearch::UnmixPatches<false>, always);
  phase(&HairSearch::PullBoth,
        [&] { return CarryOnColours(memory.far) && CarryOnColours(memory.near); });
  phase(&HairSearch::UnmixPatches<true>, always);
  return found;
}

bool HasHair(const HairMemory& memory, const Rect& rect) {
  const int32_t left = rect.x / kHairPatch, top = rect.y / kHairPatch;
  const int32_t right = (rect.x + rect.width - 1) / kHairPatch;
  const int32_t bottom = (rect.y + rect.height - 1) / kHairPatch;
  return AnyPixel({left, top, right - left + 1, bottom - top + 1},
                  [&](int32_t x, int32_t y) { return memory.hair[memory.At(x, y)] >= kHairy; });
}

void CompleteCoverage(const HairMemory& memory, const Range& columns, int32_t y,
                      const int16_t* disparity, uint8_t* coverage, uint8_t* confidence) {
  for (int32_t k = 0; k < columns.last - columns.first; ++k) {
    const int32_t column = (columns.first + k) / kHairPatch, row = y / kHairPatch;
    const size_t at = memory.At(column, row);
    const uint8_t hair = memory.hair[at];
    const bool is_near = !memory.HasEdge(at) || memory.IsNear(at, disparity[k]);
    const int32_t given = is_near ? UINT8_MAX : 0;
    coverage[k] = static_cast<uint8_t>(hair == 0 ? given : Faded(given, coverage[k], hair));
    if (hair == 0 || confidence == nullptr) continue;
    confidence[k] = static_cast<uint8_t>(UINT8_MAX - Abs(coverage[k] - given));
  }
}

}  // namespace starfocus
