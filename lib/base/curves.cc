// SPDX-License-Identifier: Apache-2.0
#include "lib/base/curves.h"

#include "simd/light.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// The compiler evaluates these functions in IEEE arithmetic, so all machines have the same tables.

// Returns the natural logarithm of value > 0.
constexpr double Log(double value) {
  constexpr double kLogTwo = 0.69314718055994530942;
  double log = 0;
  for (; value < 0.75; value *= 2) log -= kLogTwo;
  for (; value > 1.5; value /= 2) log += kLogTwo;
  // log(value) = 2 atanh(z)
  const double z = (value - 1) / (value + 1), square = z * z;
  double power = z, sum = 0;
  for (int n = 1; n < 24; n += 2, power *= square) sum += power / n;
  return log + 2 * sum;
}

constexpr double Exp(double value) {
  int halvings = 0;
  for (; value > 0.25 || value < -0.25; value /= 2) ++halvings;
  double term = 1, sum = 1;
  for (int n = 1; n < 12; ++n) sum += term *= value / n;
  for (; halvings > 0; --halvings) sum *= sum;
  return sum;
}

// Returns value^exponent, value >= 0.
constexpr double Power(double value, double exponent) {
  return value <= 0 ? 0 : Exp(exponent * Log(value));
}

// Light of a signal of 1 or slightly more; white is 1.
constexpr double Srgb(double signal) {
  return signal <= 0.04045 ? signal / 12.92 : Power((signal + 0.055) / 1.055, 2.4);
}

constexpr double Pq(double signal) {
  constexpr double kM1 = 0.1593017578125, kM2 = 78.84375;
  constexpr double kC1 = 0.8359375, kC2 = 18.8515625, kC3 = 18.6875, kWhite = 203;
  const double power = Power(signal, 1 / kM2);
  return Power((power < kC1 ? 0 : power - kC1) / (kC2 - kC3 * power), 1 / kM1) * 10000 / kWhite;
}

constexpr double Hlg(double signal) {
  constexpr double kA = 0.17883277, kB = 0.28466892, kC = 0.55991073;
  const auto scene = [](double value) {
    return value <= 0.5 ? value * value / 3 : (Exp((value - kC) / kA) + kB) / 12;
  };
  return scene(signal) / scene(0.75);
}

// Light at equal distances along a curve, between which the light is interpolated.
template <int kCount>
struct Curve {
  uint32_t nodes[kCount + 1] = {};

  explicit constexpr Curve(double (*light)(double)) {
    for (int n = 0; n <= kCount; ++n) {
      const double signal = n * (65536.0 / kCount) / 65535;
      nodes[n] = static_cast<uint32_t>(light(signal) * (kLightWhite << kCurveBits) + 0.5);
    }
  }

  uint32_t At(uint32_t code) const {
    constexpr uint32_t kStep = 65536 / kCount;
    const uint32_t *const node = nodes + code / kStep, rest = code % kStep;
    const uint64_t more = uint64_t{node[1] - node[0]} * rest + kStep / 2;
    return node[0] + static_cast<uint32_t>(more / kStep);
  }

  static constexpr int16_t kLightWhite = simd::kLightWhite;
};

constexpr Curve<256> kSrgb(Srgb);
constexpr Curve<1024> kPq(Pq);
constexpr Curve<1024> kHlg(Hlg);

}  // namespace

uint32_t LightOfCode(int32_t transfer, uint32_t code) {
  if (transfer == STARFOCUS_TRANSFER_SRGB) return kSrgb.At(code);
  if (transfer == STARFOCUS_TRANSFER_PQ) return kPq.At(code);
  if (transfer == STARFOCUS_TRANSFER_HLG) return kHlg.At(code);
  constexpr uint64_t kWhite = uint64_t{simd::kLightWhite} << kCurveBits;
  return static_cast<uint32_t>((code * kWhite + 65535 / 2) / 65535);
}

}  // namespace starfocus
