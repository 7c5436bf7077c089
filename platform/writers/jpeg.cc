// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/jpeg.h"

#include "platform/writers/exif.h"
#include "platform/writers/jpeg_segments.h"

namespace starfocus {

Result<Bytes> EncodeJpeg(const std::string& path, const Image& image, int quality,
                         const Metadata& metadata, const Bytes& segments, RowGate* rows) {
  Result<Bytes> jpeg =
      EncodeJpegPixels(path, {image.width, image.height, 3, image.pixels.data()}, quality, rows);
  if (!jpeg) return jpeg;
  Bytes all;
  AppendExif(EditedExif(metadata.exif, image.width, image.height), &all);
  AppendXmp(metadata.xmp, &all);
  AppendIptc(metadata.iptc, &all);
  AppendProfile(metadata.icc, &all);
  all.insert(all.end(), segments.begin(), segments.end());
  InsertSegments(all, &*jpeg);
  return jpeg;
}

}  // namespace starfocus
