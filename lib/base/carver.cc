// SPDX-License-Identifier: Apache-2.0
#include "lib/base/carver.h"

#ifdef STARFOCUS_RED_ZONES
#include <sanitizer/asan_interface.h>
#endif

namespace starfocus {

#ifdef STARFOCUS_RED_ZONES
void PoisonZone(const void* base, size_t offset, size_t bytes) {
  ASAN_POISON_MEMORY_REGION(static_cast<const uint8_t*>(base) + offset, bytes);
}
void UnpoisonZone(const void* base, size_t offset, size_t bytes) {
  ASAN_UNPOISON_MEMORY_REGION(static_cast<const uint8_t*>(base) + offset, bytes);
}
#else
void PoisonZone(const void*, size_t, size_t) {}
void UnpoisonZone(const void*, size_t, size_t) {}
#endif

}  // namespace starfocus
