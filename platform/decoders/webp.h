// SPDX-License-Identifier: Apache-2.0
// Decodes the pixels and metadata of WebP files.
#ifndef STARFOCUS_PLATFORM_DECODERS_WEBP_H_
#define STARFOCUS_PLATFORM_DECODERS_WEBP_H_

#include <string>

#include "platform/file.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if the bytes start with the signature of WebP files.
bool IsWebp(const Bytes& bytes);

// Decodes a still picture to RGB without alpha. Requires libwebp. `where` appears only in error
// messages.
Result<DecodedPicture> DecodeWebp(const std::string& where, const Bytes& webp);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_WEBP_H_
