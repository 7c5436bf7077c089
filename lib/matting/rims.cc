// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/rims.h"

#include <cstring>

namespace starfocus {
namespace {

// Unit of the differences in RimSums, in light.
constexpr int32_t kUnit = 1 << (kLightBits - 3);
constexpr int64_t kSquareOne = 64;  // square of one code, in these units
// Number of clean pixels of a line. The near colour is read at the third near pixel, because a rim
// also contaminates the near surface.
constexpr int32_t kClean = kRimEnd - kRimWidth, kNearDepth = 3;
// Largest change of disparity within one surface along a line, kDisparityBits.
constexpr int32_t kSameRim = kRimStep / 2;
// Squared mean difference that noise explains: 2/255 of white in each channel.
constexpr int64_t kNoise = 12 * kSquareOne;
// Squared contrast, 8/255 of white in one channel, that is added to all contrasts.
constexpr int64_t kLeastContrast = 64 * kSquareOne;
// Number of neighbouring lines that count as one, because textures are coherent.
constexpr int64_t kDependent = 16;
// Number of lines at which a rim begins to count; twice as many count fully.
constexpr int64_t kLeastLines = 12;
constexpr int kFadeBits = 8;
constexpr int64_t kFadeOne = 1 << kFadeBits;

// Returns value / whole, limited to 0..1, in kFadeBits.
int64_t Fade(int64_t value, int64_t whole) {
  return value <= 0 ? 0 : value >= whole ? kFadeOne : value * kFadeOne / whole;
}

int64_t Larger(int64_t a, int64_t b) { return a > b ? a : b; }

// Sums the lines of the patches of one row.
class RimSummer {
 public:
  RimSummer(const Input& input, int32_t row) : input_(input), top_(row * kRimPatch) {
    for (int32_t k = 0; k < kSide; ++k) {
      rows_[k] = input.disparity.Row(Clamp(top_ + k - kReach, 0, input.height - 1));
    }
  }

  // Sums the lines of the patches of some columns. Most patches are far from outlines, so several
  // patches are tested at once.
  void Sum(const Range& columns, RimSums* sums) {
    constexpr int32_t kAtOnce = 8;
    for (int32_t first = columns.first, last; first < columns.last; first = last) {
      last = Min(first + kAtOnce, columns.last);
      left_ = first * kRimPatch;
      const bool inside = left_ > 0 && (first + kAtOnce + 2) * kRimPatch <= input_.width;
      const bool has_step = !inside || HasStep(last - first);
      for (int32_t column = first; column < last; ++column, ++sums) {
        sums->lines = 0;  // The other sums are not read.
        if (has_step) SumPatch(column, sums);
      }
    }
  }

 private:
  static constexpr int32_t kReach = kRimEnd - 1, kSide = kRimPatch + 2 * kReach;

  // Sums the lines of a patch. Patches at the edge of the picture, where lines may leave the
  // picture, have no lines.
  void SumPatch(int32_t column, RimSums* sums) {
    left_ = column * kRimPatch;
    if (top_ < kReach || top_ + kRimPatch + kReach > input_.height) return;
    if (left_ < kReach || left_ + kRimPatch + kReach > input_.width || !HasStep(1)) return;
    std::memset(sums, 0, sizeof(*sums));
    loaded_ = false;
    for (int32_t y = top_; y < top_ + kRimPatch; ++y) {
      if (!HasEdge(y)) continue;
      for (int32_t x = left_; x < left_ + kRimPatch; ++x) {
        const int32_t edge = Disparity(x, y) + kRimStep;
        for (int side = 0; side < kSideCount; ++side) {
          if (Disparity(x + kSides[side][0], y + kSides[side][1]) > edge) AddLine(x, y, side, sums);
        }
      }
    }
  }

  // Returns true if any pixel of row y of the patch is beside a nearer surface. Compilers vectorize
  // the loop.
  bool HasEdge(int32_t y) const {
    const int16_t* const row = rows_[y - top_ + kReach] + left_;
    const int16_t *const above = rows_[y - top_ + kReach - 1] + left_,
                         *const below = rows_[y - top_ + kReach + 1] + left_;
    int32_t edges = 0;
    for (int32_t x = 0; x < kRimPatch; ++x) {
      const int16_t aside = Max(row[x - 1], row[x + 1]), beside = Max(above[x], below[x]);
      edges |= static_cast<int32_t>(Max(aside, beside) > row[x] + kRimStep);
    }
    return edges != 0;
  }

