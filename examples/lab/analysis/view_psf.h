// SPDX-License-Identifier: Apache-2.0
// Computes the PSFs of refocusing by rendered views, (5) to (7): the paper's PSF, with the
// triangular h, the PSF of subapertures, and the PSF of interpolated views of the star.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_VIEW_PSF_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_VIEW_PSF_H_

#include <vector>

#include "examples/lab/analysis/ideal.h"

namespace starfocus::analysis {

// Returns the integral, over a pixel, of a box of `width` > 0 whose centre is at distance t from
// the pixel's centre. With a width of 1, the result is the triangular h. With a width near 0, the
// result is nearest-pixel interpolation.
double Trapezoid(double t, double width);

// Selects whether views with u^2 + v^2 = 1 are rendered. The aperture (3) includes the views on its
// rim.
enum class Rim { kIncluded, kExcluded };

// Returns the PSF (5)-(7) for N views along the aperture radius, N >= 1, where h(x, y) is the
// trapezoid of `width` along either axis.
SampledPsf ViewPsf(double r, int n, double theta, double width, Rim rim = Rim::kIncluded);

// Returns the PSF with the triangular h of the paper.
SampledPsf PaperPsf(double r, int n, double theta, Rim rim = Rim::kIncluded);

// The share of a lens's light that passes through the subaperture around each view (i, j).
class SubapertureLights {
 public:
  // Makes a lens with N views along its radius. The width of the lens is LensInSubapertures(n).
  SubapertureLights(int n, double theta);
  // Returns a lens that is `lens` / kSubapertureUnits subapertures wide; `lens` > 0.
  static SubapertureLights OfLens(int lens, double theta) { return {theta, lens}; }

  int lens() const { return lens_; }
  int views() const;
  double operator()(int i, int j) const;

 private:
  SubapertureLights(double theta, int lens);

  int lens_;
  std::vector<double> lights_;  // shares of light of the views (i, j) with 0 <= j <= i
};

// Returns the PSF of views that stand for their subapertures. The width of h is the distance by
// which a pixel moves from view to view. With N = 0, only the centre view is rendered, and the PSF
// is the unit impulse.
SampledPsf SubaperturePsf(double r, const SubapertureLights& lights);
SampledPsf SubaperturePsf(double r, int n, double theta);

// Returns the paper's PSF for the 1D aperture, which has the views |i| <= N.
Taps PaperPsf1(double r, int n, double theta);

// Returns a_{d,N}[i] of (5) for the 1D aperture.
Taps SampledAperture1(int n, double theta);

// Computes the PSF that the engine is designed to have. Subapertures are modelled as the
// line scan and the slice renderer render them.

// Shapes of subapertures. With narrow subapertures, each view is spread over at most one pixel.
// Views of type B (|i| = |j|; IV-B of the paper) are spread along the diagonal only. With wide
// subapertures, each view is spread over r / N pixels along both axes.
enum class Subapertures { kNarrow, kWide };

// Returns the PSF of N views at blur radius r, with positions and subapertures rounded to the
// engine's 1/256 pixel. A subaperture that is up to 3 pixels wide is a box. A wider subaperture, of
// at most 7 pixels, is a box on whole pixels followed by linear interpolation. If `subapertures` is
// kWide, views have the positions that MakeSubapertures computes, and subapertures narrower than a
// pixel move pixels like the inside of a slice (lib/slices/slice_plane.cc).
SampledPsf StarPsf(double r, int n, double theta, Subapertures subapertures);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_VIEW_PSF_H_
