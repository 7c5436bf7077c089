// SPDX-License-Identifier: Apache-2.0
// Limits the memory that reading a picture takes to 64 MiB plus 16 bytes for each pixel that the
// file declares. Aborts if a reader exceeds the limit. Only Linux can measure the memory of each
// input; other systems check nothing.
#ifndef STARFOCUS_TESTS_FUZZ_MEMORY_BUDGET_H_
#define STARFOCUS_TESTS_FUZZ_MEMORY_BUDGET_H_

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "platform/readers/heif_boxes.h"
#include "tests/support/sanitizers.h"

namespace starfocus::fuzz {

// Largest number of pixels that a reader accepts. Larger numbers are reduced to this limit.
inline constexpr int64_t kMostPixels = int64_t{1} << 28;

inline int64_t PixelsOf(int64_t width, int64_t height) {
  return width > 0 && height > kMostPixels / width ? kMostPixels : width * height;
}

inline int64_t WholeAt(const uint8_t* data, int bytes, bool big) {
  int64_t value = 0;
  for (int k = 0; k < bytes; ++k) value = value << 8 | data[big ? k : bytes - 1 - k];
  return value;
}

// Returns the sum of the pixels that all PNG headers and JPEG frames in the file declare. A photo
// may contain several pictures.
inline int64_t PixelsOfHeaders(const uint8_t* data, size_t size) {
  int64_t pixels = 0;
  for (size_t at = 0; at + 12 <= size; ++at) {
    const uint8_t* here = data + at;
    if (std::memcmp(here, "IHDR", 4) == 0)
      pixels += PixelsOf(WholeAt(here + 4, 4, true), WholeAt(here + 8, 4, true));
    if (here[0] == 0xff && here[1] >= 0xc0 && here[1] <= 0xcf && here[1] != 0xc4) {
      pixels += WholeAt(here + 5, 2, true) * WholeAt(here + 7, 2, true);
    }
  }
  return pixels;
}

// Returns the number of pixels of a WebP file (RFC 9649, 2.5 to 2.7). For a file with a canvas,
// returns the number of pixels of the canvas.
inline int64_t PixelsOfWebp(const uint8_t* data, size_t size) {
  if (size < 30) return 0;
  if (std::memcmp(data + 12, "VP8X", 4) == 0) {
    return (WholeAt(data + 24, 3, false) + 1) * (WholeAt(data + 27, 3, false) + 1);
  }
  if (std::memcmp(data + 12, "VP8L", 4) == 0) {
    const int64_t bits = WholeAt(data + 21, 4, false);
    return ((bits & 0x3fff) + 1) * ((bits >> 14 & 0x3fff) + 1);
  }
  return (WholeAt(data + 26, 2, false) & 0x3fff) * (WholeAt(data + 28, 2, false) & 0x3fff);
}

inline int64_t DeclaredPixels(const uint8_t* data, size_t size) {
  if (size >= 12 && std::memcmp(data, "RIFF", 4) == 0) return PixelsOfWebp(data, size);
  const auto items = HeifBrands({data, size}).empty() ? std::nullopt : ReadHeifItems({data, size});
  if (items) {
    int64_t pixels = 0;
    for (const auto& [id, item] : *items) pixels += PixelsOf(item.width, item.height);
    return pixels;
  }
  return PixelsOfHeaders(data, size);
}

// Returns the number of KiB in the named line of /proc/self/status, or -1 if there is no such line.
inline int64_t StatusOf(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, name.size(), name) == 0) return std::atoll(line.c_str() + name.size());
  }
  return -1;
}

class MemoryBudget {
 public:
  MemoryBudget(const uint8_t* data, size_t size) : pixels_(DeclaredPixels(data, size)) {
    std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak to the current memory use
    before_ = StatusOf("VmHWM:");
  }
  ~MemoryBudget() {
    const int64_t most = kShare * (64 * 1024 + 16 * pixels_ / 1024),
                  used = StatusOf("VmHWM:") - before_;
    if (before_ < 0 || used <= most) return;
    std::fprintf(stderr, "%lld KiB for %lld declared pixels, expected at most %lld\n",
                 static_cast<long long>(used), static_cast<long long>(pixels_),
                 static_cast<long long>(most));
    std::abort();
  }
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

 private:
  // AddressSanitizer keeps freed memory for a while.
  static constexpr int64_t kShare = test::kSanitized ? 4 : 1;

  const int64_t pixels_;
  int64_t before_ = 0;
};

}  // namespace starfocus::fuzz

#endif  // STARFOCUS_TESTS_FUZZ_MEMORY_BUDGET_H_
