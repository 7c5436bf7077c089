// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/deep_photo.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <utility>

#include "platform/decoders/deep.h"
#include "platform/deep_image.h"

namespace starfocus {
namespace {

std::string Times(double factor) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.3g times white", factor);
  return text;
}

// Returns the transfer that a file states, and the one that decodes it if it is another one.
std::string TransferName(const ColourDescription& colours, bool is_linear) {
  const bool is_stated = colours.transfer != ColourDescription::kUnspecified;
  if (is_linear || !is_stated) return is_linear ? "linear light" : "sRGB";
  const std::string name = TransferNameOf(colours);
  return name == "sRGB" ? name : name + ", decoded as sRGB";
}

}  // namespace

void TakePicture(DecodedPicture picture, DepthPhoto* photo) {
  photo->picture = std::move(picture.image);
  photo->metadata = std::move(picture.metadata);
  photo->deep = std::move(picture.deep);
  std::move(picture.notes.begin(), picture.notes.end(), std::back_inserter(photo->notes));
  if (!photo->deep) return;
  const DeepImage& deep = *photo->deep;
  photo->deep_colours = ColoursOf(photo->metadata);
  if (!deep.is_half && !IsHdr(deep.transfer)) return;
  const double largest = LargestLight(deep);
  // The rendition in 8 bits has the primaries of the file and the transfer of sRGB. A profile would
  // describe the codes of the file.
  constexpr int kSrgbTransfer = 13;  // code point of H.273
  ColourDescription& colours = photo->metadata.colours;
  colours = photo->deep_colours;
  if (!photo->metadata.icc.empty() && deep.is_half) {
    photo->notes.push_back(colours.form.empty()
                               ? "the ICC profile is ignored, because the samples are floats"
                               : "the curve of the ICC profile is ignored, because the samples are "
                                 "floats");
  }
  if (!colours.form.empty()) colours.transfer = kSrgbTransfer;
  photo->metadata.icc.clear();
  if (largest > 1) {
    photo->lost.push_back("light brighter than white, up to " + Times(largest) +
                          ", is clipped in the picture of 8 bits");
  }
}

Facts FactsOfLight(const LightField& light_field, const Metadata& metadata,
                   const GainMap& gain_map) {
  const bool is_deep = !light_field.deep.empty();
  const DeepImage none;
  const DeepImage& deep = is_deep ? light_field.deep[0] : none;
  ColourDescription colours = is_deep ? light_field.deep_colours : ColourDescription();
  if (colours.form.empty()) colours = ColoursOf(metadata);
  const bool has_unknown = colours.form.empty() && !metadata.icc.empty();
  Facts facts = {{"samples", std::to_string(is_deep ? deep.bits : 8) + " bits, " +
                                 (deep.is_half ? "floats" : "integers")}};
  const bool is_linear =
      is_deep ? deep.is_half || deep.transfer == STARFOCUS_TRANSFER_NONE : light_field.is_linear;
  facts.emplace_back("transfer", deep.transfer == STARFOCUS_TRANSFER_PQ ? "PQ, white at 203 cd/m2"
                                 : deep.transfer == STARFOCUS_TRANSFER_HLG
                                     ? "HLG, white at code 0.75"
                                 : has_unknown ? "that of the ICC profile, decoded as sRGB"
                                               : TransferName(colours, is_linear));
  facts.emplace_back("primaries",
                     has_unknown ? "those of the ICC profile" : PrimariesNameOf(colours));
  if (deep.channels == 4) {
    facts.emplace_back("alpha", deep.is_multiplied ? "premultiplied" : "not premultiplied");
  }
  if (deep.is_half || IsHdr(deep.transfer)) {
    double largest = 0;
    for (const DeepImage& view : light_field.deep) largest = std::max(largest, LargestLight(view));
    facts.emplace_back("headroom",
                       Times(largest) + (largest > double{kMostLight} ? ", limited to 64" : ""));
  } else if (!gain_map.levels.empty()) {
    const double stops = *std::max_element(gain_map.max.begin(), gain_map.max.end());
    facts.emplace_back("headroom", "at most " + Times(std::exp2(std::max(stops, 0.0))));
  }
  return facts;
}

}  // namespace starfocus
