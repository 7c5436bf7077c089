// SPDX-License-Identifier: Apache-2.0
// Manages the memory of stb_image and stb_image_write.
#ifndef STARFOCUS_PLATFORM_STB_MEMORY_H_
#define STARFOCUS_PLATFORM_STB_MEMORY_H_

#include <cstddef>

namespace starfocus {

// A thread may call functions of stb while an object of class StbMemory exists on this thread.
// Since stb may continue after a failed allocation, Allocate throws std::bad_alloc instead of
// returning null. The destructor frees all memory that stb has not freed, including pictures that
// stb returned.
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

// A function of type stbi_write_func. Appends the data to the std::vector<uint8_t> that `bytes`
// points to.
void AppendStb(void* bytes, void* data, int size);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_STB_MEMORY_H_
