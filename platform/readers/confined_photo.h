// SPDX-License-Identifier: Apache-2.0
// Decodes photographs in a helper process (platform/helper/helper.h).
#ifndef STARFOCUS_PLATFORM_READERS_CONFINED_PHOTO_H_
#define STARFOCUS_PLATFORM_READERS_CONFINED_PHOTO_H_

#include <functional>
#include <string>

#include "platform/helper/channel.h"
#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Sends or receives a photo (channel.h).
void Pass(Channel* channel, DepthPhoto* photo);

// Calls `decode`, which decodes `file`, in a helper process, and returns its result.
Result<DepthPhoto> ConfinedPhoto(const std::string& where, Span file,
                                 const std::function<Result<DepthPhoto>()>& decode);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CONFINED_PHOTO_H_
