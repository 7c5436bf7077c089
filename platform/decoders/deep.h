// SPDX-License-Identifier: Apache-2.0
// Parts that decoders of pictures with more than 8 bits or alpha share.
#ifndef STARFOCUS_PLATFORM_DECODERS_DEEP_H_
#define STARFOCUS_PLATFORM_DECODERS_DEEP_H_

#include <cstdint>

#include "platform/colour_description.h"
#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"

namespace starfocus {

// Returns the starfocus_transfer of codes with this description. Curves that starfocus_transfer
// lacks, and codes of the narrow range, count as sRGB.
int32_t TransferOf(const ColourDescription& colours);

// Returns the colours of the codes of a file. The chunk cICP overrides an ICC profile, which
// overrides other descriptions. The form is empty if the colours are unknown.
ColourDescription ColoursOf(const Metadata& metadata);

// Returns true if codes of the transfer need more than 8 bits: PQ and HLG.
bool IsHdr(int32_t transfer);

// Converts a picture of 8 bits to codes of 16 bits: 255 becomes 65535. If `alphas` is not empty,
// the result has an alpha channel.
DeepImage Widen(const Image& image, const Bytes& alphas);

// Converts codes with alpha that are multiplied with alpha to straight codes.
void DivideByAlpha(DeepImage* deep);

// Completes a picture of which a decoder has set the metadata and `deep` (codes of 16 bits),
// `image` or both. `bits` is the number of bits of the samples in the file. Sets the transfer of
// `deep`, `is_transparent`, and `image` if it is empty or PQ or HLG. Removes `deep` if `image` is
// the same picture: if samples have 8 bits, all pixels are opaque, and the transfer is neither PQ
// nor HLG.
void CompleteDeep(int bits, DecodedPicture* picture);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_DEEP_H_
