// SPDX-License-Identifier: Apache-2.0
// The memory of stb_image and stb_image_write.
#ifndef STARFOCUS_PLATFORM_STB_MEMORY_H_
#define STARFOCUS_PLATFORM_STB_MEMORY_H_

#include <cstddef>

namespace starfocus {

// While one lives, stb's functions may be called on its thread. They go on where some of their
// buffers could not be had, so when memory runs out they are left by std::bad_alloc instead. What
// they have not freed then is freed with this object; pictures that they return are, too.
class StbMemory {
 public:
  StbMemory() = default;
  ~StbMemory();
  StbMemory(const StbMemory&) = delete;
  StbMemory& operator=(const StbMemory&) = delete;

  // What stb calls instead of malloc, realloc and free.
  static void* Allocate(size_t size);
  static void* Reallocate(void* memory, size_t size);
  static void Free(void* memory);
};

// A stbi_write_func: appends to the std::vector<uint8_t> that `bytes` points to.
void AppendStb(void* bytes, void* data, int size);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_STB_MEMORY_H_