  int32_t Disparity(int32_t x, int32_t y) const { return rows_[y - top_ + kReach][x]; }
  int16_t* Light(int32_t x, int32_t y) {
    return light_[y - top_ + kReach] + 3 * (x - left_ + kReach);
  }

  // Returns false if the disparities of up to 8 patches and of the pixels around them are so
  // similar that they contain no outline. The rows of a ring are not contiguous at its end.
  bool HasStep(int32_t patches) const {
    int32_t low = INT16_MAX, high = INT16_MIN;
    const auto count = static_cast<size_t>(patches * kRimPatch + 2);
    const auto stride = static_cast<ptrdiff_t>(input_.disparity.stride);
    constexpr int32_t kEnd = kReach + kRimPatch + 1;
    for (int32_t first = kReach - 1, next; first < kEnd; first = next) {
      for (next = first + 1; next < kEnd && rows_[next] - rows_[next - 1] == stride;) ++next;
      simd::DisparityRange ranges[(8 * kRimPatch + 2) / simd::kSliceLanes + 1];
      input_.kernels->FindRanges(rows_[first] + left_ - 1, input_.disparity.stride,
                                 static_cast<size_t>(next - first), count, ranges);
      for (size_t k = 0; k * simd::kSliceLanes < count; ++k) {
        low = Min(low, ranges[k].low);
        high = Max(high, ranges[k].high);
      }
    }
    return high - low > kRimStep;
  }

  // Returns true if no outline along the other axis is nearer to a pixel than `distance`.
  bool IsNearest(int32_t x, int32_t y, int side, int32_t distance) const {
    const int32_t dx = kSides[side][1], dy = kSides[side][0], edge = Disparity(x, y) + kRimStep;
    for (int32_t k = 1; k < distance; ++k) {
      if (Disparity(x + k * dx, y + k * dy) > edge) return false;
      if (Disparity(x - k * dx, y - k * dy) > edge) return false;
    }
    return true;
  }

  // Returns true if the line from pixel (x, y) away from the near surface stays on the far surface,
  // and the line towards side `side` on the near surface.
  bool IsLine(int32_t x, int32_t y, int side) const {
    const int32_t dx = kSides[side][0], dy = kSides[side][1], here = Disparity(x, y);
    const int32_t near = Disparity(x + kNearDepth * dx, y + kNearDepth * dy);
    if (Abs(near - Disparity(x + dx, y + dy)) > kSameRim) return false;
    for (int32_t k = 1; k <= kReach; ++k) {
      if (Abs(Disparity(x - k * dx, y - k * dy) - here) > kSameRim) return false;
    }
    return true;
  }

  // Adds the line from the far pixel (x, y) away from the near surface on side `side`.
  void AddLine(int32_t x, int32_t y, int side, RimSums* sums) {
    if (!IsLine(x, y, side)) return;
    for (int32_t k = 0; !loaded_ && k < kSide; ++k) {
      input_.Light(0, left_ - kReach, top_ - kReach + k, kSide, light_[k]);
    }
    loaded_ = true;
    const int32_t dx = kSides[side][0], dy = kSides[side][1];
    int32_t clean[3] = {0, 0, 0};
    for (int32_t k = kRimWidth; k < kRimEnd; ++k) {
      const int16_t* const light = Light(x - k * dx, y - k * dy);
      for (int c = 0; c < 3; ++c) clean[c] += light[c];
    }
    const auto difference = [&](const int16_t* light, int c) {
      return (kClean * light[c] - clean[c]) / (kClean * kUnit);
    };
    const int16_t* const near = Light(x + kNearDepth * dx, y + kNearDepth * dy);
    const int16_t* const first = Light(x - kRimWidth * dx, y - kRimWidth * dy);
    const int16_t* const last = Light(x - kReach * dx, y - kReach * dy);
    for (int c = 0; c < 3; ++c) {
      sums->near[c] += difference(near, c);
      sums->slope[c] += (first[c] - last[c]) / kUnit;
    }
    ++sums->lines;
    for (int32_t k = 0; k < kRimWidth; ++k) {
      const int32_t far_x = x - k * dx, far_y = y - k * dy;
      if (!IsNearest(far_x, far_y, side, k + 1)) continue;
      const int16_t* const far = Light(far_x, far_y);
      ++sums->count[k];
      for (int c = 0; c < 3; ++c) {
        const int32_t excess = difference(far, c);
        sums->excess[k][c] += excess;
        sums->squares[k] += static_cast<uint32_t>(excess * excess);
      }
    }
  }

