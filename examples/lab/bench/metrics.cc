// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/bench/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace starfocus::bench {
namespace {

double PsnrOf(uint64_t squares, uint64_t samples) {
  if (squares == 0) return kBestPsnr;
  return std::min(kBestPsnr, 10 * std::log10(255.0 * 255.0 * double(samples) / double(squares)));
}

uint64_t Squares(const uint8_t* a, const uint8_t* b, size_t count) {
  uint64_t sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const int difference = int{a[i]} - int{b[i]};
    sum += uint64_t(difference * difference);
  }
  return sum;
}

using Plane = std::vector<float>;

Plane Luma(const Image& image) {
  Plane luma(image.pixels.size() / 3);
  for (size_t i = 0; i < luma.size(); ++i) {
    const uint8_t* p = image.pixels.data() + 3 * i;
    luma[i] = 0.299f * p[0] + 0.587f * p[1] + 0.114f * p[2];
  }
  return luma;
}

constexpr int kTaps = 11;

std::array<float, kTaps> Window() {
  std::array<float, kTaps> taps;
  float sum = 0;
  for (int i = 0; i < kTaps; ++i) {
    const double x = (i - kTaps / 2) / 1.5;
    sum += taps[size_t(i)] = float(std::exp(-0.5 * x * x));
  }
  for (float& tap : taps) tap /= sum;
  return taps;
}

// Returns the weighted mean of each window that lies completely inside the plane.
Plane Means(const Plane& in, int width, int height) {
  static const std::array<float, kTaps> taps = Window();
  const int w = width - kTaps + 1, h = height - kTaps + 1;
  Plane rows(size_t(w) * size_t(height), 0), out(size_t(w) * size_t(h), 0);
  for (int y = 0; y < height; ++y) {
    float* target = rows.data() + size_t(y) * size_t(w);
    for (int t = 0; t < kTaps; ++t) {
      const float* source = in.data() + size_t(y) * size_t(width) + t;
      for (int x = 0; x < w; ++x) target[x] += taps[size_t(t)] * source[x];
    }
  }
  for (int y = 0; y < h; ++y) {
    float* target = out.data() + size_t(y) * size_t(w);
    for (int t = 0; t < kTaps; ++t) {
      const float* source = rows.data() + size_t(y + t) * size_t(w);
      for (int x = 0; x < w; ++x) target[x] += taps[size_t(t)] * source[x];
    }
  }
  return out;
}

Plane Product(const Plane& a, const Plane& b) {
  Plane product(a.size());
  for (size_t i = 0; i < a.size(); ++i) product[i] = a[i] * b[i];
  return product;
}

// Marks every pixel of a line that is at most `radius` pixels from a marked pixel. The line has
// `count` pixels, `step` bytes apart.
void Spread(int count, size_t step, int radius, const uint8_t* in, uint8_t* out) {
  int last = -radius - 1;
  for (int i = 0; i < count; ++i) {
    if (in[size_t(i) * step] != 0) last = i;
    if (i - last <= radius) out[size_t(i) * step] = 1;
  }
  last = count + radius;
  for (int i = count - 1; i >= 0; --i) {
    if (in[size_t(i) * step] != 0) last = i;
    if (last - i <= radius) out[size_t(i) * step] = 1;
  }
}

}  // namespace

double Psnr(const Image& a, const Image& b) {
  return PsnrOf(Squares(a.pixels.data(), b.pixels.data(), a.pixels.size()), a.pixels.size());
}

double MaskedPsnr(const Image& a, const Image& b, const Mask& mask) {
  uint64_t squares = 0, samples = 0;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    squares += Squares(a.pixels.data() + 3 * i, b.pixels.data() + 3 * i, 3);
    samples += 3;
  }
  return PsnrOf(squares, samples);
}

double WorstBlockPsnr(const Image& a, const Image& b) {
  double worst = kBestPsnr;
  for (int y0 = 0; y0 < a.height; y0 += kBlock) {
    for (int x0 = 0; x0 < a.width; x0 += kBlock) {
      const int rows = std::min(kBlock, a.height - y0);
      const size_t samples = 3 * size_t(std::min(kBlock, a.width - x0));
      uint64_t squares = 0;
      for (int y = y0; y < y0 + rows; ++y) {
        squares += Squares(a.row(y) + 3 * x0, b.row(y) + 3 * x0, samples);
      }
      worst = std::min(worst, PsnrOf(squares, samples * uint64_t(rows)));
    }
  }
  return worst;
}

double Ssim(const Image& a, const Image& b) {
  if (a.width < kTaps || a.height < kTaps) return 1;
  const double c1 = 6.5025, c2 = 58.5225;  // constants of SSIM: (0.01 * 255)^2, (0.03 * 255)^2
  const Plane p = Luma(a), q = Luma(b);
  const auto mean = [&](const Plane& plane) { return Means(plane, a.width, a.height); };
  const Plane mp = mean(p), mq = mean(q);
  const Plane pp = mean(Product(p, p)), qq = mean(Product(q, q)), pq = mean(Product(p, q));
  double sum = 0;
  for (size_t i = 0; i < mp.size(); ++i) {
    const double m = double(mp[i]) * mq[i], m2 = double(mp[i]) * mp[i] + double(mq[i]) * mq[i];
    const double covariance = pq[i] - m, variances = double(pp[i]) + qq[i] - m2;
    sum += (2 * m + c1) * (2 * covariance + c2) / ((m2 + c1) * (variances + c2));
  }
  return sum / double(mp.size());
}

Mask EdgeBand(const FloatMap& disparity, int radius) {
  const int width = disparity.width, height = disparity.height;
  Mask edges(disparity.values.size(), 0);
  const auto mark = [&](int x, int y, int x2, int y2) {
    if (!(std::fabs(disparity.at(x, y) - disparity.at(x2, y2)) > 1)) return;
    edges[size_t(y) * size_t(width) + size_t(x)] = 1;
    edges[size_t(y2) * size_t(width) + size_t(x2)] = 1;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (x + 1 < width) mark(x, y, x + 1, y);
      if (y + 1 < height) mark(x, y, x, y + 1);
    }
  }
  Mask wide(edges.size(), 0), band(edges.size(), 0);
  for (int y = 0; y < height; ++y) {
    const size_t row = size_t(y) * size_t(width);
    Spread(width, 1, radius, edges.data() + row, wide.data() + row);
  }
  for (int x = 0; x < width; ++x) {
    Spread(height, size_t(width), radius, wide.data() + x, band.data() + x);
  }
  return band;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double Spread(const std::vector<double>& values) {
  const double median = Median(values);
  if (median == 0) return 0;
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::fabs(value - median));
  return Median(distances) / median;
}

double Quantile(std::vector<float> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = q * double(values.size() - 1);
  const auto low = static_cast<size_t>(place);
  const size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - double(low)) * (double(values[high]) - values[low]);
}

}  // namespace starfocus::bench
