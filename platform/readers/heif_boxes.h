// SPDX-License-Identifier: Apache-2.0
// Parses the boxes of HEIF files (ISO/IEC 14496-12 and 23008-12) that declare the sizes and
// components of pictures. The module heif_limits.h checks the declared sizes and components before
// libheif allocates memory for the pictures.
#ifndef STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_
#define STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

// An item of a HEIF file, such as a picture.
struct HeifItem {
  std::string type;                // Type of the item, a four-character code.
  uint32_t width = 0, height = 0;  // Size in the property ispe; 0: no property ispe.
  std::vector<uint32_t> inputs;    // Identifiers of the items that form a derived picture.
  Span configuration;              // Content of the property hvcC or av1C.
  Bytes head;                      // First bytes of the item's data.
};

using HeifItems = std::map<uint32_t, HeifItem>;  // Items by their identifiers.

// Reads the items of a HEIF file. Returns nullopt if a box is malformed or the file has more than
// 4096 items.
std::optional<HeifItems> ReadHeifItems(Span file);

// Returns the identifiers of the left and the right picture of the first stereo pair (the entity
// group 'ster', ISO/IEC 23008-12, 6.8.5). The result is empty if the file has no stereo pair, or if
// both identifiers are equal.
std::vector<uint32_t> HeifStereoPair(Span file);

// Returns the brands of a HEIF file, the major brand first. The result is empty if the file does
// not start with a file type box.
std::vector<std::string> HeifBrands(Span file);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIF_BOXES_H_
