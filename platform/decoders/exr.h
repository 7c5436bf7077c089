// SPDX-License-Identifier: Apache-2.0
// Decodes OpenEXR files: pictures of linear light, depth maps and mattes. An OpenEXR file has one
// part or more, and each part has named channels. The functions of this header require OpenEXR.
#ifndef STARFOCUS_PLATFORM_DECODERS_EXR_H_
#define STARFOCUS_PLATFORM_DECODERS_EXR_H_

#include <string>

#include "platform/file.h"
#include "platform/levels.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Decodes the channels R, G, B and, if it exists, A, or the channel Y, to a DeepImage of half
// floats and an 8-bit picture, both of the size of the display window. Pixels that the file does
// not store are black and transparent. In a file of several parts, layers or views, the first
// picture that does not belong to a right view is decoded. Channels of 32 bits are rounded to half
// floats, and infinite samples are limited. `where` appears only in error messages.
Result<DecodedPicture> DecodeExr(const std::string& where, const Bytes& exr);

// Decodes a depth map: the channel Z, otherwise a horizontal disparity (disparity.x), otherwise a
// channel whose name starts with "depth", otherwise the only channel of the file. Pixels that the
// file does not store are infinitely far in channels Z, and otherwise unknown. For a matte, the
// channel A is decoded, otherwise the channel Y or the only channel.
Result<Samples> DecodeExrSamples(const std::string& where, bool is_matte, const Bytes& exr);

// Returns true if a file that OpenEXR can read has a channel Z.
bool HasExrDistances(const Bytes& exr);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_EXR_H_
