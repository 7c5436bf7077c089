// SPDX-License-Identifier: Apache-2.0
// Structures that begin with their size, of callers whose headers may be older than the library.
#ifndef STARFOCUS_LIB_API_SIZED_H_
#define STARFOCUS_LIB_API_SIZED_H_

#include <cstdint>
#include <cstring>

namespace starfocus {

// Writes the defaults as far as the caller's structure goes, zeros beyond, and its size.
template <class Structure>
void InitSized(Structure defaults, uint32_t size, Structure* given) {
  if (given == nullptr || size < sizeof size) return;
  defaults.size = size;
  if (size > sizeof defaults) std::memset(static_cast<void*>(given), 0, size);
  std::memcpy(static_cast<void*>(given), &defaults,
              size < sizeof defaults ? size : sizeof defaults);
}

// Reads what the caller's structure has into *full, which holds defaults for the rest. Returns
// false if it was not initialized, or by a newer header.
template <class Structure>
bool ReadSized(const Structure& given, Structure* full) {
  const uint32_t size = given.size;
  if (size <= sizeof size || size > sizeof(Structure)) return false;
  std::memcpy(static_cast<void*>(full), &given, size);
  return true;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_SIZED_H_
