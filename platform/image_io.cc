// SPDX-License-Identifier: Apache-2.0
#include "platform/image_io.h"

#include <stb/stb_image.h>
#include <unistd.h>

#include <climits>
#include <new>

#include "platform/container.h"
#include "platform/png.h"
#include "platform/ppm.h"
#include "platform/standard_stream.h"
#include "platform/stb_memory.h"
#include "platform/writers/webp.h"

namespace starfocus {
namespace {

// stb_image reads 2^30 samples of a PNG file, which may have four a pixel, and counts bytes in an
// int.
constexpr int64_t kMostStbPixels = int64_t{1} << 28;

std::string SizeText(int64_t width, int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string CheckWhole(const std::string& path, const Bytes& bytes) {
  const Container container = CheckContainer(bytes);
  if (container == Container::kWhole) return "";
  if (container == Container::kTruncated) return Truncated(path, IsPng(bytes) ? "PNG" : "JPEG");
  if (container == Container::kBroken) {
    return Expected(path, "an undamaged picture", "a broken one (checksum or code table)");
  }
  return Expected(path, "a PNG, PPM or JPEG picture", DescribeFile(bytes));
}

std::string CheckSize(const std::string& path, int64_t width, int64_t height) {
  if (width < 1 || height < 1 || width > kMaxPictureSize || height > kMaxPictureSize) {
    return Expected(path, "width and height from 1 to 65535", SizeText(width, height));
  }
  if (width * height <= kMostStbPixels) return "";
  return Expected(path, "a PNG or JPEG picture of at most 2^28 pixels", SizeText(width, height));
}

std::string Broken(const std::string& path) {
  return Expected(path, "an undamaged picture",
                  "a broken one (" + std::string(stbi_failure_reason()) + ")");
}

// Samples of the picture, `channels` a pixel, in memory of the StbMemory that lives.
const stbi_uc* LoadStb(const Bytes& bytes, int channels, Image* image) {
  int own_channels = 0;
  const stbi_uc* samples =
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &image->width,
                            &image->height, &own_channels, channels);
  if (samples != nullptr) *image = Image(image->width, image->height);
  return samples;
}

std::string DecodeStb(const std::string& path, const Bytes& bytes, Image* image) {
  const StbMemory memory;
  Image result;
  const stbi_uc* samples = LoadStb(bytes, 3, &result);
  if (samples == nullptr) return Broken(path);
  result.pixels.assign(samples, samples + result.pixels.size());
  *image = std::move(result);
  return "";
}

std::string DecodeIndices(const std::string& path, const PngHeader& header, Bytes* bytes,
                          Image* image) {
  const StbMemory memory;
  const Bytes palette = TakePalette(bytes);
  const int colours = static_cast<int>(palette.size() / 3), step = GreyStep(header);
  Image result;
  const stbi_uc* levels = LoadStb(*bytes, 1, &result);
  if (levels == nullptr) return Broken(path);
  for (size_t i = 0; i < result.pixels.size() / 3; ++i) {
    const int index = levels[i] / step;
    if (index >= colours) {
      return Expected(path, "indices below the palette's " + std::to_string(colours) + " colours",
                      std::to_string(index));
    }
    for (size_t c = 0; c < 3; ++c) result.pixels[3 * i + c] = palette[3 * size_t(index) + c];
  }
  *image = std::move(result);
  return "";
}

// Whether a PNG file may hold the pixels that its header tells of: deflate makes at most 1032 bytes
// of one. stb_image would make room for them first.
bool CanHold(const Bytes& png, const PngHeader& header) {
  constexpr uint64_t kMostExpansion = 1032, kSamples[] = {1, 1, 3, 1, 2, 1, 4, 1};
  const uint64_t bits = kSamples[header.colour & 7] * uint64_t(header.depth) * header.width;
  return bits * header.height / 8 <= kMostExpansion * png.size();
}

// The header of a PNG file whose pixels there is room for.
std::string CheckPngHeader(const std::string& path, const Bytes& png, PngHeader* header) {
  if (!ReadPngHeader(png, header)) {
    return Expected(path, "a PNG picture that begins with its header", "none there");
  }
  const std::string error = CheckSize(path, header->width, header->height);
  if (!error.empty()) return error;
  return CanHold(png, *header) ? "" : Truncated(path, "PNG");
}

std::string DecodePng(const std::string& path, Bytes* bytes, Image* image) {
  PngHeader header;
  const std::string error = CheckPngHeader(path, *bytes, &header);
  if (!error.empty()) return error;
  return HasPalette(header) ? DecodeIndices(path, header, bytes, image)
                            : DecodeStb(path, *bytes, image);
}

// Whether a JPEG file may hold a picture of this size: a block of coded data takes a bit at least,
// and where each component is subsampled another way there is one for every 8 by 32 pixels.
// stb_image would fill hundreds of megabytes for a file of a few bytes first.
bool CanHold(const Bytes& jpeg, int width, int height) {
  constexpr int64_t kMostPixelsPerByte = 8 * 8 * 32, kOneUnit = 32 * 32;
  return int64_t{width} * height <=
         kOneUnit + kMostPixelsPerByte * static_cast<int64_t>(jpeg.size());
}

std::string DecodeJpeg(const std::string& path, const Bytes& bytes, Image* image) {
  int width = 0, height = 0, channels = 0;
  {
    const StbMemory memory;
    if (!stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height,
                               &channels)) {
      return Broken(path);
    }
  }
  const std::string error = CheckSize(path, width, height);
  if (!error.empty()) return error;
  return CanHold(bytes, width, height) ? DecodeStb(path, bytes, image) : Truncated(path, "JPEG");
}

std::string CheckExtension(const std::string& path) {
  const std::string extension = FormatExtension(path);
  if (IsPictureExtension(extension)) return "";
  return Expected(path, std::string("a name ending in ") + kPictureExtensions,
                  extension.empty() ? "no extension" : extension);
}

}  // namespace

std::string DecodeImage(const std::string& where, Bytes* bytes, Image* image) {
  if (bytes->empty()) return Expected(where, "a PNG, PPM or JPEG picture", "an empty file");
  if (bytes->front() == 'P') return DecodePpm(where, *bytes, image);
  if (bytes->size() > INT_MAX) return Expected(where, "a file below 2 GiB", "a larger one");
  const std::string error = CheckWhole(where, *bytes);
  if (!error.empty()) return error;
  return IsPng(*bytes) ? DecodePng(where, bytes, image) : DecodeJpeg(where, *bytes, image);
}

std::string ReadImage(const std::string& path, Image* image) {
  try {
    Bytes bytes;
    const std::string error = ReadFile(path, &bytes);
    return error.empty() ? DecodeImage(path, &bytes, image) : error;
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "read it");
  }
}

std::string WriteImage(const std::string& path, const Image& image, const PictureOptions& options) {
  std::string error = CheckExtension(path);
  if (!error.empty()) return error;
  try {
    Bytes bytes;
    error = EncodePicture(path, image, options, &bytes);
    return error.empty() ? WriteFile(path, bytes) : error;
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "write it");
  }
}

std::string CheckImageOutput(const std::string& path) {
  std::string error = CheckExtension(path);
  if (error.empty()) error = CheckOutputPath(path);
  if (error.empty() && FormatExtension(path) == ".webp") error = WebpWriter::Check(path, 1, 1);
  if (error.empty() && IsStandardStream(path) && isatty(STDOUT_FILENO) == 1) {
    error = Expected(path, "a file or pipe for a picture", "a terminal");
  }
  return error;
}

}  // namespace starfocus
