// SPDX-License-Identifier: Apache-2.0
#include "lib/base/arena.h"

#ifdef STARFOCUS_RED_ZONES
#include <sanitizer/asan_interface.h>
#endif

namespace starfocus {

#ifdef STARFOCUS_RED_ZONES
void PoisonZone(void* base, size_t, size_t end) {
  ASAN_POISON_MEMORY_REGION(static_cast<uint8_t*>(base) + end - kRedZone, kRedZone);
}
void UnpoisonZone(void* base, size_t, size_t end) {
  ASAN_UNPOISON_MEMORY_REGION(static_cast<uint8_t*>(base) + end - kRedZone, kRedZone);
}
#else
void PoisonZone(void*, size_t, size_t) {}
void UnpoisonZone(void*, size_t, size_t) {}
#endif

}  // namespace starfocus
