// SPDX-License-Identifier: Apache-2.0
// Encodes WebP with libwebp and its animation encoder.
#include "platform/writers/webp.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "platform/text.h"
#include "platform/writers/exif.h"
#include "platform/writers/jpeg_segments.h"

namespace starfocus {
namespace {

Error Failed(const std::string& path, const std::string& reason) {
  return Expected(path, "pictures that libwebp can write", reason);
}

// Owns memory that libwebp allocates.
struct Data {
  WebPData data;
  Data() { WebPDataInit(&data); }
  ~Data() { WebPDataClear(&data); }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
};

bool Import(const Image& picture, const Bytes& alphas, WebPPicture* frame) {
  const uint8_t* rgb = picture.pixels.data();
  if (alphas.empty()) return WebPPictureImportRGB(frame, rgb, static_cast<int>(picture.stride()));
  Bytes rgba(4 * alphas.size());
  for (size_t k = 0; k < alphas.size(); ++k) {
    std::copy_n(rgb + 3 * k, 3, &rgba[4 * k]);
    rgba[4 * k + 3] = alphas[k];
  }
  return WebPPictureImportRGBA(frame, rgba.data(), 4 * picture.width);
}

bool SetChunk(WebPMux* mux, const char* name, const Bytes& bytes) {
  if (bytes.empty()) return true;
  const WebPData chunk = {bytes.data(), bytes.size()};
  return WebPMuxSetChunk(mux, name, &chunk, 1) == WEBP_MUX_OK;
}

}  // namespace

struct WebpWriter::State {
  std::string path;
  int quality = 0, pictures = 0, width = 0, height = 0;
  double milliseconds = 0;
  WebPAnimEncoder* encoder = nullptr;

  // Returns the time of the next picture in milliseconds.
  int Time() const { return static_cast<int>(std::lround(milliseconds * pictures)); }

  Error Begin(int first_width, int first_height) {
    if (Error error = Check(path, first_width, first_height)) return error;
    width = first_width;
    height = first_height;
    WebPAnimEncoderOptions options;
    WebPAnimEncoderOptionsInit(&options);
    encoder = WebPAnimEncoderNew(width, height, &options);
    return encoder != nullptr ? Error() : OutOfMemory(path, "write it");
  }
};

WebpWriter::WebpWriter(std::string path, int quality, double milliseconds) : state_(new State) {
  state_->path = std::move(path);
  state_->quality = quality;
  state_->milliseconds = milliseconds;
}

WebpWriter::~WebpWriter() { WebPAnimEncoderDelete(state_->encoder); }

Error WebpWriter::Check(const std::string& path, int width, int height) {
  if (width <= WEBP_MAX_DIMENSION && height <= WEBP_MAX_DIMENSION) return {};
  return Expected(path, "width and height up to 16383 for WebP", SizeText(width, height));
}

Error WebpWriter::Add(const Image& picture, const Bytes& alphas) {
  State& state = *state_;
  if (state.encoder == nullptr) {
    if (Error error = state.Begin(picture.width, picture.height)) return error;
  }
  WebPConfig config;
  WebPPicture frame;
  if (!WebPConfigPreset(&config, WEBP_PRESET_PHOTO, static_cast<float>(state.quality)) ||
      !WebPPictureInit(&frame)) {
    return Failed(state.path, "another version of the library");
  }
  frame.width = picture.width;
  frame.height = picture.height;
  frame.use_argb = 1;
  const bool added = Import(picture, alphas, &frame) &&
                     WebPAnimEncoderAdd(state.encoder, &frame, state.Time(), &config);
  const WebPEncodingError code = frame.error_code;
  WebPPictureFree(&frame);
  if (added) {
    ++state.pictures;
    return {};
  }
  return code == VP8_ENC_ERROR_OUT_OF_MEMORY
             ? OutOfMemory(state.path, "write it")
             : Failed(state.path, WebPAnimEncoderGetError(state.encoder));
}

Result<Bytes> WebpWriter::Finish(const Metadata& metadata) {
  State& state = *state_;
  Data coded, whole;
  if (!WebPAnimEncoderAdd(state.encoder, nullptr, state.Time(), nullptr) ||
      !WebPAnimEncoderAssemble(state.encoder, &coded.data)) {
    return Failed(state.path, WebPAnimEncoderGetError(state.encoder));
  }
  const Bytes exif = EditedExif(metadata.exif, state.width, state.height);
  const std::string packet = XmpPacket(metadata.xmp);
  WebPMux* mux = WebPMuxCreate(&coded.data, 0);
  const bool made = mux != nullptr && SetChunk(mux, "ICCP", metadata.icc) &&
                    SetChunk(mux, "EXIF", exif) &&
                    SetChunk(mux, "XMP ", {packet.begin(), packet.end()}) &&
                    WebPMuxAssemble(mux, &whole.data) == WEBP_MUX_OK;
  WebPMuxDelete(mux);
  if (!made) return OutOfMemory(state.path, "write it");
  return Bytes(whole.data.bytes, whole.data.bytes + whole.data.size);
}

}  // namespace starfocus
