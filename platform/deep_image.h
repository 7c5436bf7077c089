// SPDX-License-Identifier: Apache-2.0
// Converts pictures of more than 8 bits: half floats of linear light to integer codes of a transfer
// and back, and both to 8 bits. In all functions, light is relative to white, which is 1.
#ifndef STARFOCUS_PLATFORM_DEEP_IMAGE_H_
#define STARFOCUS_PLATFORM_DEEP_IMAGE_H_

#include <cstdint>
#include <string>

#include "platform/image.h"

namespace starfocus {

// White of PQ in cd/m2 and the code of white in HLG (ITU-R BT.2408).
inline constexpr double kPqWhite = 203;
inline constexpr double kHlgWhiteCode = 0.75;
// Largest finite half float.
inline constexpr float kLargestHalf = 65504;

// Converts IEEE half floats (binary16). HalfOfFloat rounds to the nearest half, and halves between
// two neighbours to the even one; larger values than kLargestHalf become infinite, as IEEE 754
// defines.
float FloatOfHalf(uint16_t half);
uint16_t HalfOfFloat(float value);

// Converts a code of a starfocus_transfer, from 0 to 1, to light: the sRGB curve of IEC 61966-2-1,
// the absolute light of SMPTE ST 2084 divided by kPqWhite, or the light of the scene of ITU-R
// BT.2100 (HLG) divided by that of kHlgWhiteCode. STARFOCUS_TRANSFER_NONE means linear light.
double LightOfCode(int32_t transfer, double code);

// Converts light to the code, which exceeds the range from 0 to 1 if `transfer` cannot store the
// light. Negative light gives the code 0.
double CodeOfLight(int32_t transfer, double light);

// Numbers of samples that a conversion changed because the target cannot store them. Callers report
// them.
struct ClippedSamples {
  int64_t bright = 0;      // Brighter than the largest code, or than the largest half float.
  int64_t negative = 0;    // Negative light or alpha.
  int64_t not_finite = 0;  // NaN, which becomes 0, and infinite values.
  int64_t glowing = 0;     // Light of pixels with alpha 0, which straight alpha cannot express.

  bool any() const { return bright > 0 || negative > 0 || not_finite > 0 || glowing > 0; }
};

// Describes the numbers: "12 samples brighter than white, 3 negative ones". `limit` describes the
// brightest sample that the target can store.
std::string Describe(const ClippedSamples& clipped, const std::string& limit);

// Numbers of pixels whose light or alpha the engine replaces.
struct UnusableLight {
  int64_t not_a_number = 0;  // Counts as black.
  int64_t negative = 0;      // Counts as black.
  int64_t too_bright = 0;    // Brighter than kMostLight, to which it is limited.
  int64_t alpha = 0;         // Alpha below 0, which counts as 0, above 1, or not a number.
};
// The brightest light that the engine refocuses (starfocus/image.h).
inline constexpr float kMostLight = 64;

// Adds the pixels of half floats with such samples to `counts`. Codes have none.
void CountUnusable(const DeepImage& deep, UnusableLight* counts);

// Converts codes to half floats of linear light, premultiplied with alpha.
DeepImage ToHalf(const DeepImage& codes);

// Converts half floats to codes of `transfer` with straight alpha, and adds the samples that codes
// cannot store to `clipped`. Pixels of alpha 0 become black.
DeepImage ToCodes(const DeepImage& half, int32_t transfer, ClippedSamples* clipped);

// Returns the 8-bit picture. Codes of sRGB and linear light are rounded to 8 bits. PQ, HLG and half
// floats are clipped at white and encoded by the sRGB curve. Alpha is ignored, so that half floats,
// which are premultiplied, lie on black.
Image ToImage(const DeepImage& deep);

// Removes the alpha channel if all pixels are opaque. Returns true if a pixel is not opaque.
bool DropOpaqueAlpha(DeepImage* deep);

// Returns the largest finite light of all samples of R, G and B, or 0 for a black picture.
double LargestLight(const DeepImage& deep);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DEEP_IMAGE_H_
