// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/sample_bits.h"

#include <algorithm>
#include <optional>

#include "platform/container.h"
#include "platform/decoders/tiff.h"
#include "platform/png.h"
#include "platform/readers/heic.h"
#include "platform/readers/heif_boxes.h"
#include "platform/readers/tiff_numbers.h"
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

namespace {

// Reads the first directory of a TIFF file (TIFF 6.0, section 2).
StatedSamples TiffSamples(const Bytes& file) {
  constexpr uint32_t kBits = 258, kFormat = 339, kFloat = 3, kShort = 3;
  const TiffNumbers numbers({file.data(), file.size()});
  const size_t directory = numbers.Whole(4, 4);
  // Returns the first number of an entry, which is in the entry if all of them have 4 bytes.
  const auto first_of = [&](uint32_t tag, uint32_t absent) {
    const std::optional<size_t> at = numbers.Entry(directory, tag);
    if (!at) return absent;
    const size_t size = numbers.Whole(*at + 2, 2) == kShort ? 2 : 4;
    const bool is_inside = numbers.Whole(*at + 4, 4) <= 4 / size;
    return numbers.Whole(is_inside ? *at + 8 : numbers.Whole(*at + 8, 4), size);
  };
  return {static_cast<int>(std::min(first_of(kBits, 8), 64u)), first_of(kFormat, 1) == kFloat};
}

// Reads the configurations of the coded pictures of a HEIF file: hvcC (ISO/IEC 14496-15, 8.3.3.1)
// and av1C. Returns the bits of the deepest picture.
StatedSamples HeifSamples(const Bytes& file) {
  StatedSamples samples;
  const std::optional<HeifItems> items = ReadHeifItems({file.data(), file.size()});
  if (!items) return samples;
  for (const auto& [id, item] : *items) {
    const Span from = item.configuration;
    constexpr uint8_t kDeep = 0x40, kDeeper = 0x20;  // flags of av1C
    int bits = 8;
    if (item.type == "av01" && from.size > 2 && (from.data[2] & kDeep) != 0) {
      bits = (from.data[2] & kDeeper) != 0 ? 12 : 10;
    }
    if (item.type == "hvc1" && from.size > 17) bits = 8 + (from.data[17] & 7);
    samples.bits = std::max(samples.bits, bits);
  }
  return samples;
}

}  // namespace

StatedSamples StatedSamplesOf(const Bytes& file) {
  if (IsExr(file)) return {16, true};
  if (IsTiff(file)) return TiffSamples(file);
  if (IsHeif({file.data(), file.size()})) return HeifSamples(file);
  return {SampleBitsOf(file), false};
}

void NoteSampleBits(int bits, std::vector<std::string>* notes) {
  if (bits <= 8) return;
  notes->push_back("the pixels have " + std::to_string(bits) +
                   " bits for each colour, which become 8");
}

void NoteTransparency(bool is_transparent, std::vector<std::string>* notes) {
  if (!is_transparent) return;
  notes->push_back(
      "transparent pixels of the picture become opaque, and their colours mix into blurred edges "
      "(--matte FILE takes the alpha channel of a picture as the matte of its subject)");
}

}  // namespace starfocus
