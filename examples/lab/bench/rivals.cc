// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/bench/rivals.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace starfocus::bench {
namespace {

constexpr int kOne = 64;  // interpolation weight 1.0

struct Shift {
  int whole, part;  // the shift is whole + part / kOne, 0 <= part < kOne
};

Shift Deinterleave(double shift) {
  const int value = int(std::lround(shift * kOne));
  const int whole = int(std::floor(double(value) / kOne));
  return {whole, value - whole * kOne};
}

// Interpolates between the rows a and b. Compilers vectorize this loop.
void Mix(const uint8_t* a, const uint8_t* b, int part, size_t count, uint8_t* out) {
  const auto second = uint16_t(part), first = uint16_t(kOne - part);
  for (size_t i = 0; i < count; ++i) {
    out[i] = uint8_t(uint16_t(a[i] * first + b[i] * second + kOne / 2) >> 6);
  }
}

void AddMixed(const uint8_t* a, int part, uint16_t weight, size_t count, uint16_t* sum) {
  const auto second = uint16_t(part), first = uint16_t(kOne - part);
  const uint8_t* b = a + 3;
  for (size_t i = 0; i < count; ++i) {
    const auto value = uint16_t(uint16_t(a[i] * first + b[i] * second + kOne / 2) >> 6);
    sum[i] = uint16_t(sum[i] + value * weight);
  }
}

// Returns the share of each view: the part of the disc of the aperture that is nearer to this view
// than to other views. The shares sum to 256, so that weighted sums of bytes fit into 16 bits. The
// centre view gets the remainder of rounding.
std::vector<uint16_t> DiscShares(int views) {
  constexpr int kSteps = 100;
  std::vector<int> counts(size_t(views), 0);
  int all = 0;
  for (int j = -kSteps; j <= kSteps; ++j) {
    for (int i = -kSteps; i <= kSteps; ++i) {
      if (i * i + j * j > kSteps * kSteps) continue;
      int nearest = 0;
      double least = 9;
      for (int k = 0; k < views; ++k) {
        double u = 0, v = 0;
        starfocus_view_position(k, &u, &v, nullptr);
        const double distance = std::hypot(u - double(i) / kSteps, v - double(j) / kSteps);
        if (distance < least) least = distance, nearest = k;
      }
      ++counts[size_t(nearest)];
      ++all;
    }
  }
  std::vector<uint16_t> weights;
  int sum = 0;
  for (const int count : counts) {
    weights.push_back(uint16_t(256 * count / all));
    sum += weights.back();
  }
  weights[0] = uint16_t(weights[0] + 256 - sum);
  return weights;
}

}  // namespace

ShiftAndAdd::ShiftAndAdd(const LightField& data, int views, double focus)
    : data_(data), views_(views), focus_(focus) {
  const auto width = size_t(data.width());
  pad_ = 3 * (int(std::ceil(std::fabs(focus))) + 2);
  row_.resize(3 * width + 2 * size_t(pad_));
  sum_.resize(3 * width);
  weights_ = DiscShares(views);
}

void ShiftAndAdd::AddView(const Image& view, int index, int y) {
  double u = 0, v = 0;
  starfocus_view_position(index, &u, &v, nullptr);
  const Shift dx = Deinterleave(-u * focus_), dy = Deinterleave(-v * focus_);
  const auto row = [&](int n) { return view.row(std::clamp(n, 0, view.height - 1)); };
  const size_t samples = view.stride();
  uint8_t* middle = row_.data() + pad_;
  const uint8_t* upper = row(y + dy.whole);
  if (dy.part == 0) {
    std::memcpy(middle, upper, samples);
  } else {
    Mix(upper, row(y + dy.whole + 1), dy.part, samples, middle);
  }
  for (int i = 0; i < pad_; ++i) {
    middle[-1 - i] = middle[2 - i % 3];
    middle[samples + size_t(i)] = middle[samples - 3 + size_t(i % 3)];
  }
  AddMixed(middle + 3 * dx.whole, dx.part, weights_[size_t(index)], samples, sum_.data());
}

void ShiftAndAdd::Run(Image* out) {
  for (int y = 0; y < out->height; ++y) {
    std::fill(sum_.begin(), sum_.end(), uint16_t{128});
    for (int i = 0; i < views_; ++i) AddView(data_.views[size_t(i)], i, y);
    uint8_t* target = out->row(y);
    for (size_t i = 0; i < sum_.size(); ++i) target[i] = uint8_t(sum_[i] >> 8);
  }
}

}  // namespace starfocus::bench
