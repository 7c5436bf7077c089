// SPDX-License-Identifier: Apache-2.0
// Describes the colours of a picture whose file has no ICC profile: by the code points of ITU-T
// H.273 (the chunk cICP of PNG, the box nclx of HEIF), by chromaticities and a gamma (the chunks
// cHRM and gAMA of PNG), or by EXIF. Converts descriptions to ICC profiles.
#ifndef STARFOCUS_PLATFORM_COLOUR_DESCRIPTION_H_
#define STARFOCUS_PLATFORM_COLOUR_DESCRIPTION_H_

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "platform/file.h"

namespace starfocus {

// Coordinates x and y of red, green, blue and white, in units of 1/100000.
using Chromaticities = std::array<int32_t, 8>;

struct ColourDescription {
  // Code points of H.273. 2 means unspecified, which is interpreted as sRGB.
  static constexpr int kUnspecified = 2;
  // Code point outside H.273: `chromaticities` or `gamma` apply.
  static constexpr int kGiven = 256;
  // Code point outside H.273: Adobe RGB (1998), which EXIF can name.
  static constexpr int kAdobeRgb = 257;

  std::string form;  // Part of the file that contains the description; empty: no description.
  int primaries = kUnspecified, transfer = kUnspecified;
  bool full_range = true;  // False if black is 16 and white is 235.
  Chromaticities chromaticities = {};
  int32_t gamma = 0;  // Exponent that converts codes to light, in units of 1/100000.
};

// Form of the chunk cICP, which overrides an ICC profile (PNG specification, 4.3).
inline constexpr char kCicpForm[] = "cICP";

// Returns true if the description means sRGB, which is also the meaning of files without any
// description.
bool IsSrgb(const ColourDescription& colours);

// Returns true if light is proportional to the codes.
bool IsLinear(const ColourDescription& colours);

// Returns the chromaticities of the primaries and of white, or nullopt if the code point has no
// definition. Unspecified primaries are those of BT.709.
std::optional<Chromaticities> ChromaticitiesOf(const ColourDescription& colours);

// Returns the code point of H.273 for the primaries, or kUnspecified if none has these
// chromaticities within `tolerance`, in units of 1/100000.
int PrimariesCodeOf(const ColourDescription& colours, int32_t tolerance = 10);

// Returns the name of the primaries, for example "Display P3".
std::string PrimariesNameOf(const ColourDescription& colours);

// Returns the name of the transfer, for example "sRGB", "PQ" or "gamma 2.20".
std::string TransferNameOf(const ColourDescription& colours);

// Returns a description for users, for example "Display P3, transfer of sRGB".
std::string NameOf(const ColourDescription& colours);

// Returns the equivalent ICC profile, version 4, of less than 1 KiB. Returns an empty profile if a
// profile of primaries and curves cannot express the description: for PQ, HLG and other transfers
// that depend on the display, for code points without a definition, and for invalid chromaticities.
Bytes ProfileOf(const ColourDescription& colours);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_COLOUR_DESCRIPTION_H_
