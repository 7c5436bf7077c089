// SPDX-License-Identifier: Apache-2.0
#include "platform/ppm.h"

#include "platform/decoders/deep.h"
#include "platform/text_header.h"

namespace starfocus {
namespace {

struct PnmHeader {
  int width = 0, height = 0, channels = 0, largest = 0, sample_bytes = 0;

  size_t samples() const { return size_t(width) * size_t(height) * size_t(channels); }
};

// Reads the header, and checks that the file contains all samples.
Result<PnmHeader> ReadHeader(const std::string& path, TextHeader* text) {
  const std::string magic = text->Token();
  if (magic != "P6" && magic != "P5") return Expected(path, "a P6 or P5 picture", magic);
  const std::string width = text->Token(), height = text->Token(), largest = text->Token();
  PnmHeader header = {ParseSize(width), ParseSize(height), magic == "P6" ? 3 : 1,
                      ParseSize(largest), 1};
  if (header.width == 0 || header.height == 0) {
    return Expected(path, "width and height from 1 to 65535",
                    "'" + width + "' and '" + height + "'");
  }
  if (header.largest == 0) {
    return Expected(path, "a maximum value from 1 to 65535", "'" + largest + "'");
  }
  if (header.largest > 255) header.sample_bytes = 2;
  // 3 bytes, and 6 more if samples have 16 bits
  if (!FitsMemory(header.width, header.height, header.sample_bytes == 1 ? 3 : 9)) {
    return OutOfMemory(path, "read it");
  }
  const size_t need = header.samples() * size_t(header.sample_bytes);
  if (text->remaining() >= need) return header;
  return Expected(path, std::to_string(need) + " bytes of pixels",
                  std::to_string(text->remaining()));
}

// Returns the sample at `index`, limited to the maximum value in the header.
int SampleAt(const PnmHeader& header, const uint8_t* data, size_t index) {
  const uint8_t* at = data + index * size_t(header.sample_bytes);
  const int value = header.sample_bytes == 2 ? at[0] * 256 + at[1] : at[0];
  return value < header.largest ? value : header.largest;
}

}  // namespace

Result<DecodedPicture> DecodePpm(const std::string& path, const Bytes& bytes) {
  TextHeader text(bytes);
  const Result<PnmHeader> read = ReadHeader(path, &text);
  if (!read) return read.error();
  const PnmHeader& header = *read;
  DecodedPicture picture;
  Image& image = picture.image = Image(header.width, header.height);
  if (header.sample_bytes == 2) picture.deep = DeepImage(header.width, header.height, 3);
  const auto scale = [&header](int value, int64_t largest) {
    return (value * largest + header.largest / 2) / header.largest;
  };
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const int value = SampleAt(header, text.data(), header.channels == 3 ? i : i / 3);
    image.pixels[i] = static_cast<uint8_t>(scale(value, 255));
    if (picture.deep) picture.deep->samples[i] = static_cast<uint16_t>(scale(value, 65535));
  }
  if (!picture.deep) return picture;
  int bits = 9;
  while (header.largest >= 1 << bits) ++bits;
  CompleteDeep(bits, &picture);
  return picture;
}

Result<PnmSamples> DecodePnmSamples(const std::string& path, const Bytes& bytes) {
  TextHeader text(bytes);
  const Result<PnmHeader> header = ReadHeader(path, &text);
  if (!header) return header.error();
  PnmSamples result = {header->width, header->height, header->channels, header->largest, {}};
  const size_t count = header->samples();
  result.samples.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    result.samples.push_back(static_cast<uint16_t>(SampleAt(*header, text.data(), i)));
  }
  return result;
}

Bytes EncodePpm(const Image& image) {
  const std::string header =
      "P6\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
  Bytes bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), image.pixels.begin(), image.pixels.end());
  return bytes;
}

}  // namespace starfocus
