// SPDX-License-Identifier: Apache-2.0
// Stores sampled PSFs and filters, and computes their squared differences.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_SAMPLED_PSF_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_SAMPLED_PSF_H_

#include <cstddef>
#include <vector>

namespace starfocus::analysis {

// Taps b[n] of a 1D filter for |n| <= radius. Taps with |n| > radius are zero.
class Taps {
 public:
  explicit Taps(int radius) : radius_(radius), taps_(static_cast<size_t>(2 * radius + 1)) {}

  int radius() const { return radius_; }
  double& at(int n) { return taps_[static_cast<size_t>(n + radius_)]; }
  double operator()(int n) const {
    return n < -radius_ || n > radius_ ? 0 : taps_[static_cast<size_t>(n + radius_)];
  }
  double Sum() const;
  void Scale(double factor);

 private:
  int radius_;
  std::vector<double> taps_;
};

// Taps b[n, m] of a 2D PSF for |n|, |m| <= radius. Taps with |n| or |m| > radius are zero.
class SampledPsf {
 public:
  explicit SampledPsf(int radius)
      : radius_(radius), taps_(static_cast<size_t>(2 * radius + 1) * (2 * radius + 1)) {}

  int radius() const { return radius_; }
  double& at(int n, int m) { return taps_[Index(n, m)]; }
  double operator()(int n, int m) const {
    const bool inside = n >= -radius_ && n <= radius_ && m >= -radius_ && m <= radius_;
    return inside ? taps_[Index(n, m)] : 0;
  }
  double Sum() const;
  void Scale(double factor);

 private:
  size_t Index(int n, int m) const {
    return static_cast<size_t>(n + radius_) * (2 * radius_ + 1) + static_cast<size_t>(m + radius_);
  }

  int radius_;
  std::vector<double> taps_;
};

// Returns the sum of squared differences between two PSFs, as in (8) and (10).
double SquaredError(const SampledPsf& a, const SampledPsf& b);
double SquaredError(const Taps& a, const Taps& b);

// Returns the sum of the squared taps, as in (11).
double Energy(const SampledPsf& psf);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_SAMPLED_PSF_H_
