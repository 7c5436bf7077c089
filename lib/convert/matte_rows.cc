// SPDX-License-Identifier: Apache-2.0
#include "lib/convert/matte_rows.h"

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr int kPositionBits = 12;  // of the position between two samples
constexpr int kWeightBits = 14;    // of the weights of splines
constexpr int kRowBits = 6;        // of the alpha of resampled rows

// Returns the weights of four samples at the position t between the second and the third sample.
MatteTaps SplineAt(int32_t first, int64_t t) {
  constexpr int64_t kOne = int64_t{1} << kPositionBits;
  constexpr int kShift = 3 * kPositionBits + 1 - kWeightBits;
  const int64_t square = t * t * kOne, cube = t * t * t, line = t * kOne * kOne;
  const auto a = static_cast<int32_t>(RoundShift(2 * square - cube - line, kShift));
  const auto c = static_cast<int32_t>(RoundShift(line + 4 * square - 3 * cube, kShift));
  const auto d = static_cast<int32_t>(RoundShift(cube - square, kShift));
  return {first, 4, {a, (1 << kWeightBits) - a - c - d, c, d}, false};
}

}  // namespace

int32_t MatteAxis::total() const { return averages() ? samples : 1 << kWeightBits; }

MatteTaps MatteAxis::At(int32_t pixel) const {
  const int64_t begin = int64_t{pixel} * samples, end = begin + samples;
  if (averages()) {
    // In units of which a sample has `pixels`, and a pixel has `samples`.
    const int64_t first = begin / pixels, last = (end - 1) / pixels;
    return {static_cast<int32_t>(first),
            static_cast<int32_t>(last - first + 1),
            {static_cast<int32_t>((first + 1) * pixels - begin), pixels,
             static_cast<int32_t>(end - last * pixels)},
            true};
  }
  constexpr int64_t kOne = int64_t{1} << kPositionBits;
  // Middle of the pixel; the middle of sample s is at s + 1/2.
  const int64_t at = ((begin + end) * kOne / pixels + kOne) / 2;  // one sample added, so at > 0
  const int64_t sample = (at >> kPositionBits) - 1;
  return SplineAt(static_cast<int32_t>(sample - 1), at & (kOne - 1));
}

MatteRows::MatteRows(const starfocus_matte& matte, int32_t width, int32_t height, int32_t x,
                     int32_t count)
    : matte_(matte), across_{matte.width, width}, down_{matte.height, height}, count_(count) {
  for (int32_t k = 0; k < count; ++k) columns_[k] = across_.At(x + k);
}

const int16_t* MatteRows::Row(int32_t row) {
  const int32_t y = Clamp(row, 0, matte_.height - 1), slot = y % kHeld;
  int16_t* const to = rows_[slot];
  if (held_[slot] == y) return to;
  held_[slot] = y;
  const int32_t step = Max(1, matte_.pixel_stride);
  const uint8_t* const from = matte_.data + static_cast<size_t>(y) * matte_.stride;
  for (int32_t k = 0; k < count_; ++k) {
    const MatteTaps& taps = columns_[k];
    int32_t sum = 0;
    for (int32_t n = 0; n < taps.count; ++n) {
      const int32_t sample = Clamp(taps.first + n, 0, matte_.width - 1);
      sum += taps.Weight(n) * from[static_cast<size_t>(sample) * static_cast<size_t>(step)];
    }
    const int32_t total = across_.total();
    to[k] = static_cast<int16_t>(taps.averages ? ((sum << kRowBits) + total / 2) / total
                                               : RoundShift(sum, kWeightBits - kRowBits));
  }
  return to;
}

void MatteRows::Read(int32_t y, uint8_t* alpha) {
  const MatteTaps taps = down_.At(y);
  int32_t sums[kMattePiece] = {};
  for (int32_t n = 0; n < taps.count; ++n) {
    const int32_t weight = taps.Weight(n);
    const int16_t* const row = Row(taps.first + n);
    for (int32_t k = 0; k < count_; ++k) sums[k] += weight * row[k];
  }
  const int64_t total = int64_t{down_.total()} << kRowBits;
  for (int32_t k = 0; k < count_; ++k) {
    const int64_t mean =
        taps.averages ? (sums[k] + total / 2) / total : RoundShift(sums[k], kWeightBits + kRowBits);
    alpha[k] = static_cast<uint8_t>(Clamp(static_cast<int32_t>(mean), 0, 255));
  }
}

}  // namespace starfocus
