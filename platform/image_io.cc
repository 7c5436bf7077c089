// SPDX-License-Identifier: Apache-2.0
#include "platform/image_io.h"

#include <unistd.h>

#include <climits>
#include <new>

#include "platform/container.h"
#include "platform/decoders/exr.h"
#include "platform/decoders/jpeg.h"
#include "platform/decoders/limits.h"
#include "platform/decoders/png.h"
#include "platform/decoders/tiff.h"
#include "platform/decoders/webp.h"
#include "platform/png.h"
#include "platform/ppm.h"
#include "platform/standard_stream.h"
#include "platform/writers/webp.h"

namespace starfocus {
namespace {

constexpr char kFormats[] = "a PNG, PPM, JPEG, WebP, TIFF or OpenEXR picture";

// Returns true if a PNG file can contain the pixels that its header declares. Deflate expands a
// byte to at most 1032 bytes. The check is required because stb_image would allocate memory for any
// declared size.
bool CanHold(const Bytes& png, const PngHeader& header) {
  constexpr uint64_t kMostExpansion = 1032, kSamples[] = {1, 1, 3, 1, 2, 1, 4, 1};
  const uint64_t bits = kSamples[header.colour & 7] * uint64_t(header.depth) * header.width;
  return bits * header.height / 8 <= kMostExpansion * png.size();
}

Result<DecodedPicture> DecodePng(const std::string& path, const Bytes& png) {
  if (IsTruncatedPng(png)) return Truncated(path, "PNG");
  const std::optional<PngHeader> header = ReadPngHeader(png);
  if (!header) return Expected(path, "a PNG picture that begins with a header", "no header");
  if (Error error = CheckPictureSize(path, header->width, header->height)) return error;
  if (!CanHold(png, *header)) return Truncated(path, "PNG");
  return DecodePngPixels(path, png);
}

bool IsJpegStart(const Bytes& bytes) {
  return bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

Error CheckExtension(const std::string& path) {
  const std::string extension = FormatExtension(path);
  if (IsPictureExtension(extension)) return {};
  return Expected(path, std::string("a name ending in ") + kPictureExtensions,
                  extension.empty() ? "no extension" : extension);
}

}  // namespace

Result<DecodedPicture> DecodeImage(const std::string& where, const Bytes& bytes) {
  if (bytes.empty()) return Expected(where, kFormats, "an empty file");
  if (bytes.front() == 'P') return DecodePpm(where, bytes);
  if (bytes.size() > INT_MAX) return Expected(where, "a file below 2 GiB", "a larger one");
  if (IsPng(bytes)) return DecodePng(where, bytes);
  if (IsWebp(bytes)) return DecodeWebp(where, bytes);
  if (IsJpegStart(bytes)) return WithoutMetadata(DecodeJpeg(where, bytes));
  if (IsTiff(bytes)) return DecodeTiffPicture(where, bytes);
  if (IsExr(bytes)) return DecodeExr(where, bytes);
  return Expected(
      where, kFormats,
      DescribeFile(bytes, " (convert it to PNG or JPEG, for example with ImageMagick)"));
}

Result<Image> ReadImage(const std::string& path) {
  Result<DecodedPicture> picture = ReadPicture(path);
  if (!picture) return picture.error();
  return std::move(picture->image);
}

Result<DecodedPicture> ReadPicture(const std::string& path) {
  try {
    const Result<Bytes> bytes = ReadFileIf(path, MayBePicture);
    if (!bytes) return bytes.error();
    return DecodeImage(path, *bytes);
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "read it");
  }
}

Error WriteImage(const std::string& path, const Image& image, const PictureOptions& options) {
  if (Error error = CheckExtension(path)) return error;
  try {
    return WriteFile(path, EncodePicture(path, image, options));
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "write it");
  }
}

Error CheckImageOutput(const std::string& path) {
  Error error = CheckExtension(path);
  if (!error) error = CheckOutputPath(path);
  if (!error && FormatExtension(path) == ".webp") error = WebpWriter::Check(path, 1, 1);
  if (!error && IsStandardStream(path) && isatty(STDOUT_FILENO) == 1) {
    error = Expected(path, "a file or pipe for a picture", "a terminal");
  }
  return error;
}

}  // namespace starfocus
