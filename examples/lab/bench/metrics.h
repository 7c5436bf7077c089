// SPDX-License-Identifier: Apache-2.0
// Computes error metrics of pictures, and statistics of run times. Used by the bench and tested by
// bench_test.cc.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_METRICS_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_METRICS_H_

#include <cstdint>
#include <vector>

#include "platform/image.h"
#include "platform/pfm.h"

namespace starfocus::bench {

// PSNR in dB that is returned for equal pictures. The value is finite, so that means and plots are
// finite.
inline constexpr double kBestPsnr = 99.0;
inline constexpr int kBlock = 16;  // side of the blocks of WorstBlockPsnr, pixels

using Mask = std::vector<uint8_t>;  // selected pixels of a picture: one byte per pixel, 0 or 1

// Returns the PSNR of all R, G, B samples in dB.
double Psnr(const Image& a, const Image& b);
// Returns the PSNR of the pixels of a mask in dB, or kBestPsnr if the mask is empty.
double MaskedPsnr(const Image& a, const Image& b, const Mask& mask);
// Returns the PSNR of the worst 16x16 block in dB. Blocks at the right and bottom edges are
// smaller.
double WorstBlockPsnr(const Image& a, const Image& b);
// Returns the mean structural similarity of the luma. The window is an 11x11 Gaussian with
// sigma 1.5, at all positions inside the picture. Returns 1 for pictures smaller than the window.
double Ssim(const Image& a, const Image& b);

// Returns the pixels at most `radius` rows and columns from a depth edge, which is a step of more
// than 1 between neighbours.
Mask EdgeBand(const FloatMap& disparity, int radius);

// Returns the median, or 0 if `values` is empty.
double Median(std::vector<double> values);
// Returns the median absolute deviation from the median, divided by the median.
double Spread(const std::vector<double>& values);
// Returns a quantile with linear interpolation between the sorted values; q is in [0, 1].
double Quantile(std::vector<float> values, double q);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_METRICS_H_
