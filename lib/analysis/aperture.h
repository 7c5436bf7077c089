// SPDX-License-Identifier: Apache-2.0
// The aperture filter (3): a lens's cosine fourth fall-off.
#ifndef STARFOCUS_LIB_ANALYSIS_APERTURE_H_
#define STARFOCUS_LIB_ANALYSIS_APERTURE_H_

namespace starfocus::analysis {

inline constexpr double kPi = 3.14159265358979323846;

// The paper's default fall-off, chosen by Table I at r = 3.
inline constexpr double kDefaultTheta = 0.26 * kPi;

// cot^2(theta), the one form in which theta enters (3).
double FallOff(double theta);

// a(u, v; theta) at u^2 + v^2 = square; unit integral over the disc, 0 outside it.
double Aperture(double square, double theta);

// The 1D aperture of Figs. 4, 5 and 8: a(u, 0; theta), scaled to unit integral over [-1, 1].
double Aperture1(double u, double theta);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_APERTURE_H_
