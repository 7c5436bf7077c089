// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/profile.h"

#include <algorithm>
#include <utility>

#include "platform/decoders/deep.h"
#include "platform/icc_profile.h"

namespace starfocus {
namespace {

constexpr char kFact[] = "colour profile";

std::string Describe(const ColourDescription& colours) {
  return NameOf(colours) + " (" + colours.form + ")";
}

void CheckProfile(DepthPhoto* photo) {
  Bytes* icc = &photo->metadata.icc;
  if (icc->empty()) return;
  const bool kept = IsRgbProfile(*icc);
  photo->facts.emplace_back(kFact,
                            "ICC, " + std::to_string(icc->size()) + " bytes; " +
                                (kept ? "pixels are not converted"
                                      : "ignored, because it is not a complete RGB profile"));
  if (!kept) icc->clear();
}

// Sets photo->is_linear, and adds a note if the program does not decode the transfer of the codes.
void JudgeTransfer(const ColourDescription& colours, DepthPhoto* photo) {
  photo->is_linear = IsLinear(colours);
  const std::string transfer = TransferNameOf(colours);
  // A gamma of 2.2 differs from the transfer of sRGB by less than 0.01 of the light of white.
  if (photo->is_linear || transfer == "sRGB" || transfer.rfind("gamma 2.2", 0) == 0) return;
  photo->notes.push_back("the transfer " + transfer + " (" + colours.form +
                         ") counts as that of sRGB");
}

// Describes `colours`, which a profile expresses. If they are those of a rendition in sRGB,
// describes the colours of the light.
std::string FactOf(const DepthPhoto& photo, const ColourDescription& colours) {
  if (!photo.deep || !(photo.deep->is_half || IsHdr(photo.deep->transfer))) {
    return Describe(colours) + ", written as an ICC profile";
  }
  return Describe(photo.deep_colours);
}

// Replaces a description that a profile can express.
void ToProfile(DepthPhoto* photo) {
  Metadata* metadata = &photo->metadata;
  const ColourDescription colours = metadata->colours;
  const std::string what = Describe(colours);
  Bytes profile = ProfileOf(colours);
  if (IsSrgb(colours) || !profile.empty()) {
    metadata->colours = {};
    metadata->icc.clear();
    if (IsSrgb(colours)) return;
    JudgeTransfer(colours, photo);
    metadata->icc = std::move(profile);
    photo->facts.emplace_back(kFact, FactOf(*photo, colours));
    return;
  }
  // Only code points of H.273 have a form in PNG files.
  if (std::max(colours.primaries, colours.transfer) >= ColourDescription::kGiven) {
    metadata->colours = {};
    photo->notes.push_back("the description of the colours is ignored, because it is invalid: " +
                           what);
    return;
  }
  if (!IsRgbProfile(metadata->icc)) metadata->icc.clear();
  photo->facts.emplace_back(kFact, what + ", kept in PNG files");
  photo->notes.push_back("the colours are " + what +
                         ", which the program does not decode: the picture is refocused as if it "
                         "were sRGB, and only PNG files keep the description");
}

}  // namespace

void ChooseProfile(DepthPhoto* photo) {
  ColourDescription* colours = &photo->metadata.colours;
  if (colours->form == kCicpForm) return ToProfile(photo);
  CheckProfile(photo);
  if (!photo->metadata.icc.empty()) {
    JudgeTransfer(ColoursOf(photo->metadata), photo);
    *colours = {};
  }
  if (!colours->form.empty()) ToProfile(photo);
}

}  // namespace starfocus
