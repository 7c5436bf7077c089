// SPDX-License-Identifier: Apache-2.0
// Finds out the samples of pictures without decoding them, and reports pictures whose samples have
// more bits than the program uses.
#ifndef STARFOCUS_PLATFORM_READERS_SAMPLE_BITS_H_
#define STARFOCUS_PLATFORM_READERS_SAMPLE_BITS_H_

#include <string>
#include <vector>

#include "platform/file.h"

namespace starfocus {

// Returns the number of bits of each sample that the header of a PNG, PGM or PPM file states, or 8
// for other files. The first 64 KiB of a file are sufficient.
int SampleBitsOf(const Bytes& beginning);

// Samples of a picture, as its headers state.
struct StatedSamples {
  int bits = 8;
  bool is_float = false;
};

// Returns the samples of a PNG, PGM, PPM, TIFF, OpenEXR, HEIC or AVIF file, or integers of 8 bits
// for other and for damaged files.
StatedSamples StatedSamplesOf(const Bytes& file);

// Adds a note if a picture has more than 8 bits for each sample.
void NoteSampleBits(int bits, std::vector<std::string>* notes);

// Adds a note if transparent pixels lose their transparency.
void NoteTransparency(bool is_transparent, std::vector<std::string>* notes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_SAMPLE_BITS_H_
