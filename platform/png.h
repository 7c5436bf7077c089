// SPDX-License-Identifier: Apache-2.0
// Reads properties of PNG files that stb_image does not report.
#ifndef STARFOCUS_PLATFORM_PNG_H_
#define STARFOCUS_PLATFORM_PNG_H_

#include <cstdint>
#include <optional>

#include "platform/file.h"

namespace starfocus {

// The header chunk of a PNG file.
struct PngHeader {
  uint32_t width, height;
  int depth;   // Bits per sample.
  int colour;  // Colour type as defined by the PNG format.
};

// Reads the header of a complete PNG file. Returns nullopt if the first chunk is not a header.
std::optional<PngHeader> ReadPngHeader(const Bytes& png);

// Returns true if the pixels of the PNG file are indices into a palette.
bool HasPalette(const PngHeader& header);

// Converts a file with a palette to a grey picture, in which index i has the level i * GreyStep.
// Returns the palette as R, G, B for each index, or an empty result if the palette is missing. The
// conversion is necessary because stb_image returns uninitialized memory for an index outside the
// palette.
Bytes TakePalette(Bytes* png);
int GreyStep(const PngHeader& header);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PNG_H_
