// SPDX-License-Identifier: Apache-2.0
// Metadata of a photograph's file.
#ifndef STARFOCUS_PLATFORM_METADATA_H_
#define STARFOCUS_PLATFORM_METADATA_H_

#include <string>
#include <utility>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

struct Metadata {
  Bytes exif;       // the TIFF structure, starting with its byte order "II" or "MM"; empty: none
  Bytes icc;        // the whole profile; empty: none, which means sRGB
  Bytes iptc = {};  // records of IPTC-IIM: title, caption, copyright and so on; empty: none
  // Descriptions of an XMP packet without the surrounding elements; empty: none. The descriptions
  // contain title, caption, rating, copyright and so on, but no properties of the file
  // (kept_metadata.h).
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