  const Input& input_;
  const int32_t top_;  // first row of pixels of the patches
  int32_t left_ = 0;   // first column of pixels of the current patch
  const int16_t* rows_[kSide];
  bool loaded_ = false;  // true if `light_` belongs to the current patch
  int16_t light_[kSide][3 * kSide + simd::kPadding / sizeof(int16_t)];
};

// Sums of the patches around a patch.
using RimTotal = RimSumsOf<int64_t, int64_t>;

void AddSums(const RimSums& sums, RimTotal* total) {
  if (sums.lines == 0) return;
  for (int k = 0; k < kRimWidth; ++k) {
    for (int c = 0; c < 3; ++c) total->excess[k][c] += sums.excess[k][c];
    total->squares[k] += sums.squares[k];
    total->count[k] += sums.count[k];
  }
  for (int c = 0; c < 3; ++c) {
    total->near[c] += sums.near[c];
    total->slope[c] += sums.slope[c];
  }
  total->lines += sums.lines;
}

// Returns how clearly the pixels at a distance of k + 1 belong to a rim, in kFadeBits. All along
// the outlines, pixels of a rim differ from the clean pixels by the same colour, roughly a
// multiple of the difference between the near surface and the clean pixels: a negative one in a
// halo, a positive one if the pixels contain light of the near surface. Textures differ from line
// to line, and gradients continue in the clean pixels.
int32_t WeightOf(const RimTotal& total, int k) {
  const int64_t count = total.count[k];
  if (count <= kLeastLines) return 0;
  int64_t square = 0, along = 0, contrast = kLeastContrast, slopes = 0;
  for (int c = 0; c < 3; ++c) {
    const int64_t mean = total.excess[k][c] / count, other = total.near[c] / total.lines;
    square += mean * mean;
    along += mean * other;
    contrast += other * other;
    slopes += total.slope[c] * total.slope[c] / (total.lines * total.lines);
  }
  // Next to an outline, light of the near surface is an ordinary mixture (FindMixture).
  const bool is_halo = along < 0;
  if (k == 0 && !is_halo) return 0;
  const int64_t spread = total.squares[k] / count - square;
  const int64_t by_chance = spread * Larger(kDependent, (is_halo ? count : 3 * count) / 2);
  // The slope is that of 3 pixels, and the middle of the clean pixels is away / 2 pixels away.
  const int64_t away = 2 * kRimWidth + kClean - 1 - 2 * k;
  const int64_t limit = kNoise + by_chance / count + slopes * away * away / 18;
  const int64_t beside = square - along * along / contrast;
  const int64_t clear = Fade(square - limit, limit);
  const int64_t aligned = Fade(13 * square - 16 * beside, 3 * square);
  const int64_t size = is_halo ? -along : along;
  const int64_t large = Fade(32 * size - contrast, contrast);
  const int64_t small = Fade(2 * contrast - (is_halo ? 3 : 6) * size, contrast);
  const int64_t enough = Fade(count - kLeastLines, kLeastLines);
  return static_cast<int32_t>(
      ((clear * aligned * large >> (2 * kFadeBits)) * enough >> kFadeBits) * small >> kFadeBits);
}

// Returns true if a patch of a column has lines.
bool HasLines(const RimMap& map, int32_t column, const Range& rows) {
  for (int32_t row = rows.first; row < rows.last; ++row) {
    if (map.sums[map.At(column, row)].lines > 0) return true;
  }
  return false;
}

// Finds the rim in a patch, whose rim must be empty. A rim has no gap: no pixel counts more than a
// pixel between itself and the outline. Only the first pixel may count less, because it may be an
// ordinary mixture.
void FindRim(const RimMap& map, int32_t column, int32_t row, PatchRim* rim) {
  RimTotal total = {};
  ForPixels(Clipped(Around(column, row, kRimAround), map.columns, map.Rows()),
            [&](int32_t x, int32_t y) { AddSums(map.sums[map.At(x, y)], &total); });
  if (total.lines <= kLeastLines) return;
  int32_t weight = kWholeRim;
  for (int k = 1; k < kRimWidth && weight > 0; ++k) {
    weight = Min(weight, WeightOf(total, k));
    rim->weight[k] = static_cast<uint8_t>(weight);
  }
  const int32_t first = Max(rim->weight[1], WeightOf(total, 0));
  rim->weight[0] = static_cast<uint8_t>(Min(first, kWholeRim));
  for (int k = 0; k < kRimWidth && rim->weight[k] > 0; ++k) {
    for (int c = 0; c < 3; ++c) {
      rim->excess[k][c] = static_cast<int16_t>(total.excess[k][c] * kUnit / total.count[k]);
    }
  }
}

}  // namespace

void TakeRims(const FullConfig& config, int32_t border, Arena* arena, RimMap* map) {
  if (!HasRims(config)) return;
  map->width = config.width;
  map->height = config.height;
  map->columns = (config.width + kRimPatch - 1) / kRimPatch;
  map->rows = (config.superblock + 2 * border) / kRimPatch + 2 * kRimAround + 2;
  const auto columns = static_cast<size_t>(map->columns), rows = static_cast<size_t>(map->rows);
  map->sums = arena->Take<RimSums>(columns, rows);
  map->rims = arena->Take<PatchRim>(columns, rows);
}

void ForgetRims(RimMap* map) { map->summed = map->found = -1; }

starfocus_status FindRims(const FullConfig& config, const Input& input, const Range& rows,
                          Jobs* jobs, RimMap* map) {
  const int32_t top = Max(0, rows.first) / kRimPatch;
  const int32_t end = Min(map->Rows(), (rows.last + kRimPatch - 1) / kRimPatch);
  const int32_t side = config.superblock / kRimPatch;
  // Calls run(column, row) for all patches of `of_patches` that are not known; *known is the first
  // row that is not known, or -1.
  const auto for_each = [&](const Range& of_patches, int32_t* known, const auto& run) {
    const Range unknown = {*known < 0 ? of_patches.first : *known, of_patches.last};
    const starfocus_status status =
        ForEach((map->columns + side - 1) / side, jobs, [&](int32_t index, int32_t) {
          for (int32_t row = unknown.first; row < unknown.last; ++row) {
            run({index * side, Min((index + 1) * side, map->columns)}, row);
          }
        });
    if (status == STARFOCUS_OK) *known = Max(unknown.first, unknown.last);
    return status;
  };
  const starfocus_status status =
      for_each({Max(0, top - kRimAround), Min(map->Rows(), end + kRimAround)}, &map->summed,
               [&](const Range& columns, int32_t row) {
                 RimSummer(input, row).Sum(columns, &map->sums[map->At(columns.first, row)]);
               });
  if (status != STARFOCUS_OK) return status;
  return for_each({top, end}, &map->found, [&](const Range& columns, int32_t row) {
    const Range around = {Max(0, row - kRimAround), Min(map->Rows(), row + kRimAround + 1)};
    int32_t next = Max(0, columns.first - kRimAround), last_line = -1;
    for (int32_t column = columns.first; column < columns.last; ++column) {
      for (; next < map->columns && next <= column + kRimAround; ++next) {
        if (HasLines(*map, next, around)) last_line = next;
      }
      PatchRim* const rim = &map->rims[map->At(column, row)];
      *rim = {};
      if (last_line >= 0 && last_line >= column - kRimAround) FindRim(*map, column, row, rim);
    }
  });
}

}  // namespace starfocus
