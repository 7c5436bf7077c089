// SPDX-License-Identifier: Apache-2.0
// Fuzz target: depth photos in HEIF files, which also tests the calls of libheif.
#include "platform/readers/heic.h"
#include "tests/fuzz/check_photo.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (starfocus::IsHeif({data, size})) starfocus::fuzz::CheckPhoto(data, size);
  return 0;
}
