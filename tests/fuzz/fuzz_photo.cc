// SPDX-License-Identifier: Apache-2.0
// Fuzz target: readers of depth photos except HEIF. HEIF is ten times as slow and has a separate
// target.
#include "platform/readers/heic.h"
#include "tests/fuzz/check_photo.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (!starfocus::IsHeif({data, size})) starfocus::fuzz::CheckPhoto(data, size);
  return 0;
}
