// SPDX-License-Identifier: Apache-2.0
// Reports pictures whose samples have more bits than the program uses.
#ifndef STARFOCUS_PLATFORM_READERS_SAMPLE_BITS_H_
#define STARFOCUS_PLATFORM_READERS_SAMPLE_BITS_H_

#include <string>
#include <vector>

#include "platform/file.h"

namespace starfocus {

// Returns the number of bits of each sample that the header of a PNG, PGM or PPM file states, or 8
// for other files. The first 64 KiB of a file are sufficient.
int SampleBitsOf(const Bytes& beginning);

// Adds a note if a picture has more than 8 bits for each sample.
void NoteSampleBits(int bits, std::vector<std::string>* notes);

// Adds a note if transparent pixels lose their transparency.
void NoteTransparency(bool is_transparent, std::vector<std::string>* notes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_SAMPLE_BITS_H_
