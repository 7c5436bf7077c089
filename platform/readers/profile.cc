// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/profile.h"

#include "platform/icc_profile.h"

namespace starfocus {

void CheckProfile(DepthPhoto* photo) {
  Bytes* icc = &photo->metadata.icc;
  if (icc->empty()) return;
  const bool kept = IsRgbProfile(*icc);
  photo->facts.emplace_back("colour profile",
                            "ICC, " + std::to_string(icc->size()) + " bytes; " +
                                (kept ? "pixels are not converted"
                                      : "ignored, because it is not a complete RGB profile"));
  if (!kept) icc->clear();
}

}  // namespace starfocus
