// SPDX-License-Identifier: Apache-2.0
#include "lib/base/transfer.h"

#include "simd/resample.h"

namespace starfocus {
namespace {

constexpr int kCodes = 256;

constexpr double FifthRoot(double value) {
  double root = 1;
  for (int step = 0; step < 64; ++step) {
    const double fourth = root * root * root * root;
    root -= (fourth * root - value) / (5 * fourth);
  }
  return root;
}

// Returns the light of a code; white is 1. The compiler evaluates this function in IEEE arithmetic,
// so all machines have the same tables.
constexpr double LinearOf(double code) {
  const double value = code / 255;
  if (value <= 0.04045) return value / 12.92;
  const double base = (value + 0.055) / 1.055, square = base * base;
  return square * FifthRoot(square);
}

struct CodeTables {
  int16_t srgb[kCodes] = {}, same[kCodes] = {};
  int16_t srgb_samples[kCodes] = {}, same_samples[kCodes] = {};
  uint16_t entries[simd::kEncodeEntries] = {};

  constexpr CodeTables() {
    for (int code = 0; code < kCodes; ++code) {
      srgb[code] = static_cast<int16_t>(LinearOf(code) * kLightWhite + 0.5);
      same[code] = static_cast<int16_t>(code << kLightBits);
      srgb_samples[code] = SampleOf(srgb[code]);
      same_samples[code] = SampleOf(same[code]);
    }
    int32_t code = 0, next = FirstOf(1);
    for (int32_t entry = 0; entry < static_cast<int32_t>(simd::kEncodeEntries); ++entry) {
      const int32_t level = entry * simd::kEncodeStep;
      if (next <= level) next = FirstOf(++code + 1);
      const int32_t rest = next - level;
      const int32_t ends = rest < simd::kEncodeStep ? (1 << simd::kEncodeBits) - rest : 0;
      entries[entry] = static_cast<uint16_t>((code << simd::kEncodeBits) + ends);
    }
  }

  // Returns the sample of a layer for light, rounded half up.
  static constexpr int16_t SampleOf(int16_t light) {
    static_assert(kLightBits - simd::kLayerBits == 1);
    return static_cast<int16_t>((light + 1) >> 1);
  }

  // Returns the smallest light level whose nearest code, on the scale of codes, is `code` rather
  // than code - 1.
  static constexpr int32_t FirstOf(int32_t code) {
    const double light = LinearOf(code - 0.5) * kLightWhite;
    const auto whole = static_cast<int32_t>(light);
    return whole + (whole < light ? 1 : 0);
  }
};

constexpr CodeTables kTables;
constexpr simd::Encoding kSrgb = {kTables.srgb, kTables.entries, kTables.srgb_samples};
constexpr simd::Encoding kNone = {kTables.same, nullptr, kTables.same_samples};

}  // namespace

const simd::Encoding& TransferOf(int32_t transfer) {
  return transfer == STARFOCUS_TRANSFER_NONE ? kNone : kSrgb;
}

}  // namespace starfocus
