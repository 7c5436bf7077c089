#include "platform/image_io.h"

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <climits>
#include <memory>

#include "platform/container.h"
#include "platform/ppm.h"

namespace starfocus {
namespace {

constexpr int kJpegQuality = 95;

std::string DecodeStb(const std::string& path, const Bytes& bytes, Image* image) {
  int width = 0, height = 0, channels = 0;
  if (bytes.size() > INT_MAX) return Expected(path, "a file below 2 GiB", "a larger one");
  const Container container = CheckContainer(bytes);
  if (container == Container::kTruncated) {
    return Expected(path, "an undamaged picture", "a truncated one");
  }
  if (container == Container::kBroken) {
    return Expected(path, "an undamaged picture", "a broken one (checksum or code table)");
  }
  const int size = static_cast<int>(bytes.size());
  if (container == Container::kUnknown ||
      !stbi_info_from_memory(bytes.data(), size, &width, &height, &channels)) {
    return Expected(path, "a PNG, PPM or JPEG picture", "something else");
  }
  if (width < 1 || height < 1 || width > kMaxPictureSize || height > kMaxPictureSize) {
    return Expected(path, "width and height from 1 to 65535",
                    std::to_string(width) + "x" + std::to_string(height));
  }
  std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 3), stbi_image_free);
  if (!pixels) {
    return Expected(path, "an undamaged picture",
                    "a broken one (" + std::string(stbi_failure_reason()) + ")");
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
