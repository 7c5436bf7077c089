// SPDX-License-Identifier: Apache-2.0
// Writes photographs with a gain map as Ultra HDR JPEG files (Android's Ultra HDR image format
// 1.1). The base picture comes first, and programs without gain maps show it. The gain map is a
// second JPEG picture behind it, which the multi-picture index (CIPA DC-007) and a directory in the
// XMP of the base list. Its parameters are stored twice: as the XMP properties hdrgm, and as
// metadata of ISO 21496-1.
#ifndef STARFOCUS_PLATFORM_WRITERS_ULTRA_HDR_H_
#define STARFOCUS_PLATFORM_WRITERS_ULTRA_HDR_H_

#include <string>

#include "platform/gain_map.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Encodes `base` and its gain map, which must pass CheckGainMap and has levels. `quality`, 1 to
// 100, is that of the base. The levels of the map are rounded to 8 bits, and encoded with a quality
// of at least 95, because the map stretches errors: one of 255 levels is usually about 1 % of the
// light. The base keeps EXIF, profile, IPTC and XMP of `metadata` as EncodeJpeg does (jpeg.h).
// `path` appears only in error messages.
Result<Bytes> EncodeUltraHdr(const std::string& path, const Image& base, const GainMap& map,
                             int quality, const Metadata& metadata);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_ULTRA_HDR_H_
