#include "simd/slices_ref.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace starfocus::simd::reference {
namespace {

int16_t Saturated(int32_t value) {
  return static_cast<int16_t>(value < INT16_MIN   ? INT16_MIN
                              : value > INT16_MAX ? INT16_MAX
                                                  : value);
}

// What one side shows behind a pixel.
struct HiddenSide {
  int rank;  // the nearer edge first, and those that a side view shows
  int16_t disparity;
  bool half;
};

constexpr int kNoRank = INT16_MAX;

// Whether something lies before the place behind a pixel in the view that moves by a pixel per
// `unit`; the `room` pixels towards the side are `step` apart.
bool IsCovered(const int16_t* at, ptrdiff_t step, int32_t room, int16_t disparity, int32_t unit) {
  for (int32_t u = 0; u <= room; ++u, at += step) {
    const int32_t nearer = *at - disparity;
    if (2 * nearer > unit && 4 * std::abs(nearer - u * unit) < 3 * unit) return true;
  }
  return false;
}

HiddenSide LookBehindSide(const DepthRow& row, int32_t x, int side) {
  const int32_t distance = row.edges[side][x], unit = 1 << row.unit_bits;
  if (distance == 0) return {kNoRank, kNoSurface, false};
  const ptrdiff_t along = side < 2 ? 1 : row.stride, step = side % 2 == 0 ? along : -along;
  const int32_t rooms[4] = {row.width - 1 - x, x, row.below, row.above};
  const int16_t* at = row.disparity + x;
  const int16_t disparity = at[step * distance];
  for (const bool half : {false, true}) {
    if (!row.side_views || (half && !row.half_views)) break;
    if (!IsCovered(at, step, rooms[side], disparity, half ? 2 * unit : unit)) {
      return {distance, disparity, half};
    }
  }
  return {distance + kUnseen, disparity, false};
}

// Writes pixel x of surface `behind` + 1, farther than `above` or nearer. Returns its disparity.
int16_t ChooseSurface(const HiddenSide* sides, int32_t x, int behind, int32_t unit, int16_t above,
                      const HiddenRow& hidden) {
  const HiddenSide* best = nullptr;
  for (const HiddenSide* side = sides; side < sides + 4; ++side) {
    if (side->rank == kNoRank) continue;
    if (behind > 0 && std::abs(side->disparity - above) <= unit) continue;
    const bool before = best == nullptr || side->rank < best->rank ||
                        (side->rank == best->rank && side->disparity > best->disparity);
    if (before) best = side;
  }
  int source = 0;
  for (int k = 0; best != nullptr && k < 4; ++k) {
    if (sides[k].rank != best->rank || sides[k].disparity != best->disparity) continue;
    source |= 1 << k | (sides[k].half ? 1 << (kSourceHalf + k) : 0);
    if (best->rank > kUnseen) source |= (best->rank - kUnseen) << kSourceDistance;
  }
  hidden.source[behind][x] = static_cast<uint16_t>(source);
  return hidden.disparity[behind][x] = best == nullptr ? kNoSurface : best->disparity;
}

// The product of two numbers of 15 fractional bits, halves up.
int16_t Product15(int32_t a, int32_t b) { return static_cast<int16_t>((a * b + (1 << 14)) >> 15); }

int16_t Between15(int16_t from, int16_t to, int16_t fraction) {
  return static_cast<int16_t>(to + Product15(to - from, fraction));
}

// Sample n of a plane and the next ones, `next` samples on, of which `covered` is the coverage.
int16_t Between15(const int16_t* at, const int16_t* covered, size_t next,
                  const SliceFraction& fraction) {
  const bool alike = covered[0] == covered[next];
  int value = Between15(at[0], at[next], alike ? fraction.inside : fraction.edge);
  if (fraction.third != 0) value += Product15(at[next] - at[2 * next], fraction.third);
  if (fraction.fourth != 0) value += Product15(at[2 * next] - at[3 * next], fraction.fourth);
  return static_cast<int16_t>(value);
}

// light / covered, both of kSliceOne, as a series: 1 - excess (1 + open + open^2), where the slice
// leaves `open`. Exact where it leaves nothing or the excess is small; at most 4 * light.
int16_t SliceShare(int16_t covered, int16_t light) {
  const int32_t excess = covered - light, open = kSliceOne - covered;
  const int16_t first = Product15(excess, open), second = Product15(first, open);
  const int32_t share = kSliceOne - Saturated(excess + first + second);
  return static_cast<int16_t>(share < 4 * light ? share : Saturated(4 * light));
}

}  // namespace

void Split(const uint8_t* rgb, size_t count, size_t plane, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t c = 0; c < 3; ++c) out[c * plane + n] = rgb[3 * n + c];
  }
}

