// SPDX-License-Identifier: Apache-2.0
// Filters a photograph's XMP. Keeps the XMP properties that remain true for a refocused picture of
// the photograph.
#ifndef STARFOCUS_PLATFORM_READERS_KEPT_METADATA_H_
#define STARFOCUS_PLATFORM_READERS_KEPT_METADATA_H_

#include <string>

#include "platform/readers/xmp.h"

namespace starfocus {

// Returns the properties that describe the photograph as a single rdf:Description: title, caption,
// keywords, rating, author, copyright, place and similar properties. Omits properties that describe
// the file: depth maps and other embedded pictures, orientation, sizes, edits and thumbnails.
// Returns an empty string if no property remains.
std::string KeptXmp(const XmpNode& root);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_KEPT_METADATA_H_
