// SPDX-License-Identifier: Apache-2.0
// What of a photograph's XMP stays true of a picture that is made from it.
#ifndef STARFOCUS_PLATFORM_READERS_KEPT_METADATA_H_
#define STARFOCUS_PLATFORM_READERS_KEPT_METADATA_H_

#include <string>

#include "platform/readers/xmp.h"

namespace starfocus {

// Writes the properties that describe the photograph as one rdf:Description: title, caption,
// keywords, rating, author, copyright, place and the like. Leaves out what describes the file:
// depth maps and other pictures in it, orientation, sizes, edits and thumbnails. Empty if nothing
// is left.
std::string KeptXmp(const XmpNode& root);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_KEPT_METADATA_H_