void FindEdges(const int16_t* near, const int16_t* far, const EdgeLimits& limits, size_t count,
               int16_t* moved, int16_t* behind, uint8_t* distance) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    if (Saturated(near[n] - far[n]) > limits.step) {
      moved[n] = 0;
      behind[n] = far[n];
    } else {
      moved[n] = Saturated(moved[n] + (1 << limits.unit_bits));
    }
    const int16_t depth = Saturated(near[n] - behind[n]);
    const bool hides =
        depth > limits.step && moved[n] <= depth && moved[n] <= FarthestEdge(limits.unit_bits);
    distance[n] = static_cast<uint8_t>(hides ? (moved[n] >> limits.unit_bits) + 1 : 0);
  }
}

void FindSteps(const int16_t* row, size_t count, int16_t step, StepBits* steps) {
  for (size_t n = 0; n < count; ++n) {
    StepBits& bits = steps[n / kSliceLanes];
    if (n % kSliceLanes == 0) bits = {0, 0};
    const int fall = row[n] - row[n + 1], bit = 1 << n % kSliceLanes;
    bits.falls = static_cast<uint16_t>(bits.falls | (fall > step ? bit : 0));
    bits.rises = static_cast<uint16_t>(bits.rises | (-fall > step ? bit : 0));
  }
}

void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                 uint16_t* beside) {
  for (size_t n = 0; n < count; ++n) {
    uint16_t& bits = beside[n / kSliceLanes];
    if (n % kSliceLanes == 0) bits = 0;
    bool nearer = false;
    for (const ptrdiff_t next : {ptrdiff_t{1}, ptrdiff_t{-1}, stride, -stride}) {
      nearer = nearer || row[static_cast<ptrdiff_t>(n) + next] - row[n] > step;
    }
    bits = static_cast<uint16_t>(bits | (nearer ? 1 << n % kSliceLanes : 0));
  }
}

uint64_t LookBehind(const DepthRow& row, const HiddenRow& hidden) {
  uint64_t chunks = 0;
  for (int32_t x = 0; x < static_cast<int32_t>(SliceSamples(static_cast<size_t>(row.width))); ++x) {
    HiddenSide sides[4];
    bool end = false;
    for (int side = 0; side < 4; ++side) {
      sides[side] = LookBehindSide(row, x, side);
      end = end || row.edges[side][x] == 1;
    }
    hidden.share[x] = end ? kSliceEnd : static_cast<uint8_t>(kSliceWhole);
    const size_t chunk = static_cast<size_t>(x) / kSliceLanes;
    int16_t above = kNoSurface;
    for (int behind = 0; behind < kSurfaces - 1; ++behind) {
      above = ChooseSurface(sides, x, behind, 1 << row.unit_bits, above, hidden);
      const int bit = above != kNoSurface ? 1 << static_cast<size_t>(x) % kSliceLanes : 0;
      uint16_t& found = hidden.found[behind][chunk];
      found = static_cast<uint16_t>((static_cast<size_t>(x) % kSliceLanes == 0 ? 0 : found) | bit);
      if (bit != 0) chunks |= uint64_t{1} << chunk;
    }
  }
  return chunks;
}

void Interpolate(const uint8_t* here, const uint8_t* next, const uint8_t* weight, size_t plane,
                 uint8_t* out) {
  for (size_t n = 0; n < 3 * kSliceLanes; ++n) {
    const int sum = here[n] * (256 - weight[n / 3]) + next[n] * weight[n / 3];
    out[n % 3 * plane + n / 3] = static_cast<uint8_t>((sum + 128) >> 8);
  }
}

SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count, size_t plane,
                       int16_t* out) {
  SliceCover cover = {0, 0};
  for (size_t chunk = 0; chunk < count; chunk += kSliceLanes) {
    const uint64_t bit = uint64_t{1} << (chunk / kSliceLanes);
    cover.all |= bit;
    for (size_t n = chunk; n < chunk + kSliceLanes; ++n) {
      const bool hiding = (row.hiding & bit) != 0;
      const auto inside = [&](int surface) {
        const bool end = hiding && surface == 0 && row.share[n] != kSliceWhole;
        return row.disparity[surface][n] >= range.low &&
               row.disparity[surface][n] <= (end ? range.high : range.overlap);
      };
      int next = hiding ? 1 : kSurfaces;
      while (next < kSurfaces && !inside(next)) ++next;
      const int share = hiding && row.share[n] < kSliceWhole ? row.share[n] : kSliceWhole;
      const int front = inside(0) ? share : 0;
      const int behind = next < kSurfaces ? kSliceWhole - front : 0;
      const bool found = front + behind > 0, all = front + behind == kSliceWhole;
      for (size_t c = 0; c < 3; ++c) {
        const size_t at = c * row.plane + n;
        const int value = front * row.rgb[0][at] + (behind > 0 ? behind * row.rgb[next][at] : 0);
        out[c * plane + n] = static_cast<int16_t>(value);
      }
      out[3 * plane + n] = static_cast<int16_t>(((front + behind) << 8) - (all ? 1 : 0));
      if (n >= count) continue;
      if (found) cover.some |= bit;
      if (!all) cover.all &= ~bit;
    }
  }
  return cover;
}

