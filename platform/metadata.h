// SPDX-License-Identifier: Apache-2.0
// Metadata that a file stores in addition to the pixels of a photograph.
#ifndef STARFOCUS_PLATFORM_METADATA_H_
#define STARFOCUS_PLATFORM_METADATA_H_

#include <optional>
#include <string>
#include <utility>

#include "platform/colour_description.h"
#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

struct Metadata {
  Bytes exif;       // TIFF structure of EXIF, starting with "II" or "MM"; empty: no EXIF.
  Bytes icc;        // Complete ICC profile; empty: no profile, which means sRGB.
  Bytes iptc = {};  // IPTC-IIM records such as title and caption; empty: no records.
  // Elements rdf:Description of an XMP packet, without the surrounding elements; empty: no XMP. The
  // descriptions contain title, caption, rating, copyright and so on, but no properties of the file
  // (kept_metadata.h).
  std::string xmp = {};
  // Colours of a file without a profile, or of a PNG file whose chunk cICP overrides the profile.
  // Readers convert the description to a profile if possible; PNG files can store the others.
  ColourDescription colours = {};
};

// A picture with the metadata of its file.
struct DecodedPicture {
  Image image;                    // The picture in 8 bits.
  std::optional<DeepImage> deep;  // The same picture, if the file has more than 8 bits or alpha.
  Metadata metadata;
  bool is_transparent = false;          // True if the file has an alpha channel that is not opaque.
  int bits = 8;                         // Bits of each sample in the file, if `deep` has a value.
  std::vector<std::string> notes = {};  // What the decoder chose and left out, for users.
};

inline Result<DecodedPicture> WithoutMetadata(Result<Image> image) {
  if (!image) return image.error();
  return DecodedPicture{std::move(*image), {}, {}};
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_METADATA_H_
