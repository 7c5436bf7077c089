// SPDX-License-Identifier: Apache-2.0
#include "examples/scene/light_curve.h"

#include <algorithm>
#include <cmath>

namespace starfocus {
namespace {

// Returns value^2.4. Uses only arithmetic that IEEE 754 defines exactly, because std::pow differs
// between libraries.
double Power(double value) {
  const double square = value * value;
  double root = std::max(1.0, square);
  for (int step = 0; step < 100; ++step) {
    const double fourth = root * root * root * root;
    root -= (fourth * root - square) / (5 * fourth);
  }
  return square * root;
}

}  // namespace

LightCurve::LightCurve(starfocus_transfer transfer) {
  if (transfer == STARFOCUS_TRANSFER_NONE) return;
  for (int k = 0; k <= kMostCode * kSteps; ++k) {
    const double value = k / (255.0 * kSteps);
    light_.push_back(255 * (value <= 0.04045 ? value / 12.92 : Power((value + 0.055) / 1.055)));
  }
}

double LightCurve::LightOf(double code) const {
  if (light_.empty()) return code;
  const double place = std::clamp(code, 0.0, kMostCode - 1.0) * kSteps;
  const auto step = static_cast<size_t>(place);
  return light_[step] + (light_[step + 1] - light_[step]) * (place - static_cast<double>(step));
}

double LightCurve::CodeOf(double light) const {
  if (light_.empty() || light <= 0) return light;
  const auto above = std::upper_bound(light_.begin(), light_.end() - 1, light);
  const auto step = static_cast<double>(above - light_.begin() - 1);
  return (step + (light - above[-1]) / (above[0] - above[-1])) / kSteps;
}

Color LightCurve::Decode(const Color& codes) const {
  return {LightOf(codes.r), LightOf(codes.g), LightOf(codes.b)};
}

Color LightCurve::Encode(const Color& light) const {
  return {CodeOf(light.r), CodeOf(light.g), CodeOf(light.b)};
}

}  // namespace starfocus
