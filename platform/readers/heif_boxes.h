// SPDX-License-Identifier: Apache-2.0
// Parses the boxes of HEIF files (ISO/IEC 14496-12 and 23008-12) that declare the sizes and
// components of pictures. heif_limits.h checks these declarations before libheif allocates memory
// for the pictures.
#ifndef STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_
#define STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

// A picture or another item of a file.
struct HeifItem {
  std::string type;                // four-character code
  uint32_t width = 0, height = 0;  // from the property ispe of the item; 0: none
  std::vector<uint32_t> inputs;    // identifiers of the items that a derived picture consists of
  Span configuration;              // content of the property hvcC or av1C
  Bytes head;                      // first bytes of the item's data
};

using HeifItems = std::map<uint32_t, HeifItem>;  // by item identifier

// Reads the items of a file. Returns nullopt if a box is malformed or there are more than 4096
// items.
std::optional<HeifItems> ReadHeifItems(Span file);

// Returns the brands of the file, the major brand first. The result is empty if the file does not
// start with a file type box.
std::vector<std::string> HeifBrands(Span file);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_
