// SPDX-License-Identifier: Apache-2.0
// Chooses the matte of the subject among the mattes that Apple's cameras store as auxiliary
// pictures of HEIC and JPEG files.
#ifndef STARFOCUS_PLATFORM_READERS_APPLE_MATTES_H_
#define STARFOCUS_PLATFORM_READERS_APPLE_MATTES_H_

#include <functional>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/pfm.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

struct AuxiliaryPicture {
  std::string type;  // For example "urn:com:apple:photo:2019:aux:semantichairmatte".
  // Returns the levels of the picture, 0 to 1. Error messages start with `where`.
  std::function<Result<FloatMap>(const std::string& where)> decode;
  Bytes xmp = {};  // XMP packet of the picture, if the reader needs it.
};

// Sets photo->matte to the portrait effects matte, which contains the whole subject. Without a
// usable portrait effects matte, photo->matte is the maximum of the mattes of hair, skin, teeth and
// glasses. Adds a fact that names all mattes, and a note for each matte that is damaged or that
// CheckMatte (matte.h) rejects. Ignores auxiliary pictures that are not mattes. The caller must
// have read photo->picture and photo->map.
void ChooseMatte(const std::vector<AuxiliaryPicture>& pictures, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_APPLE_MATTES_H_
