// SPDX-License-Identifier: Apache-2.0
// What a photograph's file says of it beside the pixels.
#ifndef STARFOCUS_PLATFORM_METADATA_H_
#define STARFOCUS_PLATFORM_METADATA_H_

#include <string>
#include <utility>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

struct Metadata {
  Bytes exif;       // the TIFF structure, from its byte order "II" or "MM" on; empty: none
  Bytes icc;        // the whole profile; empty: none, which is sRGB
  Bytes iptc = {};  // the records of IPTC-IIM: title, caption, copyright and so on; empty: none
  // The descriptions of an XMP packet, without what surrounds them; empty: none. They hold title,
  // caption, rating, copyright and so on, but nothing on the file's parts (kept_metadata.h).
  std::string xmp = {};
};

// A picture with the metadata of its file.
struct DecodedPicture {
  Image image;
  Metadata metadata;
};

inline Result<DecodedPicture> WithoutMetadata(Result<Image> image) {
  if (!image) return image.error();
  return DecodedPicture{std::move(*image), {}};
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_METADATA_H_
