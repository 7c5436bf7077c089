// SPDX-License-Identifier: Apache-2.0
// Reads and writes structures whose first field is their size. The size is required because the
// caller's header may be older than the library.
#ifndef STARFOCUS_LIB_API_SIZED_H_
#define STARFOCUS_LIB_API_SIZED_H_

#include <cstdint>
#include <cstring>

namespace starfocus {

// Writes the defaults to the part of the caller's structure that the library knows, writes zeros to
// the rest, and sets the field `size`.
template <class Structure>
void InitSized(Structure defaults, uint32_t size, Structure* given) {
  if (given == nullptr || size < sizeof size) return;
  defaults.size = size;
  if (size > sizeof defaults) std::memset(static_cast<void*>(given), 0, size);
  std::memcpy(static_cast<void*>(given), &defaults,
              size < sizeof defaults ? size : sizeof defaults);
}

// Copies the caller's structure to *full. The caller's structure may lack newer fields, so *full
// must contain the defaults. Returns false if the structure was not initialised, or was initialised
// by a newer header.
template <class Structure>
bool ReadSized(const Structure& given, Structure* full) {
  const uint32_t size = given.size;
  if (size <= sizeof size || size > sizeof(Structure)) return false;
  std::memcpy(static_cast<void*>(full), &given, size);
  return true;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_SIZED_H_
