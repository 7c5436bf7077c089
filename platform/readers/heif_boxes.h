// SPDX-License-Identifier: Apache-2.0
// Boxes of HEIF files (ISO/IEC 14496-12 and 23008-12) that declare sizes of pictures and of what
// they are made of, read before libheif allocates memory for them.
#ifndef STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_
#define STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

// A picture or other item of a file.
struct HeifItem {
  std::string type;                // of four letters
  uint32_t width = 0, height = 0;  // of its property ispe; 0: it has none
  std::vector<uint32_t> inputs;    // items that a derived picture is made of
  Span configuration;              // of its property hvcC or av1C
  Bytes head;                      // the first bytes of its data
};

using HeifItems = std::map<uint32_t, HeifItem>;  // by their numbers

// Reads the items of a file; none if a box is malformed, or there are more than 4096 items.
std::optional<HeifItems> ReadHeifItems(Span file);

// The brands of the file, the major one first; none if it does not begin with a box of them.
std::vector<std::string> HeifBrands(Span file);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_
