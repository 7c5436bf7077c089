// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/sample_bits.h"

#include <optional>

#include "platform/container.h"
#include "platform/png.h"
#include "platform/text.h"
#include "platform/text_header.h"

namespace starfocus {

int SampleBitsOf(const Bytes& beginning) {
  if (IsPng(beginning)) {
    const std::optional<PngHeader> header = ReadPngHeader(beginning);
    return header ? header->depth : 8;
  }
  if (beginning.size() < 2 || beginning[0] != 'P') return 8;
  TextHeader header(beginning);
  std::string largest;
  for (int k = 0; k < 4; ++k) largest = header.Token();  // magic number, width, height, white
  int bits = 8;
  while (bits < 16 && ParseNumber(largest).value_or(0) >= 1 << bits) ++bits;
  return bits;
}

void NoteSampleBits(int bits, std::vector<std::string>* notes) {
  if (bits <= 8) return;
  notes->push_back("the pixels have " + std::to_string(bits) +
                   " bits for each colour, of which the program reads and writes the upper 8");
}

void NoteTransparency(bool is_transparent, std::vector<std::string>* notes) {
  if (!is_transparent) return;
  notes->push_back(
      "transparent pixels of the picture become opaque, and their colours mix into blurred edges "
      "(--matte FILE takes the alpha channel of a picture as the matte of its subject)");
}

}  // namespace starfocus
