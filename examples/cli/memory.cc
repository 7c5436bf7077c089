// SPDX-License-Identifier: Apache-2.0
// Sets up the memory of the program for pictures and maps. Refocusing a photo of 12 megapixels
// allocates 420 MB in blocks of 12 to 100 MB, one after another. By default, the C library maps and
// unmaps each block in pages of 4 KiB, which takes as long as all computations together.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define STARFOCUS_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define STARFOCUS_ADDRESS_SANITIZER
#endif
#ifndef STARFOCUS_ADDRESS_SANITIZER  // which keeps its own functions, which check each block
#include <sys/mman.h>
#include <unistd.h>

#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__GLIBC__) || defined(MADV_DONTFORK)
#include <malloc.h>
#endif

namespace {

// Allocations of at least this size prefer large pages, which have 2 MiB on most processors.
constexpr size_t kLarge = size_t{1} << 20;

// Gives the system advice for the whole pages of a block of memory.
void Advise(void* memory, size_t size, int advice) {
  static const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = (reinterpret_cast<uintptr_t>(memory) + page - 1) / page * page;
  const auto end = (reinterpret_cast<uintptr_t>(memory) + size) / page * page;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

// Asks the system for large pages. Systems that always or never use large pages ignore the request.
void PreferLargePages(void* memory, size_t size) {
#ifdef MADV_HUGEPAGE
  Advise(memory, size, MADV_HUGEPAGE);
#endif
}

// Keeps a block of memory out of processes that decode files (platform/helper), or ends this. While
// such a process runs, the system copies each page of shared memory that the program writes.
void KeepFromHelpers(void* memory, size_t size, bool keep) {
#ifdef MADV_DONTFORK
  if (size >= kLarge) Advise(memory, size, keep ? MADV_DONTFORK : MADV_DOFORK);
#endif
}

// Calls `allocate` until it succeeds or no handler frees memory.
template <class Allocate>
void* Take(size_t size, const Allocate& allocate) {
  for (;;) {
    if (void* const memory = allocate(size == 0 ? 1 : size)) {
      if (size >= kLarge) PreferLargePages(memory, size);
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

#ifdef __GLIBC__
// Makes all blocks of all threads, also those of decoders and encoders, come from one heap that
// keeps freed memory. The memory of a step then serves the next step.
[[gnu::constructor]] void KeepFreedMemory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_ARENA_MAX, 1);
}
#endif

}  // namespace

// The forms of operator new and operator delete that are not here call these.
void* operator new(size_t size) {
  return Take(size, [](size_t bytes) { return std::malloc(bytes); });
}

// Only the workspaces of the library are aligned.
void* operator new(size_t size, std::align_val_t alignment) {
  void* const block = Take(size, [alignment](size_t bytes) {
    void* memory = nullptr;
    return posix_memalign(&memory, static_cast<size_t>(alignment), bytes) == 0 ? memory : nullptr;
  });
  KeepFromHelpers(block, size, true);
  return block;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }

void operator delete(void* memory, std::align_val_t) noexcept {
#ifdef MADV_DONTFORK
  if (memory != nullptr) KeepFromHelpers(memory, malloc_usable_size(memory), false);
#endif
  std::free(memory);
}

void operator delete(void* memory, size_t, std::align_val_t alignment) noexcept {
  operator delete(memory, alignment);
}

#endif
