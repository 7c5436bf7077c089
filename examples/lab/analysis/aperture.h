// SPDX-License-Identifier: Apache-2.0
// Computes the aperture filter (3): the cosine-fourth fall-off of a lens.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_APERTURE_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_APERTURE_H_

namespace starfocus::analysis {

inline constexpr double kPi = 3.14159265358979323846;

// Default fall-off of the paper, from Table I at r = 3.
inline constexpr double kDefaultTheta = 0.26 * kPi;

// Returns cot^2(theta), the only form in which theta enters (3).
double FallOff(double theta);

// Returns a(u, v; theta) at u^2 + v^2 = square. The function a has an integral of 1 over the unit
// disc, and is 0 outside the disc.
double Aperture(double square, double theta);

// Returns the 1D aperture of Figs. 4, 5 and 8: a(u, 0; theta), scaled to an integral of 1 over [-1,
// 1].
double Aperture1(double u, double theta);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_APERTURE_H_
