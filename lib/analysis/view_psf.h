// SPDX-License-Identifier: Apache-2.0
// The PSFs of refocusing by rendered views (5)-(7): the paper's with the triangular h, and that of
// subapertures.
#ifndef STARFOCUS_LIB_ANALYSIS_VIEW_PSF_H_
#define STARFOCUS_LIB_ANALYSIS_VIEW_PSF_H_

#include <vector>

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// Returns a box of `width` > 0 integrated over a pixel, at distance t from the pixel's centre. A
// width of 1 gives the triangular h, a width near 0 the nearest pixel.
double Trapezoid(double t, double width);

// Selects whether views with u^2 + v^2 = 1 are rendered. (3) includes them.
enum class Rim { kIncluded, kExcluded };

// Returns the PSF (5)-(7) for N views along the aperture radius, N >= 1, where h(x, y) is the
// trapezoid of `width` along either axis.
SampledPsf ViewPsf(double r, int n, double theta, double width, Rim rim = Rim::kIncluded);

// Returns the PSF with the triangular h of the paper.
SampledPsf PaperPsf(double r, int n, double theta, Rim rim = Rim::kIncluded);

// Share of the light of a lens that passes through the subaperture around each of its views (i, j).
class SubapertureLights {
 public:
  // Makes the lens of N views along the radius, as wide as LensInSubapertures computes.
  SubapertureLights(int n, double theta);
  // Returns a lens `lens` / kSubapertureUnits subapertures wide, > 0.
  static SubapertureLights OfLens(int lens, double theta) { return {theta, lens}; }

  int lens() const { return lens_; }
  int views() const;
  double operator()(int i, int j) const;

 private:
  SubapertureLights(double theta, int lens);

  int lens_;
  std::vector<double> lights_;  // of 0 <= j <= i
};

// Returns the PSF of views that stand for their subapertures: h is as wide as the distance that a
// pixel moves from view to view. N = 0 is the centre view alone, the unit impulse.
SampledPsf SubaperturePsf(double r, const SubapertureLights& lights);
SampledPsf SubaperturePsf(double r, int n, double theta);

// Returns the paper's PSF with the 1D aperture, whose views are |i| <= N.
Taps PaperPsf1(double r, int n, double theta);

// Returns a_{d,N}[i] of (5) for the 1D aperture.
Taps SampledAperture1(int n, double theta);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_VIEW_PSF_H_