void SpreadSlice(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                 int16_t* out) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    int32_t sum = Product15(in[n], taps.centre);
    for (int32_t k = 1; k <= taps.reach; ++k) {
      const int16_t* at = in + n;
      const int32_t mean = (at[-k * step] + at[k * step] + 1) >> 1;
      sum += Product15(mean, k < taps.reach ? taps.inner : taps.outer);
      if (sum > INT16_MAX) sum = INT16_MAX;
    }
    out[n] = static_cast<int16_t>(sum);
  }
}

void ShiftSlice(const SlicePlanes& in, const SliceFraction& fraction, size_t rows, size_t plane,
                int16_t* out, uint8_t* near) {
  size_t all_covered = 0;  // rows, one after the other
  for (size_t row = 0; row < rows; ++row) {
    const int16_t* covered = in.samples + (4 * row + 3) * in.plane;
    for (size_t c = 0; c < 4; ++c) {
      const int16_t* from = in.samples + (4 * row + c) * in.plane;
      int16_t* to = out + c * plane + row * kSliceLanes;
      for (size_t n = 0; n < kSliceLanes; ++n)
        to[n] = Between15(from + n, covered + n, 1, fraction);
    }
    const int16_t *shown = out + 3 * plane + row * kSliceLanes, *end = shown + kSliceLanes;
    uint8_t* first = near + row - kRowsAhead;
    if (std::any_of(shown, end, [](int16_t sample) { return sample != 0; })) {
      std::memset(first, kSomethingNear, kRowsAhead + 1);
    }
    const bool all = std::all_of(shown, end, [](int16_t sample) { return sample == kSliceOne; });
    all_covered = all ? all_covered + 1 : 0;
    if (all_covered > kRowsAhead) *first = kCoveredNear;
  }
}

void Composite(const SliceViews& views, size_t rows, uint32_t* sums) {
  for (size_t y = 0; y < rows; ++y, sums += 4 * kSliceLanes) {
    const size_t row = views.row + y;
    for (size_t n = 0; n < kSliceLanes; ++n) {
      for (size_t view = 0; view < views.views; ++view) {
        const int16_t weight = views.weights[view];
        int16_t light = kSliceOne;
        for (size_t k = 0; k < views.shown_count; ++k) {
          const TileSlice& slice = views.slices[views.shown[k]];
          const SliceOffset& offset = views.offsets[view * views.count + views.shown[k]];
          const ptrdiff_t moved = static_cast<ptrdiff_t>(row) + offset.whole;
          if (slice.near[moved] == kNothingNear) continue;
          const int16_t* from = slice.samples + moved * ptrdiff_t{kSliceLanes} + n;
          const auto value = [&](size_t c) {
            return Between15(from + c * slice.plane, from + 3 * slice.plane, kSliceLanes,
                             offset.fraction);
          };
          const int16_t covered = value(3);
          for (size_t c = 0; c < 4; ++c) {
            const int16_t lit =
                covered > light ? Product15(value(c), SliceShare(covered, light)) : value(c);
            sums[n + c * kSliceLanes] += static_cast<uint32_t>(Product15(weight, lit));
          }
          light = static_cast<int16_t>(covered > light ? 0 : light - covered);
        }
      }
    }
  }
}

void FinishComposite(const uint32_t* sums, size_t plane, const uint8_t* rgb,
                     const CompositeFinish& finish, size_t count, uint32_t* out) {
  const int shift = kInverseBits - 8 - finish.bits;
  const uint64_t white = uint64_t{255} << finish.bits, half = uint64_t{1} << (shift - 1);
  for (size_t n = 0; n < count; ++n) {
    const uint32_t covered = sums[3 * plane + n];
    const bool missing = covered < finish.least;
    const uint64_t inverse = missing ? 0 : (uint64_t{1} << kInverseBits) / covered;
    for (size_t c = 0; c < 3; ++c) {
      const uint64_t value = (sums[c * plane + n] * inverse + half) >> shift;
      out[3 * n + c] = missing ? uint32_t{rgb[3 * n + c]} << finish.bits
                               : static_cast<uint32_t>(value < white ? value : white);
    }
  }
}

}  // namespace starfocus::simd::reference
