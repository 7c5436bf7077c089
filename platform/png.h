// SPDX-License-Identifier: Apache-2.0
// What the reader of pictures has to know of a PNG file beyond stb_image.
#ifndef STARFOCUS_PLATFORM_PNG_H_
#define STARFOCUS_PLATFORM_PNG_H_

#include <cstdint>
#include <optional>

#include "platform/file.h"

namespace starfocus {

// The header chunk of a PNG file.
struct PngHeader {
  uint32_t width, height;
  int depth;   // bits of a sample
  int colour;  // the format's colour type
};

// Reads the header of a file whose container is whole; none when it does not begin with one.
std::optional<PngHeader> ReadPngHeader(const Bytes& png);

// Whether the pixels are indices into a palette.
bool HasPalette(const PngHeader& header);

// stb_image shows memory nobody has written for an index beyond the palette. So the file, whose
// header says that it has one, becomes a picture of grey levels, in which index i is the level
// i * GreyStep, and the palette, R, G, B for each index, is returned; empty when there is none.
Bytes TakePalette(Bytes* png);
int GreyStep(const PngHeader& header);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PNG_H_
