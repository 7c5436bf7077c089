// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/exif.h"

#ifdef STARFOCUS_HAS_EXIF
#include <libexif/exif-data.h>
#endif

namespace starfocus {
namespace {

#ifdef STARFOCUS_HAS_EXIF

constexpr size_t kMostBytes = 65535;  // of a JPEG segment

// A whole number of 16 bits; 0 when the tag is not there or another type.
int ShortOf(ExifData* data, ExifIfd directory, ExifTag tag) {
  ExifEntry* entry = exif_content_get_entry(data->ifd[directory], tag);
  if (entry == nullptr || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return 0;
  return exif_get_short(entry->data, exif_data_get_byte_order(data));
}

#endif

}  // namespace

#ifdef STARFOCUS_HAS_EXIF

void ReadExif(DepthPhoto* photo) {
  const Bytes& exif = photo->metadata.exif;
  if (exif.empty() || exif.size() > kMostBytes) return;
  Bytes segment = {'E', 'x', 'i', 'f', 0, 0};
  segment.insert(segment.end(), exif.begin(), exif.end());
  ExifData* data = exif_data_new();
  if (data == nullptr) return;
  // As it stands: nothing is added or mended.
  exif_data_unset_option(data, EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
  exif_data_load_data(data, segment.data(), static_cast<unsigned>(segment.size()));
  const int orientation = ShortOf(data, EXIF_IFD_0, EXIF_TAG_ORIENTATION);
  const int focal = ShortOf(data, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM);
  exif_data_unref(data);
  if (orientation >= 1 && orientation <= 8) photo->orientation = orientation;
  photo->focal_35mm = focal;
  std::string text = std::to_string(exif.size()) + " bytes";
  if (focal > 0) text += ", lens of " + std::to_string(focal) + " mm on full frame";
  photo->facts.emplace_back("EXIF", text);
}

#else

void ReadExif(DepthPhoto* photo) {
  if (photo->metadata.exif.empty()) return;
  photo->facts.emplace_back("EXIF", "not read: this build has no libexif");
}

#endif

}  // namespace starfocus
