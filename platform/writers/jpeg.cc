// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/jpeg.h"

#include "platform/writers/exif.h"
#include "platform/writers/jpeg_segments.h"
#include "starfocus/version.h"

namespace starfocus {

Error EncodeJpeg(const std::string& path, const Image& image, int quality, const Metadata& metadata,
                 const Bytes& segments, Bytes* jpeg) {
  jpeg->clear();
  if (Error error = EncodeJpegPixels(path, image, quality, jpeg)) return error;
  Bytes all, exif = metadata.exif;
  if (MarkEdited("starfocus " SF_VERSION_STRING, image.width, image.height, &exif)) {
    AppendExif(exif, &all);
  }
  AppendXmp(metadata.xmp, &all);
  AppendIptc(metadata.iptc, &all);
  AppendProfile(metadata.icc, &all);
  all.insert(all.end(), segments.begin(), segments.end());
  InsertSegments(all, jpeg);
  return {};
}

}  // namespace starfocus
