// SPDX-License-Identifier: Apache-2.0
#include "lib/video/fuse.h"

#include <cstdlib>
#include <utility>

namespace starfocus {
namespace {

// Largest number of measurements of a mean. With more, the mean would lag behind a surface that
// comes nearer.
constexpr int32_t kMostCount = 8;
// Another surface replaces the surface of a pixel if it has more measurements, or more than this.
constexpr int32_t kMostVotes = 4;
// Largest number of frames of the mean of coverage.
constexpr int32_t kMostCovers = 3;
// Largest distance of wrong pixels of a map from its outlines, in pixels.
constexpr int32_t kOutline = 5;
// Pixels within this distance of each other decide together whether they keep their surfaces, so
// that outlines stay smooth.
constexpr int32_t kTogether = 3;

// Returns value / count, rounded to the nearest, for |value| < 2^15 and 1 <= count <= kMostCount
// + 1.
int32_t Rounded(int32_t value, int32_t count) {
  static constexpr int32_t kInverses[] = {0,     65536, 32768, 21845, 16384,
                                          13107, 10923, 9362,  8192,  7282};
  static_assert(kMostCount + 2 == sizeof kInverses / sizeof *kInverses);
  return (value * kInverses[count] + (1 << 15)) >> 16;
}

// Returns true if the map shows a surface within kOutline of pixel (x, y).
bool IsBeside(const Fusion& f, int32_t x, int32_t y, int32_t surface) {
  return AnyPixel(Clipped(Around(x, y, kOutline), f.width, f.height), [&](int32_t ax, int32_t ay) {
    const int32_t given = f.given.Row(ay)[ax];
    return given != simd::kNoSurface && std::abs(Drifted(f.of_map, given) - surface) <= f.tolerance;
  });
}

Relation RelationOf(const Fusion& f, int32_t x, int32_t y) {
  const int32_t count = f.count.Row(y)[x], given = f.given.Row(y)[x];
  if (count == 0) return Relation::kNew;
  if (given == simd::kNoSurface) return Relation::kSame;
  const int32_t measured = Drifted(f.of_map, given);
  const int32_t own = Drifted(f.of_before, f.disparity.Row(y)[x]);
  if (std::abs(measured - own) <= f.tolerance) return Relation::kSame;
  const int32_t others = f.others.Row(y)[x];
  const int32_t second = Drifted(f.of_before, f.other.Row(y)[x]);
  const bool joins = others > 0 && std::abs(measured - second) <= f.tolerance;
  const bool wins = (joins ? others + 1 : 1) > Min(count, kMostVotes);
  return wins || !IsBeside(f, x, y, own) ? Relation::kReplaced : Relation::kKept;
}

// Returns true if most pixels around a pixel whose measurement is on another surface keep theirs.
bool KeepsSurface(const Fusion& f, int32_t x, int32_t y) {
  int32_t kept = 0, replaced = 0;
  ForPixels(Clipped(Around(x, y, kTogether), f.width, f.height), [&](int32_t ax, int32_t ay) {
    const auto relation = static_cast<Relation>(f.relations.Row(ay)[ax]);
    kept += relation == Relation::kKept ? 1 : 0;
    replaced += relation == Relation::kReplaced || relation == Relation::kNew ? 1 : 0;
  });
  return kept > replaced;
}

// A pixel of a fusion.
struct Pixel {
  int32_t own, second, count, others;

  // Adds a measurement on the surface. The mean stays within half the tolerance of it, because
  // surfaces may come nearer.
  void Add(int32_t measured, int32_t tolerance) {
    own += Rounded(measured - own, count + 1);
    own = Clamp(own, measured - tolerance / 2, measured + tolerance / 2);
    count = Min(count + 1, kMostCount);
    others = Max(others - 1, 0);
  }

