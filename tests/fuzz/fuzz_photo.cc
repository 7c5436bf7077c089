// SPDX-License-Identifier: Apache-2.0
// The readers of depth photos but for HEIF, which has a target of its own: it takes ten times as
// long.
#include "platform/readers/heic.h"
#include "tests/fuzz/check_photo.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (!starfocus::IsHeif({data, size})) starfocus::fuzz::CheckPhoto(data, size);
  return 0;
}
