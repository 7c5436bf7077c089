// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/deblock.h"

#include "lib/io/deep.h"
#include "lib/plan/partition.h"

namespace starfocus {
namespace {

// Returns true if the boundary between blocks of layers `before` and `after` must be deblocked.
bool Meet(int32_t before, int32_t after) {
  return before != after && before != kNoLayer && after != kNoLayer;
}

// Rows of codes.
class CodeRows {
 public:
  explicit CodeRows(const Deblocking& stripe) : stripe_(stripe), plane_(stripe.out.codes) {}

  bool AreClose(size_t a, size_t b) const {
    const auto differ = [&](size_t c) {
      return Abs(plane_.data[a + c] - plane_.data[b + c]) >= stripe_.beta;
    };
    return !differ(0) && !differ(1) && !differ(2);
  }

  // Sets pixel q to the mean of pixels a and b: a share of (4 - part) / 4 and part / 4.
  void Mix(size_t q, size_t a, size_t b, int32_t part) const {
    const int16_t* const light = stripe_.transfer->light;
    for (size_t c = 0; c < 3; ++c) {
      const int32_t sum = (4 - part) * light[plane_.data[a + c]] + part * light[plane_.data[b + c]];
      const auto mean = static_cast<int16_t>((sum + 2) >> 2);
      stripe_.kernels->Encode(&mean, 1, *stripe_.transfer, plane_.data + q + c);
    }
  }

  const Plane<uint8_t>& plane() const { return plane_; }

 private:
  const Deblocking& stripe_;
  const Plane<uint8_t>& plane_;
};

// Rows of deep pixels, whose codes are compared after their light is clipped at white.
class DeepRows {
 public:
  explicit DeepRows(const Deblocking& stripe) : stripe_(stripe), plane_(stripe.out.deep) {}

  bool AreClose(size_t a, size_t b) const {
    for (size_t c = 0; c < 3; ++c) {
      if (Abs(CodeAt(a + c) - CodeAt(b + c)) >= stripe_.beta) return false;
    }
    return true;
  }

  void Mix(size_t q, size_t a, size_t b, int32_t part) const {
    const auto mean = [&](int32_t first, int32_t second) {
      return ((4 - part) * first + part * second + 2) >> 2;
    };
    for (size_t c = 0; c < 3; ++c) {
      plane_.data[q + c] =
          DeepOfLight(mean(LightOfDeep(plane_.data[a + c]), LightOfDeep(plane_.data[b + c])));
    }
    uint16_t* const alpha = stripe_.out.alpha.data;
    alpha[q / 3] = static_cast<uint16_t>(mean(alpha[a / 3], alpha[b / 3]));
  }

  const Plane<uint16_t>& plane() const { return plane_; }

 private:
  int32_t CodeAt(size_t at) const {
    const auto light = static_cast<int16_t>(Min(plane_.data[at], kLightWhite));
    uint8_t code;
    stripe_.kernels->Encode(&light, 1, *stripe_.transfer, &code);
    return code;
  }

  const Deblocking& stripe_;
  const Plane<uint16_t>& plane_;
};

// Filters pixels q0, q1, ... on the finer side of a boundary. `q` is the index of the first sample
// of q0, `step` is the distance between pixels in samples, away from the boundary, and p0 is the
// pixel before q0. `available` is the number of pixels on the finer side.
template <class Rows>
void FilterLine(const Deblocking& stripe, size_t q, ptrdiff_t step, int32_t available,
                bool strong) {
  const Rows rows(stripe);
  const auto at = [&](ptrdiff_t pixel) { return q + static_cast<size_t>(pixel * step); };
  if (strong && available > 3 && rows.AreClose(at(-1), at(3))) {
    for (ptrdiff_t k = 0; k < 3; ++k) {
      rows.Mix(at(k), at(-1), at(3), static_cast<int32_t>(k) + 1);
    }
  } else if (available > 1 && rows.AreClose(at(-1), at(1))) {
    rows.Mix(q, at(-1), at(1), 2);
  }
}

// Filters a boundary between blocks of layers `before` and `after`, along `count` pixels, from
// pixel (x, y) on, down the rows if `down` is true. `room` is the number of pixels from the
// boundary on, perpendicular to it, that are inside the picture.
void FilterBoundary(const Deblocking& stripe, int32_t before, int32_t after, int32_t x, int32_t y,
                    int32_t count, bool down, int32_t room) {
  const bool deep = stripe.out.is_deep(), lower_after = before > after;
  const size_t stride = deep ? stripe.out.deep.stride : stripe.out.codes.stride;
  const int32_t first = deep ? stripe.out.deep.first : stripe.out.codes.first;
  const ptrdiff_t across = down ? 3 : static_cast<ptrdiff_t>(stride);
  const size_t along = down ? stride : 3;
  const size_t at = static_cast<size_t>(y - first) * stride + 3 * static_cast<size_t>(x);
  size_t q = lower_after ? at : at - static_cast<size_t>(across);
  const ptrdiff_t step = lower_after ? across : -across;
  const int32_t available = lower_after ? room : kSmallestBlock;
  const bool strong = Max(before, after) == 2;
  for (int32_t k = 0; k < count; ++k, q += along) {
    deep ? FilterLine<DeepRows>(stripe, q, step, available, strong)
         : FilterLine<CodeRows>(stripe, q, step, available, strong);
  }
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
      FilterBoundary(stripe, before, after, x, y, Min(kSmallestBlock, stripe.width - x), false,
                     Min(kSmallestBlock, stripe.height - y));
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
      FilterBoundary(stripe, before, after, x, y, 1, true, Min(kSmallestBlock, stripe.width - x));
    }
  }
}

}  // namespace starfocus
