// SPDX-License-Identifier: Apache-2.0
// Callbacks for libpng that the reader and the writer of PNG files share: memory and errors.
#ifndef STARFOCUS_PLATFORM_PNG_CALL_H_
#define STARFOCUS_PLATFORM_PNG_CALL_H_

#include <png.h>

#include <cstdio>
#include <cstdlib>

namespace starfocus {

struct PngCall {
  bool no_memory = false;
  char reason[100] = "";

  // Allocates memory and records a failure in `no_memory`, because libpng and zlib report
  // insufficient memory in different ways.
  static png_voidp Allocate(png_structp png, png_alloc_size_t size) {
    void* memory = std::malloc(size);
    if (memory == nullptr) static_cast<PngCall*>(png_get_mem_ptr(png))->no_memory = true;
    return memory;
  }
  static void Free(png_structp, png_voidp memory) { std::free(memory); }
  static void Fail(png_structp png, png_const_charp message) {
    PngCall* call = static_cast<PngCall*>(png_get_error_ptr(png));
    std::snprintf(call->reason, sizeof(call->reason), "%s", message);
    png_longjmp(png, 1);
  }
  static void KeepSilent(png_structp, png_const_charp) {}
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PNG_CALL_H_
