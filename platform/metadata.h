// SPDX-License-Identifier: Apache-2.0
// What a photograph's file says of it beside the pixels.
#ifndef STARFOCUS_PLATFORM_METADATA_H_
#define STARFOCUS_PLATFORM_METADATA_H_

#include "platform/file.h"

namespace starfocus {

struct Metadata {
  Bytes exif;  // the TIFF structure, from its byte order "II" or "MM" on; empty: none
  Bytes icc;   // the whole profile; empty: none, which is sRGB
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_METADATA_H_
