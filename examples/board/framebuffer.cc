// SPDX-License-Identifier: Apache-2.0
#include "examples/board/framebuffer.h"

#include <fcntl.h>
#include <linux/fb.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "platform/file.h"

namespace starfocus {

namespace {

// Shifts the `field.length` highest bits of an 8-bit sample to the bits of a pixel that start at
// bit `field.offset`.
uint32_t Placed(uint8_t sample, PixelField field) {
  const uint32_t bits = field.length >= 8 ? uint32_t{sample} << (field.length - 8)
                                          : uint32_t{sample} >> (8 - field.length);
  return bits << field.offset;
}

void DrawRow(const uint8_t* rgb, int count, const Screen& screen, uint8_t* out) {
  for (int x = 0; x < count; ++x, rgb += 3) {
    uint32_t pixel =
        Placed(rgb[0], screen.red) | Placed(rgb[1], screen.green) | Placed(rgb[2], screen.blue);
    for (int byte = 0; byte < screen.bytes_per_pixel; ++byte, pixel >>= 8) {
      *out++ = static_cast<uint8_t>(pixel);
    }
  }
}

PixelField FieldOf(const fb_bitfield& field) {
  return {static_cast<int>(field.offset), static_cast<int>(field.length)};
}

bool Fits(PixelField field, int bits) {
  return field.length >= 1 && field.length <= 16 && field.offset + field.length <= bits;
}

// A screen, and the mapping of its memory into this process.
struct Mapping {
  Screen screen;
  void* memory = nullptr;
  size_t bytes = 0;
};

Result<Mapping> Map(const std::string& path, int file) {
  fb_var_screeninfo shown = {};
  fb_fix_screeninfo fixed = {};
  if (ioctl(file, FBIOGET_VSCREENINFO, &shown) != 0 ||
      ioctl(file, FBIOGET_FSCREENINFO, &fixed) != 0) {
    return Expected(path, "a framebuffer", "another kind of file");
  }
  const int bits = static_cast<int>(shown.bits_per_pixel);
  Screen screen = {
      nullptr,  static_cast<int>(shown.xres), static_cast<int>(shown.yres), fixed.line_length,
      bits / 8, FieldOf(shown.red),           FieldOf(shown.green),         FieldOf(shown.blue)};
  const bool known = fixed.type == FB_TYPE_PACKED_PIXELS &&
                     (bits == 16 || bits == 24 || bits == 32) && Fits(screen.red, bits) &&
                     Fits(screen.green, bits) && Fits(screen.blue, bits);
  if (!known) {
    return Expected(path, "a colour format of 16, 24 or 32 bits per pixel",
                    "another format of " + std::to_string(bits) + " bits");
  }
  const size_t bytes = fixed.smem_len;
  const size_t first =
      shown.yoffset * screen.stride + shown.xoffset * static_cast<size_t>(screen.bytes_per_pixel);
  if (first + screen.stride * static_cast<size_t>(screen.height) > bytes) {
    return Expected(path, "memory for the whole screen", "less");
  }
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) return Cannot("map", path, {errno, std::generic_category()});
  screen.memory = static_cast<uint8_t*>(memory) + first;
  return Mapping{screen, memory, bytes};
}

}  // namespace

void Draw(const Image& picture, const Screen& screen) {
  const int width = std::min(picture.width, screen.width);
  const int height = std::min(picture.height, screen.height);
  const int from_x = (picture.width - width) / 2, from_y = (picture.height - height) / 2;
  const int to_x = (screen.width - width) / 2, to_y = (screen.height - height) / 2;
  const auto pixel = static_cast<size_t>(screen.bytes_per_pixel);
  for (int y = 0; y < screen.height; ++y) {
    uint8_t* row = screen.memory + static_cast<size_t>(y) * screen.stride;
    std::memset(row, 0, static_cast<size_t>(screen.width) * pixel);
    if (y < to_y || y >= to_y + height) continue;
    DrawRow(picture.row(y - to_y + from_y) + 3 * from_x, width, screen,
            row + static_cast<size_t>(to_x) * pixel);
  }
}

Error ShowOnFramebuffer(const std::string& path, const Image& picture) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return Cannot("open framebuffer", path, {errno, std::generic_category()});
  const Result<Mapping> mapped = Map(path, file);
  if (mapped) {
    Draw(picture, mapped->screen);
    munmap(mapped->memory, mapped->bytes);
  }
  close(file);
  return mapped.error();
}

}  // namespace starfocus
