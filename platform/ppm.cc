// SPDX-License-Identifier: Apache-2.0
#include "platform/ppm.h"

#include "platform/text_header.h"

namespace starfocus {
namespace {

uint8_t Sample(const uint8_t* data, int bytes_per_sample, int largest) {
  const int value = bytes_per_sample == 2 ? data[0] * 256 + data[1] : data[0];
  const int clipped = value < largest ? value : largest;
  return static_cast<uint8_t>((clipped * 255 + largest / 2) / largest);
}

}  // namespace

std::string DecodePpm(const std::string& path, const Bytes& bytes, Image* image) {
  TextHeader header(bytes);
  const std::string magic = header.Token();
  if (magic != "P6" && magic != "P5") return Expected(path, "a P6 or P5 picture", magic);
  const std::string width = header.Token(), height = header.Token(), largest = header.Token();
  const int w = ParseSize(width), h = ParseSize(height), top = ParseSize(largest);
  if (w == 0 || h == 0) {
    return Expected(path, "width and height from 1 to 65535",
                    "'" + width + "' and '" + height + "'");
  }
  if (top == 0) return Expected(path, "a largest value from 1 to 65535", "'" + largest + "'");
  const int channels = magic == "P6" ? 3 : 1, sample_bytes = top > 255 ? 2 : 1;
  if (!FitsMemory(w, h, 3 * sample_bytes)) return OutOfMemory(path, "read it");
  const size_t pixels = size_t(w) * size_t(h), need = pixels * size_t(channels * sample_bytes);
  if (header.remaining() < need) {
    return Expected(path, std::to_string(need) + " bytes of pixels",
                    std::to_string(header.remaining()));
  }
  *image = Image(w, h);
  const uint8_t* data = header.data();
  for (size_t i = 0; i < pixels * 3; ++i) {
    const size_t source = channels == 3 ? i : i / 3;
    image->pixels[i] = Sample(data + source * size_t(sample_bytes), sample_bytes, top);
  }
  return "";
}

Bytes EncodePpm(const Image& image) {
  const std::string header =
      "P6\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
  Bytes bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), image.pixels.begin(), image.pixels.end());
  return bytes;
}

}  // namespace starfocus
