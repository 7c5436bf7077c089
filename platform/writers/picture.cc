// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/picture.h"

#include "platform/ppm.h"
#include "platform/standard_stream.h"
#include "platform/text.h"
#include "platform/writers/jpeg.h"
#include "platform/writers/png.h"
#include "platform/writers/webp.h"

namespace starfocus {
namespace {

// Largest number of pixels that encoders support, because encoders count bytes in an int.
constexpr int64_t kMostPixels = int64_t{1} << 28;

Error CheckSize(const std::string& path, const Image& image) {
  const int64_t width = image.width, height = image.height;
  const std::string size = SizeText(width, height);
  if (width < 1 || height < 1 || width > kMaxPictureSize || height > kMaxPictureSize) {
    return Expected(path, "width and height from 1 to 65535", size);
  }
  if (width * height <= kMostPixels) return {};
  return Expected(path, "a PNG, JPEG or WebP picture of at most 2^28 pixels", size);
}

Result<Bytes> EncodeWebp(const std::string& path, const Image& image,
                         const PictureOptions& options) {
  WebpWriter writer(path, options.quality);
  if (Error error = writer.Add(image, options.alphas)) return error;
  return writer.Finish(options.metadata);
}

}  // namespace

bool IsPictureExtension(const std::string& extension) {
  return extension == ".png" || extension == ".ppm" || extension == ".jpg" ||
         extension == ".jpeg" || extension == ".webp";
}

Result<Bytes> EncodePicture(const std::string& path, const Image& image,
                            const PictureOptions& options, RowGate* rows) {
  const std::string extension = FormatExtension(path);
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  if (rows != nullptr && !jpeg) rows->WaitFor(image.height - 1);
  if (extension == ".ppm") return EncodePpm(image);
  if (Error error = CheckSize(path, image)) return error;
  if (extension == ".png") {
    return EncodePng(path, image, options.metadata, options.png_size);
  }
  if (extension == ".webp") return EncodeWebp(path, image, options);
  return EncodeJpeg(path, image, options.quality, options.metadata, {}, rows);
}

}  // namespace starfocus