  // Adds a measurement on another surface.
  void AddOther(int32_t measured, int32_t tolerance, bool keeps) {
    const bool joins = others > 0 && std::abs(measured - second) <= tolerance;
    second = joins ? second + Rounded(measured - second, others + 1) : measured;
    others = joins ? Min(others + 1, kMostCount) : 1;
    if (!keeps) {
      std::swap(own, second);
      std::swap(count, others);
      others = Min(others, count);
    } else if (count > 1) {
      --count;
    }
  }
};

}  // namespace

void RelateRows(const Fusion& f, const Range& rows) {
  for (int32_t y = rows.first; y < rows.last; ++y) {
    uint8_t* const relations = f.relations.Row(y);
    const int16_t *const given = f.given.Row(y), *const known = f.disparity.Row(y);
    const uint8_t* const count = f.count.Row(y);
    for (int32_t x = 0; x < f.width; ++x) {
      // Most pixels are on their surface.
      const int32_t step = Drifted(f.of_map, given[x]) - Drifted(f.of_before, known[x]);
      const bool is_same = (count[x] != 0) & (step <= f.tolerance) & (step >= -f.tolerance);
      relations[x] = static_cast<uint8_t>(is_same ? Relation::kSame : Relation::kNew);
    }
    for (int32_t x = 0; x < f.width; ++x) {
      if (static_cast<Relation>(relations[x]) == Relation::kSame) continue;
      relations[x] = static_cast<uint8_t>(RelationOf(f, x, y));
    }
  }
}

namespace {

// Fuses a pixel whose measurement is on another surface, or which has no surface yet.
Pixel Replaced(const Fusion& f, int32_t x, int32_t y, bool* keeps) {
  const int32_t given = f.given.Row(y)[x], measured = Drifted(f.of_map, given);
  const int32_t count = f.count.Row(y)[x];
  *keeps = false;
  if (count == 0) return {measured, 0, given == simd::kNoSurface ? 0 : 1, 0};
  Pixel pixel = {Drifted(f.of_before, f.disparity.Row(y)[x]),
                 Drifted(f.of_before, f.other.Row(y)[x]), count, f.others.Row(y)[x]};
  *keeps = KeepsSurface(f, x, y);
  pixel.AddOther(measured, f.tolerance, *keeps);
  return pixel;
}

}  // namespace

int64_t FuseRows(const Fusion& f, const Range& rows) {
  int64_t kept = 0;
  for (int32_t y = rows.first; y < rows.last; ++y) {
    const uint8_t* const relations = f.relations.Row(y);
    const int16_t* const given = f.given.Row(y);
    int16_t *const disparity = f.disparity.Row(y), *const other = f.other.Row(y);
    uint8_t *const count = f.count.Row(y), *const others = f.others.Row(y);
    const uint8_t* const covers = f.coverage.data != nullptr ? f.given_coverage.Row(y) : nullptr;
    uint8_t* const coverage = covers != nullptr ? f.coverage.Row(y) : nullptr;
    for (int32_t x = 0; x < f.width; ++x) {
      const int32_t counted = count[x];
      bool keeps = true;
      Pixel pixel = {Drifted(f.of_before, disparity[x]), Drifted(f.of_before, other[x]), counted,
                     others[x]};
      if (static_cast<Relation>(relations[x]) != Relation::kSame) {
        pixel = Replaced(f, x, y, &keeps);
      } else if (given[x] != simd::kNoSurface) {
        pixel.Add(Drifted(f.of_map, given[x]), f.tolerance);
      }
      kept += keeps ? 1 : 0;
      disparity[x] = static_cast<int16_t>(pixel.own);
      other[x] = static_cast<int16_t>(pixel.second);
      count[x] = static_cast<uint8_t>(pixel.count);
      others[x] = static_cast<uint8_t>(pixel.others);
      if (covers == nullptr) continue;
      const int32_t weight = keeps ? Min(counted + 1, kMostCovers) : 1;
      coverage[x] = static_cast<uint8_t>(coverage[x] + Rounded(covers[x] - coverage[x], weight));
    }
  }
  return kept;
}

}  // namespace starfocus
