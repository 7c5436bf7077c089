// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/aperture.h"

#include <cmath>

#include "examples/lab/analysis/integral.h"

namespace starfocus::analysis {

double FallOff(double theta) {
  const double tangent = std::tan(theta);
  return 1 / (tangent * tangent);
}

double Aperture(double square, double theta) {
  if (square > 1) return 0;
  const double c = FallOff(theta), cosine = std::cos(theta);
  return c * c / (kPi * cosine * cosine * (square + c) * (square + c));
}

double Aperture1(double u, double theta) {
  if (std::fabs(u) > 1) return 0;
  const double c = FallOff(theta), denominator = u * u + c;
  return 1 / (denominator * denominator) / InverseSquare(-1, 1, c);
}

}  // namespace starfocus::analysis
