// SPDX-License-Identifier: Apache-2.0
// Manages the memory of stb_image and stb_image_write.
#ifndef STARFOCUS_PLATFORM_STB_MEMORY_H_
#define STARFOCUS_PLATFORM_STB_MEMORY_H_

#include <cstddef>

namespace starfocus {

// stb's functions may be called on a thread while an object of this class exists there. Since stb
// may continue after a failed allocation, Allocate throws std::bad_alloc instead of returning null.
// The destructor frees all memory that stb has not freed, including returned pictures.
class StbMemory {
 public:
  StbMemory() = default;
  ~StbMemory();
  StbMemory(const StbMemory&) = delete;
  StbMemory& operator=(const StbMemory&) = delete;

  // Replacements of malloc, realloc and free for stb.
  static void* Allocate(size_t size);
  static void* Reallocate(void* memory, size_t size);
  static void Free(void* memory);
};

// A stbi_write_func: appends to the std::vector<uint8_t> that `bytes` points to.
void AppendStb(void* bytes, void* data, int size);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_STB_MEMORY_H_
