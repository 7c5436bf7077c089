// SPDX-License-Identifier: Apache-2.0
// Binary PPM and PGM pictures. stb_image reads them too, but takes a truncated file for a whole
// one and ignores the largest value, so this format has a reader of its own.
#ifndef STARFOCUS_PLATFORM_PPM_H_
#define STARFOCUS_PLATFORM_PPM_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Decodes P6 or P5 (grey becomes RGB) with any largest value up to 65535, scaled to 8 bits.
// `path` only names the file in the error.
Result<Image> DecodePpm(const std::string& path, const Bytes& bytes);

// Samples as a P6 or P5 file has them, 0 to `largest`.
struct PnmSamples {
  int width = 0, height = 0, channels = 0, largest = 0;
  std::vector<uint16_t> samples;
};

Result<PnmSamples> DecodePnmSamples(const std::string& path, const Bytes& bytes);

Bytes EncodePpm(const Image& image);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PPM_H_
