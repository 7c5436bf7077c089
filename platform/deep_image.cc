// SPDX-License-Identifier: Apache-2.0
#include "platform/deep_image.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace starfocus {
namespace {

constexpr size_t kValues = 65536;  // of a sample
constexpr double kLargestCode = 65535;
constexpr uint16_t kHalfSign = 0x8000, kHalfInfinity = 0x7c00;

// Constants of SMPTE ST 2084.
constexpr double kPqM1 = 2610.0 / 16384, kPqM2 = 2523.0 / 4096 * 128, kPqC1 = 3424.0 / 4096,
                 kPqC2 = 2413.0 / 4096 * 32, kPqC3 = 2392.0 / 4096 * 32, kPqPeak = 10000;
// Constants of HLG (ITU-R BT.2100, table 5). Light of the scene is from 0 to 1.
constexpr double kHlgA = 0.17883277, kHlgB = 1 - 4 * kHlgA;
const double kHlgC = 0.5 - kHlgA * std::log(4 * kHlgA);

double SceneOfHlg(double code) {
  return code <= 0.5 ? code * code / 3 : (std::exp((code - kHlgC) / kHlgA) + kHlgB) / 12;
}

double HlgOfScene(double light) {
  return light <= 1.0 / 12 ? std::sqrt(3 * light) : kHlgA * std::log(12 * light - kHlgB) + kHlgC;
}

// Returns f(k) for all values of a sample.
template <class T, class F>
std::vector<T> Table(F f) {
  std::vector<T> table;
  table.reserve(kValues);
  for (size_t k = 0; k < kValues; ++k) table.push_back(f(static_cast<uint16_t>(k)));
  return table;
}

// Rounds a code from 0 to 1. Counts a code that is out of range.
uint16_t Quantize(double code, ClippedSamples* clipped) {
  const double scaled = std::floor(code * kLargestCode + 0.5);
  if (scaled > kLargestCode) ++clipped->bright;
  return static_cast<uint16_t>(std::clamp(scaled, 0.0, kLargestCode));
}

// Returns a finite value that is not negative, and counts what it replaces.
float Usable(float value, ClippedSamples* clipped) {
  if (!std::isfinite(value)) ++clipped->not_finite;
  if (std::isnan(value)) return 0;
  if (std::isfinite(value) && value < 0) ++clipped->negative;
  return std::clamp(value, 0.0F, kLargestHalf);
}

// Converts the three colours of a pixel to codes. `alpha` is from 0 to 1.
void EncodePixel(const uint16_t* from, float alpha, int32_t transfer, ClippedSamples* clipped,
                 uint16_t* to) {
  for (int c = 0; c < 3; ++c) {
    const float light = Usable(FloatOfHalf(from[c]), clipped);
    if (alpha == 0 && light > 0) ++clipped->glowing;
    to[c] = alpha == 0 ? 0 : Quantize(CodeOfLight(transfer, double(light) / alpha), clipped);
  }
}

uint8_t SrgbByte(double light) {
  const double code = CodeOfLight(STARFOCUS_TRANSFER_SRGB, std::min(light, 1.0));
  return static_cast<uint8_t>(std::floor(code * 255 + 0.5));
}

// Returns the byte that shows a sample.
uint8_t ByteOf(const DeepImage& deep, uint16_t sample) {
  if (deep.is_half) {
    const float light = FloatOfHalf(sample);
    return std::isnan(light) ? 0 : SrgbByte(std::max(light, 0.0F));
  }
  if (deep.transfer == STARFOCUS_TRANSFER_PQ || deep.transfer == STARFOCUS_TRANSFER_HLG) {
    return SrgbByte(LightOfCode(deep.transfer, sample / kLargestCode));
  }
  return static_cast<uint8_t>((sample + 128) / 257);
}

}  // namespace

float FloatOfHalf(uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  const float sign = (half & kHalfSign) != 0 ? -1.0F : 1.0F;
  if (exponent == 31) return mantissa == 0 ? sign * INFINITY : NAN;
  if (exponent == 0) return sign * std::ldexp(static_cast<float>(mantissa), -24);
  return sign * std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
}

