// SPDX-License-Identifier: Apache-2.0
// Decodes WebP with libwebp.
#include "platform/decoders/webp.h"

#include <webp/decode.h>
#include <webp/mux.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "platform/container.h"
#include "platform/decoders/deep.h"
#include "platform/decoders/exif_bytes.h"
#include "platform/decoders/limits.h"
#include "platform/text.h"

namespace starfocus {
namespace {

// Limits of the number of pixels: per byte of the file, and for any file. The WebP format does not
// limit the pixels per byte: 38 bytes can encode 8000x8000 pixels of one colour. The decoder
// requires 7 bytes of memory per pixel, and 16 with alpha. Files of photographs have a few pixels
// per byte.
constexpr int64_t kMostPixelsPerByte = 65536, kAnyFilesPixels = int64_t{1} << 24;

Error Failed(const std::string& where, VP8StatusCode status) {
  if (status == VP8_STATUS_OUT_OF_MEMORY) return OutOfMemory(where, "read it");
  if (status == VP8_STATUS_NOT_ENOUGH_DATA) return Truncated(where, "WebP");
  return Expected(where, "an undamaged picture", "a damaged one (libwebp)");
}

// Returns the size of the file according to the header. The size field of the header does not
// include the first eight bytes of the file.
uint64_t SizeOf(const Bytes& webp) {
  return 8 + (uint64_t(webp[4]) | uint64_t(webp[5]) << 8 | uint64_t(webp[6]) << 16 |
              uint64_t(webp[7]) << 24);
}

struct FreeMux {
  void operator()(WebPMux* mux) const { WebPMuxDelete(mux); }
};

Bytes ChunkOf(const WebPMux* mux, const char* name) {
  WebPData data = {};
  if (WebPMuxGetChunk(mux, name, &data) != WEBP_MUX_OK) return {};
  return Bytes(data.bytes, data.bytes + data.size);
}

Metadata ReadMetadata(const Bytes& webp) {
  Metadata metadata;
  const WebPData file = {webp.data(), webp.size()};
  const std::unique_ptr<WebPMux, FreeMux> mux(WebPMuxCreate(&file, 0));
  if (mux == nullptr) return metadata;  // libwebp cannot parse the file's chunks
  metadata.icc = ChunkOf(mux.get(), "ICCP");
  metadata.exif = ChunkOf(mux.get(), "EXIF");
  TrimExif(&metadata.exif);
  const Bytes xmp = ChunkOf(mux.get(), "XMP ");
  metadata.xmp.assign(xmp.begin(), xmp.end());
  return metadata;
}

}  // namespace

Result<DecodedPicture> DecodeWebp(const std::string& where, const Bytes& webp) {
  if (SizeOf(webp) > webp.size()) return Truncated(where, "WebP");
  WebPDecoderConfig config;
  if (!WebPInitDecoderConfig(&config)) {
    return Expected(where, "the libwebp that this program was built with", "another version");
  }
  VP8StatusCode status = WebPGetFeatures(webp.data(), webp.size(), &config.input);
  if (status != VP8_STATUS_OK) return Failed(where, status);
  if (config.input.has_animation) return Expected(where, "a still WebP picture", "an animation");
  const int width = config.input.width, height = config.input.height;
  if (Error error = CheckPictureSize(where, width, height)) return error;
  if (int64_t{width} * height >
      kAnyFilesPixels + kMostPixelsPerByte * static_cast<int64_t>(webp.size())) {
    return Expected(
        where, "a WebP picture of at most 2^24 pixels and 65536 pixels for each byte of its file",
        SizeText(width, height));
  }
  DecodedPicture picture;
  const bool has_alpha = config.input.has_alpha != 0;
  const size_t channels = has_alpha ? 4 : 3, pixels = size_t(width) * size_t(height);
  Bytes samples(channels * pixels);
  config.output.colorspace = has_alpha ? MODE_RGBA : MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA = {samples.data(), static_cast<int>(channels) * width, samples.size()};
  status = WebPDecode(webp.data(), webp.size(), &config);
  if (status != VP8_STATUS_OK) return Failed(where, status);
  picture.metadata = ReadMetadata(webp);
  picture.image.width = width;
  picture.image.height = height;
  if (!has_alpha) {
    picture.image.pixels = std::move(samples);
    return picture;
  }
  Bytes alphas(pixels);
  picture.image.pixels.resize(3 * pixels);
  for (size_t k = 0; k < pixels; ++k) {
    std::copy_n(&samples[4 * k], 3, &picture.image.pixels[3 * k]);
    alphas[k] = samples[4 * k + 3];
  }
  picture.deep = Widen(picture.image, alphas);
  CompleteDeep(8, &picture);
  return picture;
}

}  // namespace starfocus
