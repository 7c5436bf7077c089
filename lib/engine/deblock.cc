// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/deblock.h"

#include "lib/plan/partition.h"

namespace starfocus {
namespace {

// Returns true if the boundary between blocks of layers `before` and `after` must be deblocked.
bool Meet(int32_t before, int32_t after) {
  return before != after && before != kNoLayer && after != kNoLayer;
}

bool Close(const uint8_t* a, const uint8_t* b, int32_t beta) {
  return Abs(a[0] - b[0]) < beta && Abs(a[1] - b[1]) < beta && Abs(a[2] - b[2]) < beta;
}

// Filters pixels q0, q1, ... on the finer side of a boundary. `step` is the distance between pixels
// in bytes, away from the boundary, and p0 is the pixel before q0. `available` is the number of
// pixels on the finer side.
void FilterLine(const Deblocking& stripe, uint8_t* q, ptrdiff_t step, int32_t available,
                bool strong) {
  const uint8_t* p0 = q - step;
  const int16_t* light = stripe.transfer->light;
  const auto code = [&](int32_t sum, int bits) {
    const auto mean = static_cast<int16_t>((sum + (1 << bits >> 1)) >> bits);
    uint8_t result;
    stripe.kernels->Encode(&mean, 1, *stripe.transfer, &result);
    return result;
  };
  if (strong && available > 3 && Close(p0, q + 3 * step, stripe.beta)) {
    const uint8_t* q3 = q + 3 * step;
    for (int c = 0; c < 3; ++c) {
      const int32_t p = light[p0[c]], far = light[q3[c]];
      q[c] = code(3 * p + far, 2);
      q[step + c] = code(2 * p + 2 * far, 2);
      q[2 * step + c] = code(p + 3 * far, 2);
    }
  } else if (available > 1 && Close(p0, q + step, stripe.beta)) {
    for (int c = 0; c < 3; ++c) q[c] = code(light[p0[c]] + light[q[step + c]], 1);
  }
}

// Filters a boundary between blocks of layers `before` and `after`, along `count` pixels that are
// `along` bytes apart and start at `at`. Pixels across the boundary are `across` bytes apart.
// `room` is the number of pixels from `at`, perpendicular to the boundary, that are inside the
// picture.
void FilterBoundary(const Deblocking& stripe, int32_t before, int32_t after, uint8_t* at,
                    int32_t count, ptrdiff_t along, ptrdiff_t across, int32_t room) {
  const bool lower_after = before > after;
  uint8_t* q = lower_after ? at : at - across;
  const ptrdiff_t step = lower_after ? across : -across;
  const int32_t available = lower_after ? room : kSmallestBlock;
  const bool strong = Max(before, after) == 2;
  for (int32_t k = 0; k < count; ++k, q += along) FilterLine(stripe, q, step, available, strong);
}

}  // namespace

void DeblockRowBoundaries(const Deblocking& stripe, const Range& columns) {
  const LayerMap& map = *stripe.map;
  for (int32_t row = stripe.y == 0 ? 1 : 0; row < map.rows; ++row) {
    const int32_t y = stripe.y + row * kSmallestBlock;
    for (int32_t column = columns.first; column < columns.last; ++column) {
      const int32_t before = map.At(column, row - 1), after = map.At(column, row);
      if (!Meet(before, after)) continue;
      const int32_t x = column * kSmallestBlock;
      FilterBoundary(
          stripe, before, after, stripe.out.Row(y) + 3 * x, Min(kSmallestBlock, stripe.width - x),
          3, static_cast<ptrdiff_t>(stripe.out.stride), Min(kSmallestBlock, stripe.height - y));
    }
  }
}

void DeblockColumnBoundaries(const Deblocking& stripe, const Range& rows) {
  const LayerMap& map = *stripe.map;
  for (int32_t y = rows.first; y < rows.last; ++y) {
    const int32_t row = (y - stripe.y + kSmallestBlock) / kSmallestBlock - 1;
    for (int32_t column = 1; column < map.columns; ++column) {
      const int32_t before = map.At(column - 1, row), after = map.At(column, row);
      if (!Meet(before, after)) continue;
      const int32_t x = column * kSmallestBlock;
      FilterBoundary(stripe, before, after, stripe.out.Row(y) + 3 * x, 1, 0, 3,
                     Min(kSmallestBlock, stripe.width - x));
    }
  }
}

}  // namespace starfocus