uint16_t HalfOfFloat(float value) {
  uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  const auto sign = static_cast<uint16_t>(bits >> 16 & kHalfSign);
  if (std::isnan(value)) return static_cast<uint16_t>(sign | kHalfInfinity | 0x200);
  const float size = std::fabs(value);
  // Half of the step from kLargestHalf to the next power of two rounds up to infinity.
  if (size >= 65520) return static_cast<uint16_t>(sign | kHalfInfinity);
  if (size == 0) return sign;
  // The value is a multiple of 2^step with a factor below 2048, which the rounding may reach.
  int exponent = 0;
  std::frexp(size, &exponent);
  const int step = std::max(exponent - 11, -24);
  const float scaled = std::ldexp(size, -step);  // exact
  auto whole = static_cast<uint32_t>(scaled);
  const float rest = scaled - static_cast<float>(whole);
  if (rest > 0.5F || (rest == 0.5F && whole % 2 == 1)) ++whole;
  // Bit 10 of a normal number's factor increases the exponent field by one.
  return static_cast<uint16_t>(sign | ((static_cast<uint32_t>(step + 24) << 10) + whole));
}

double LightOfCode(int32_t transfer, double code) {
  if (transfer == STARFOCUS_TRANSFER_PQ) {
    const double root = std::pow(code, 1 / kPqM2);
    return kPqPeak / kPqWhite *
           std::pow(std::max(root - kPqC1, 0.0) / (kPqC2 - kPqC3 * root), 1 / kPqM1);
  }
  if (transfer == STARFOCUS_TRANSFER_HLG) return SceneOfHlg(code) / SceneOfHlg(kHlgWhiteCode);
  if (transfer == STARFOCUS_TRANSFER_NONE) return code;
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double CodeOfLight(int32_t transfer, double light) {
  if (!(light > 0)) return 0;
  if (transfer == STARFOCUS_TRANSFER_PQ) {
    const double power = std::pow(light * kPqWhite / kPqPeak, kPqM1);
    return std::pow((kPqC1 + kPqC2 * power) / (1 + kPqC3 * power), kPqM2);
  }
  if (transfer == STARFOCUS_TRANSFER_HLG) return HlgOfScene(light * SceneOfHlg(kHlgWhiteCode));
  if (transfer == STARFOCUS_TRANSFER_NONE) return light;
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

std::string Describe(const ClippedSamples& clipped, const std::string& limit) {
  std::string text;
  const auto add = [&text](int64_t count, const std::string& what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(clipped.bright, "samples brighter than " + limit);
  add(clipped.negative, "negative samples");
  add(clipped.not_finite, "samples that are infinite or not a number");
  add(clipped.glowing, "samples of light in transparent pixels");
  return text;
}

void CountUnusable(const DeepImage& deep, UnusableLight* counts) {
  if (!deep.is_half) return;
  constexpr int32_t kNaN = 1, kNegative = 2, kBright = 4, kNoAlpha = 8;
  const auto kinds = Table<int32_t>([](uint16_t sample) {
    const float light = FloatOfHalf(sample);
    if (std::isnan(light)) return kNaN | kNoAlpha;
    if (light < 0) return kNegative | kNoAlpha;
    return (light > 1 ? kNoAlpha : 0) | (light > kMostLight ? kBright : 0);
  });
  const auto channels = static_cast<size_t>(deep.channels);
  for (size_t at = 0; at < deep.samples.size(); at += channels) {
    const uint16_t* pixel = &deep.samples[at];
    const int32_t kind = kinds[pixel[0]] | kinds[pixel[1]] | kinds[pixel[2]];
    if ((kind & kNaN) != 0) ++counts->not_a_number;
    if ((kind & kNegative) != 0) ++counts->negative;
    if ((kind & kBright) != 0) ++counts->too_bright;
    if (channels == 4 && (kinds[pixel[3]] & kNoAlpha) != 0) ++counts->alpha;
  }
}

DeepImage ToHalf(const DeepImage& codes) {
  const auto lights = Table<float>([&codes](uint16_t code) {
    return static_cast<float>(LightOfCode(codes.transfer, code / kLargestCode));
  });
  const auto halves =
      Table<uint16_t>([&lights](uint16_t code) { return HalfOfFloat(lights[code]); });
  DeepImage half(codes.width, codes.height, codes.channels);
  half.is_half = true;
  half.transfer = STARFOCUS_TRANSFER_NONE;
  const auto channels = static_cast<size_t>(codes.channels);
  for (size_t at = 0; at < codes.samples.size(); at += channels) {
    const uint16_t alpha = channels == 4 ? codes.samples[at + 3] : uint16_t{65535};
    const auto share = static_cast<float>(alpha / kLargestCode);
    for (size_t c = 0; c < 3; ++c) {
      const uint16_t code = codes.samples[at + c];
      half.samples[at + c] = alpha == 65535 ? halves[code] : HalfOfFloat(lights[code] * share);
    }
    if (channels == 4) half.samples[at + 3] = HalfOfFloat(share);
  }
  return half;
}

DeepImage ToCodes(const DeepImage& half, int32_t transfer, ClippedSamples* clipped) {
  DeepImage codes(half.width, half.height, half.channels);
  codes.transfer = transfer;
  // Most samples belong to opaque pixels, are not negative, and are neither clipped nor infinite.
  constexpr int32_t kSpecial = -1;
  const auto simple = Table<int32_t>([&](uint16_t sample) {
    ClippedSamples any;
    uint16_t code[3];
    const uint16_t pixel[3] = {sample, 0, 0};
    EncodePixel(pixel, 1, transfer, &any, code);
    return any.any() ? kSpecial : int32_t{code[0]};
  });
  const auto channels = static_cast<size_t>(half.channels);
  constexpr uint16_t kOne = 0x3c00;
  for (size_t at = 0; at < half.samples.size(); at += channels) {
    const uint16_t* from = &half.samples[at];
    uint16_t* to = &codes.samples[at];
    const uint16_t stored = channels == 4 ? from[3] : kOne;
    if (channels == 4 && stored == kOne) to[3] = 65535;
    const int32_t colours[] = {simple[from[0]], simple[from[1]], simple[from[2]]};
    if (stored == kOne && *std::min_element(colours, colours + 3) >= 0) {
      for (size_t c = 0; c < 3; ++c) to[c] = static_cast<uint16_t>(colours[c]);
      continue;
    }
    const float alpha = Usable(FloatOfHalf(stored), clipped);
    if (channels == 4) to[3] = Quantize(alpha, clipped);
    EncodePixel(from, std::min(alpha, 1.0F), transfer, clipped, to);
  }
  return codes;
}

Image ToImage(const DeepImage& deep) {
  const auto bytes = Table<uint8_t>([&deep](uint16_t sample) { return ByteOf(deep, sample); });
  Image image(deep.width, deep.height);
  uint8_t* to = image.pixels.data();
  const auto channels = static_cast<size_t>(deep.channels);
  for (size_t at = 0; at < deep.samples.size(); at += channels) {
    for (size_t c = 0; c < 3; ++c) *to++ = bytes[deep.samples[at + c]];
  }
  return image;
}

bool DropOpaqueAlpha(DeepImage* deep) {
  if (deep->channels != 4) return false;
  std::vector<uint16_t>& samples = deep->samples;
  const uint16_t opaque = deep->is_half ? 0x3c00 : 65535;
  for (size_t at = 3; at < samples.size(); at += 4) {
    if (samples[at] != opaque) return true;
  }
  const size_t pixels = samples.size() / 4;
  for (size_t k = 0; k < pixels; ++k) std::copy_n(&samples[4 * k], 3, &samples[3 * k]);
  samples.resize(3 * pixels);
  deep->channels = 3;
  return false;
}

double LargestLight(const DeepImage& deep) {
  uint16_t largest = 0;
  const auto channels = static_cast<size_t>(deep.channels);
  for (size_t at = 0; at < deep.samples.size(); at += channels) {
    for (size_t c = 0; c < 3; ++c) {
      const uint16_t sample = deep.samples[at + c];
      // Positive half floats have the order of their bits.
      if (!deep.is_half || sample < kHalfInfinity) largest = std::max(largest, sample);
    }
  }
  return deep.is_half ? double{FloatOfHalf(largest)}
                      : LightOfCode(deep.transfer, largest / kLargestCode);
}

}  // namespace starfocus
