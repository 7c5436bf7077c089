// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/deep.h"

#include <algorithm>

#include "platform/deep_image.h"
#include "platform/icc_profile.h"

namespace starfocus {

int32_t TransferOf(const ColourDescription& colours) {
  constexpr int kPq = 16, kHlg = 18;  // code points of H.273
  if (!colours.full_range) return STARFOCUS_TRANSFER_SRGB;
  if (colours.transfer == kPq) return STARFOCUS_TRANSFER_PQ;
  if (colours.transfer == kHlg) return STARFOCUS_TRANSFER_HLG;
  return IsLinear(colours) ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
}

ColourDescription ColoursOf(const Metadata& metadata) {
  if (metadata.colours.form == kCicpForm || !IsRgbProfile(metadata.icc)) return metadata.colours;
  return DescriptionOf(metadata.icc).value_or(ColourDescription());
}

bool IsHdr(int32_t transfer) {
  return transfer == STARFOCUS_TRANSFER_PQ || transfer == STARFOCUS_TRANSFER_HLG;
}

DeepImage Widen(const Image& image, const Bytes& alphas) {
  DeepImage deep(image.width, image.height, alphas.empty() ? 3 : 4);
  uint16_t* to = deep.samples.data();
  const uint8_t* from = image.pixels.data();
  for (size_t k = 0; k < image.pixels.size() / 3; ++k) {
    for (int c = 0; c < 3; ++c) *to++ = static_cast<uint16_t>(257 * *from++);
    if (!alphas.empty()) *to++ = static_cast<uint16_t>(257 * alphas[k]);
  }
  return deep;
}

void DivideByAlpha(DeepImage* deep) {
  for (size_t at = 0; at < deep->samples.size(); at += 4) {
    uint16_t* pixel = &deep->samples[at];
    const uint32_t alpha = pixel[3];
    for (int c = 0; c < 3 && alpha > 0; ++c) {
      pixel[c] = static_cast<uint16_t>(std::min(65535U, (pixel[c] * 65535U + alpha / 2) / alpha));
    }
  }
}

void CompleteDeep(int bits, DecodedPicture* picture) {
  const int32_t transfer = TransferOf(ColoursOf(picture->metadata));
  if (!picture->deep && IsHdr(transfer)) picture->deep = Widen(picture->image, {});
  if (!picture->deep) return;
  picture->bits = bits;
  DeepImage& deep = *picture->deep;
  deep.bits = bits;
  deep.transfer = deep.is_half ? STARFOCUS_TRANSFER_NONE : transfer;
  picture->is_transparent = DropOpaqueAlpha(&deep);
  if (picture->image.pixels.empty() || IsHdr(transfer)) picture->image = ToImage(deep);
  if (bits <= 8 && !picture->is_transparent && !IsHdr(transfer)) picture->deep.reset();
}

}  // namespace starfocus
