// SPDX-License-Identifier: Apache-2.0
// Encodes sixels with libsixel.
#include "platform/writers/sixel.h"

#include <sixel/sixel.h>

#include <memory>

namespace starfocus {
namespace {

constexpr int kColors = 256;  // number of colour registers that sixel terminals have by default

struct Free {
  void operator()(sixel_output_t* output) const { sixel_output_unref(output); }
  void operator()(sixel_dither_t* dither) const { sixel_dither_unref(dither); }
};

int Append(char* data, int size, void* text) {
  static_cast<std::string*>(text)->append(data, static_cast<size_t>(size));
  return size;
}

}  // namespace

Result<std::string> EncodeSixel(const std::string& where, const Image& image) {
  std::string text;
  sixel_output_t* raw_output = nullptr;
  sixel_dither_t* raw_dither = nullptr;
  SIXELSTATUS status = sixel_output_new(&raw_output, Append, &text, nullptr);
  const std::unique_ptr<sixel_output_t, Free> output(raw_output);
  if (SIXEL_SUCCEEDED(status)) status = sixel_dither_new(&raw_dither, kColors, nullptr);
  const std::unique_ptr<sixel_dither_t, Free> dither(raw_dither);
  Image copy = image;  // libsixel changes the pixels.
  if (SIXEL_SUCCEEDED(status)) {
    status = sixel_dither_initialize(dither.get(), copy.pixels.data(), copy.width, copy.height,
                                     SIXEL_PIXELFORMAT_RGB888, SIXEL_LARGE_AUTO, SIXEL_REP_AUTO,
                                     SIXEL_QUALITY_HIGH);
  }
  if (SIXEL_SUCCEEDED(status)) {
    status =
        sixel_encode(copy.pixels.data(), copy.width, copy.height, 3, dither.get(), output.get());
  }
  if (SIXEL_FAILED(status)) {
    return Expected(where, "a picture that libsixel can encode", sixel_helper_format_error(status));
  }
  return text;
}

}  // namespace starfocus
