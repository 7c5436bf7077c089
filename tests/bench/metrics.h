// SPDX-License-Identifier: Apache-2.0
// What the bench makes of pictures and times.
#ifndef STARFOCUS_TESTS_BENCH_METRICS_H_
#define STARFOCUS_TESTS_BENCH_METRICS_H_

#include <cstdint>
#include <vector>

#include "platform/image.h"
#include "platform/pfm.h"

namespace starfocus::bench {

// Equal pictures have this PSNR, so that means and plots stay finite.
inline constexpr double kBestPsnr = 99.0;
inline constexpr int kBlock = 16;

using Mask = std::vector<uint8_t>;  // one byte per pixel, 0 or 1

// Over all R, G, B samples, in dB.
double Psnr(const Image& a, const Image& b);
// Over the pixels of a mask; kBestPsnr when there are none.
double MaskedPsnr(const Image& a, const Image& b, const Mask& mask);
// The lowest PSNR of any 16x16 block (smaller at the right and lower edge).
double WorstBlockPsnr(const Image& a, const Image& b);
// Mean structural similarity of the luma: Gaussian window of 11x11, sigma 1.5, over the places
// where it fits; 1 for pictures smaller than the window.
double Ssim(const Image& a, const Image& b);

// Pixels at most `radius` rows and columns from a step of more than 1 between neighbours.
Mask EdgeBand(const FloatMap& disparity, int radius);

double Median(std::vector<double> values);  // 0 of none
// Median distance from the median, as a share of the median.
double Spread(const std::vector<double>& values);
// Linear interpolation between the sorted values, q in [0, 1].
double Quantile(std::vector<float> values, double q);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_METRICS_H_
