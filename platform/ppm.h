// SPDX-License-Identifier: Apache-2.0
// Reads and writes binary PPM and PGM pictures. This module exists because stb_image accepts
// truncated PPM files and ignores the maximum value in the header.
#ifndef STARFOCUS_PLATFORM_PPM_H_
#define STARFOCUS_PLATFORM_PPM_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Decodes a P6 file, or converts a P5 file from grey to RGB. The maximum value may be up to 65535;
// if it exceeds 255, the picture also has codes of 16 bits. `path` appears only in error messages.
Result<DecodedPicture> DecodePpm(const std::string& path, const Bytes& bytes);

// Samples of a P6 or P5 file, 0 to `largest`.
struct PnmSamples {
  int width = 0, height = 0, channels = 0, largest = 0;
  std::vector<uint16_t> samples;
};

Result<PnmSamples> DecodePnmSamples(const std::string& path, const Bytes& bytes);

Bytes EncodePpm(const Image& image);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PPM_H_
