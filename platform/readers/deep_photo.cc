// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/deep_photo.h"

#include <cstdio>
#include <string>
#include <utility>

#include "platform/decoders/deep.h"
#include "platform/deep_image.h"

namespace starfocus {
namespace {

std::string TransferName(const DeepImage& deep) {
  if (deep.is_half || deep.transfer == STARFOCUS_TRANSFER_NONE) return "linear light";
  return deep.transfer == STARFOCUS_TRANSFER_PQ    ? "PQ, white at 203 cd/m2"
         : deep.transfer == STARFOCUS_TRANSFER_HLG ? "HLG, white at code 0.75"
                                                   : "sRGB";
}

std::string Times(double factor) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.3g times white", factor);
  return text;
}

void AddFacts(int bits, const ColourDescription& colours, const DeepImage& deep, Facts* facts) {
  facts->emplace_back("samples",
                      std::to_string(bits) + " bits" + (deep.is_half ? ", floats" : ", integers"));
  facts->emplace_back("transfer", TransferName(deep));
  facts->emplace_back("primaries", PrimariesNameOf(colours));
  if (deep.channels == 4) {
    facts->emplace_back("alpha", deep.is_half ? "premultiplied" : "not premultiplied");
  }
}

}  // namespace

void TakePicture(DecodedPicture picture, DepthPhoto* photo) {
  photo->picture = std::move(picture.image);
  photo->metadata = std::move(picture.metadata);
  photo->deep = std::move(picture.deep);
  if (!photo->deep) return;
  const DeepImage& deep = *photo->deep;
  photo->deep_colours = photo->metadata.colours;
  AddFacts(picture.bits, photo->deep_colours, deep, &photo->facts);
  if (!deep.is_half && !IsHdr(deep.transfer)) return;
  const double largest = LargestLight(deep);
  photo->facts.emplace_back("headroom", Times(largest));
  // The rendition in 8 bits has the primaries of the file and the transfer of sRGB. A profile would
  // describe the codes of the file.
  constexpr int kSrgbTransfer = 13;  // code point of H.273
  ColourDescription& colours = photo->metadata.colours;
  if (!colours.form.empty()) colours.transfer = kSrgbTransfer;
  if (!photo->metadata.icc.empty() && deep.is_half) {
    photo->notes.push_back("the ICC profile is ignored, because the samples are floats");
  }
  photo->metadata.icc.clear();
  if (largest > 1) {
    photo->lost.push_back("light brighter than white, up to " + Times(largest) +
                          ", is clipped in the picture of 8 bits");
  }
}

}  // namespace starfocus
