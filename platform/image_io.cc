#include "platform/image_io.h"

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <climits>
#include <memory>

#include "platform/ppm.h"

namespace starfocus {
namespace {

constexpr int kJpegQuality = 95;

bool IsJpeg(const Bytes& bytes) {
  return bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

// stb_image fills the missing part of a truncated JPEG with grey. This finds the end-of-image
// marker behind the first scan; earlier ones may belong to a thumbnail.
bool JpegHasEnd(const Bytes& bytes) {
  size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == 0xff) {
    const bool scan = bytes[at + 1] == 0xda;
    at += 2 + size_t(bytes[at + 2]) * 256 + bytes[at + 3];
    if (scan) break;
  }
  for (; at + 2 <= bytes.size(); ++at) {
    if (bytes[at] == 0xff && bytes[at + 1] == 0xd9) return true;
  }
  return false;
}

bool IsPng(const Bytes& bytes) {
  return bytes.size() >= 8 && bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N';
}

// stb_image allocates what a chunk says it holds before it looks for it. This walks the chunks to
// the last one.
bool PngHasEnd(const Bytes& bytes) {
  for (size_t at = 8; at + 12 <= bytes.size();) {
    const uint8_t* chunk = &bytes[at];
    const size_t length =
        size_t(chunk[0]) << 24 | size_t(chunk[1]) << 16 | size_t(chunk[2]) << 8 | size_t(chunk[3]);
    if (length > bytes.size() - at - 12) return false;
    if (std::equal(chunk + 4, chunk + 8, "IEND")) return true;
    at += 12 + length;
  }
  return false;
}

std::string DecodeStb(const std::string& path, const Bytes& bytes, Image* image) {
  int width = 0, height = 0, channels = 0;
  if (bytes.size() > INT_MAX) return Expected(path, "a file below 2 GiB", "a larger one");
  const int size = static_cast<int>(bytes.size());
  if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels)) {
    return Expected(path, "a PNG, PPM or JPEG picture", "something else");
  }
  if (width < 1 || height < 1 || width > kMaxPictureSize || height > kMaxPictureSize) {
    return Expected(path, "width and height from 1 to 65535",
                    std::to_string(width) + "x" + std::to_string(height));
  }
  if (IsPng(bytes) && !PngHasEnd(bytes)) {
    return Expected(path, "an undamaged picture", "a truncated one");
  }
  std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 3), stbi_image_free);
  if (!pixels) {
    return Expected(path, "an undamaged picture",
                    "a broken one (" + std::string(stbi_failure_reason()) + ")");
  }
  if (IsJpeg(bytes) && !JpegHasEnd(bytes)) {
    return Expected(path, "an undamaged picture", "a truncated one");
  }
  *image = Image(width, height);
  image->pixels.assign(pixels.get(), pixels.get() + image->pixels.size());
  return "";
}

void Append(void* context, void* data, int size) {
  const uint8_t* first = static_cast<const uint8_t*>(data);
  Bytes* bytes = static_cast<Bytes*>(context);
  bytes->insert(bytes->end(), first, first + size);
}

bool IsKnownExtension(const std::string& extension) {
  return extension == ".png" || extension == ".ppm" || extension == ".jpg" || extension == ".jpeg";
}

std::string CheckExtension(const std::string& path) {
  const std::string extension = LowerExtension(path);
  if (IsKnownExtension(extension)) return "";
  return Expected(path, "a name ending in .png, .ppm or .jpg",
                  extension.empty() ? "no extension" : extension);
}

}  // namespace

std::string ReadImage(const std::string& path, Image* image) {
  Bytes bytes;
  const std::string error = ReadFile(path, &bytes);
  if (!error.empty()) return error;
  if (bytes.empty()) return Expected(path, "a PNG, PPM or JPEG picture", "an empty file");
  if (bytes[0] == 'P') return DecodePpm(path, bytes, image);
  return DecodeStb(path, bytes, image);
}

std::string WriteImage(const std::string& path, const Image& image) {
  const std::string error = CheckExtension(path);
  if (!error.empty()) return error;
  const std::string extension = LowerExtension(path);
  if (extension == ".ppm") return WriteFile(path, EncodePpm(image));
  Bytes bytes;
  const int stride = static_cast<int>(image.stride());
  const int ok = extension == ".png"
                     ? stbi_write_png_to_func(Append, &bytes, image.width, image.height, 3,
                                              image.pixels.data(), stride)
                     : stbi_write_jpg_to_func(Append, &bytes, image.width, image.height, 3,
                                              image.pixels.data(), kJpegQuality);
  if (!ok || bytes.empty()) {
    return Expected(path, "a picture that can be encoded", "an encoder failure");
  }
  return WriteFile(path, bytes);
}

std::string CheckImageOutput(const std::string& path) {
  const std::string error = CheckExtension(path);
  return error.empty() ? CheckOutputPath(path) : error;
}

}  // namespace starfocus
