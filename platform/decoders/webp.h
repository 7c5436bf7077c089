// SPDX-License-Identifier: Apache-2.0
// Pixels and metadata of WebP files.
#ifndef STARFOCUS_PLATFORM_DECODERS_WEBP_H_
#define STARFOCUS_PLATFORM_DECODERS_WEBP_H_

#include <string>

#include "platform/file.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if the file begins as a WebP file does.
bool IsWebp(const Bytes& bytes);

// Decodes a still picture to RGB, without its alpha, by libwebp where the build has it. `where`
// only names the file in errors.
Result<DecodedPicture> DecodeWebp(const std::string& where, const Bytes& webp);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_WEBP_H_
