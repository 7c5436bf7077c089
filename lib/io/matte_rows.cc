// SPDX-License-Identifier: Apache-2.0
#include "lib/io/matte_rows.h"

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr int kPositionBits = 12;  // of positions between two samples
constexpr int kRowBits = 6;        // of the alpha of resampled rows

// Increase of the contrast by B-splines, in 1 / (1 << kSmoothBits), which makes up for the width of
// their outlines (docs/constants.md).
constexpr int32_t kContrast = 77;

// Returns the weights of four samples at the position t between the second and the third sample.
MatteTaps SplineAt(int32_t first, int64_t t, int64_t smooth) {
  constexpr int kCubeBits = 3 * kPositionBits;
  const int64_t one = int64_t{1} << kCubeBits, line = t << (2 * kPositionBits);
  const int64_t square = (t * t) << kPositionBits, cube = t * t * t;
  // Mixes the sixfold weights of a Catmull-Rom spline and a B-spline.
  const auto mix = [smooth](int64_t sharp, int64_t round) {
    constexpr int64_t kSix = 6, kPositive = 1 << kSplineBits;  // makes the dividend positive
    const int64_t sum = sharp * ((1 << kSmoothBits) - smooth) + round * smooth;
    const int64_t sixfold = RoundShift(sum, kCubeBits + kSmoothBits - kSplineBits);
    return static_cast<int32_t>((sixfold + kSix * kPositive + kSix / 2) / kSix - kPositive);
  };
  const int32_t a = mix(3 * (2 * square - cube - line), one - 3 * (line - square) - cube);
  const int32_t c = mix(3 * (line + 4 * square - 3 * cube), one + 3 * (line + square - cube));
  const int32_t d = mix(3 * (cube - square), cube);
  return {first, 4, {a, (1 << kSplineBits) - a - c - d, c, d}};
}

}  // namespace

// The B-spline avoids stairs in the outlines of small mattes. Where the matte is enlarged less, a
// Catmull-Rom spline keeps outlines sharp, and keeps the samples of mattes of the picture's size
// (docs/constants.md).
int32_t MatteAxis::Smooth() const {
  constexpr int64_t kSharp = 2, kSmooth = 8;  // enlargements
  const int64_t beyond = pixels - kSharp * samples;
  if (beyond <= 0) return 0;
  const int64_t part = (beyond << kSmoothBits) / ((kSmooth - kSharp) * samples);
  return static_cast<int32_t>(part < (1 << kSmoothBits) ? part : 1 << kSmoothBits);
}

MatteTaps MatteAxis::At(int32_t pixel) const {
  // On this scale, a sample is `pixels` long, and a pixel is `samples` long.
  const int64_t begin = int64_t{pixel} * samples, end = begin + samples;
  if (Averages()) {
    const int64_t first = begin / pixels, last = (end - 1) / pixels;
    return {static_cast<int32_t>(first),
            static_cast<int32_t>(last - first + 1),
            {static_cast<int32_t>((first + 1) * pixels - begin), pixels,
             static_cast<int32_t>(end - last * pixels)}};
  }
  // Middle of the pixel in samples. The middle of sample 0 is at 1, so that no position is
  // negative.
  constexpr int64_t kOne = int64_t{1} << kPositionBits;
  const int64_t at = (((begin + end) << kPositionBits) / pixels + kOne) / 2;
  const auto left = static_cast<int32_t>(at >> kPositionBits) - 1;
  return SplineAt(left - 1, at & (kOne - 1), Smooth());
}

MatteRows::MatteRows(const starfocus_matte& matte, int32_t width, int32_t height, int32_t x,
                     int32_t count)
    : matte_(matte),
      step_(static_cast<size_t>(Max(1, matte.pixel_stride))),
      across_{matte.width, width},
      down_{matte.height, height},
      count_(count),
      contrast_((1 << kSmoothBits) +
                ((across_.Smooth() + down_.Smooth()) * kContrast >> (kSmoothBits + 1))) {
  for (int32_t k = 0; k < count; ++k) columns_[k] = across_.At(x + k);
}

void MatteRows::AverageRow(const uint8_t* from, int16_t* to) const {
  for (int32_t k = 0; k < count_; ++k) {
    const MatteTaps& taps = columns_[k];
    const uint8_t* sample = from + static_cast<size_t>(taps.first) * step_;
    int32_t sum = taps.weights[0] * *sample, middle = 0;
    for (int32_t n = 2; n < taps.count; ++n) middle += *(sample += step_);
    sum += taps.weights[1] * middle + taps.weights[2] * sample[step_];
    to[k] = static_cast<int16_t>(((sum << kRowBits) + across_.samples / 2) / across_.samples);
  }
}

void MatteRows::InterpolateRow(const uint8_t* from, int16_t* to) const {
  const int32_t begin = columns_[0].first, end = columns_[count_ - 1].first + 4;
  uint8_t samples[kMattePiece + 4];
  for (int32_t x = begin; x < end; ++x) {
    samples[x - begin] = from[static_cast<size_t>(Clamp(x, 0, across_.samples - 1)) * step_];
  }
  for (int32_t k = 0; k < count_; ++k) {
    const int32_t* const weights = columns_[k].weights;
    const uint8_t* const four = samples + (columns_[k].first - begin);
    const int32_t sum =
        weights[0] * four[0] + weights[1] * four[1] + weights[2] * four[2] + weights[3] * four[3];
    to[k] = static_cast<int16_t>(RoundShift(sum, kSplineBits - kRowBits));
  }
}

const int16_t* MatteRows::Row(int32_t row) {
  const int32_t y = Clamp(row, 0, matte_.height - 1), slot = y % kHeld;
  if (held_[slot] != y) {
    held_[slot] = y;
    const uint8_t* const from = matte_.data + static_cast<size_t>(y) * matte_.stride;
    across_.Averages() ? AverageRow(from, rows_[slot]) : InterpolateRow(from, rows_[slot]);
  }
  return rows_[slot];
}

void MatteRows::Read(int32_t y, uint8_t* alpha) {
  const MatteTaps taps = down_.At(y);
  const bool averages = down_.Averages();
  int32_t sums[kMattePiece] = {};
  for (int32_t n = 0; n < taps.count; ++n) {
    const int32_t index = !averages ? n : n == 0 ? 0 : n == taps.count - 1 ? 2 : 1;
    const int32_t weight = taps.weights[index];
    const int16_t* const row = Row(taps.first + n);
    for (int32_t k = 0; k < count_; ++k) sums[k] += weight * row[k];
  }
  constexpr int32_t kMiddle = 255 << (kRowBits - 1);
  const int32_t total = down_.samples;
  for (int32_t k = 0; k < count_; ++k) {
    const int32_t mean = averages ? (sums[k] + total / 2) / total
                                  : (sums[k] + (1 << (kSplineBits - 1))) >> kSplineBits;
    const int32_t value = kMiddle + ((mean - kMiddle) * contrast_ >> kSmoothBits);
    const int32_t rounded = (value + (1 << (kRowBits - 1))) >> kRowBits;
    alpha[k] = static_cast<uint8_t>(Clamp(rounded, 0, 255));
  }
}

}  // namespace starfocus
