// SPDX-License-Identifier: Apache-2.0
// Writes WebP files: a picture, or an animation of several pictures.
#ifndef STARFOCUS_PLATFORM_WRITERS_WEBP_H_
#define STARFOCUS_PLATFORM_WRITERS_WEBP_H_

#include <memory>
#include <string>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Encodes a sequence of pictures of equal size. Several pictures form an endless animation. Only
// the encoded pictures are kept in memory.
class WebpWriter {
 public:
  // `path` appears only in error messages; `quality` is 1 to 100. In an animation, each picture
  // lasts `milliseconds`.
  WebpWriter(std::string path, int quality, double milliseconds = 100);
  ~WebpWriter();
  WebpWriter(const WebpWriter&) = delete;
  WebpWriter& operator=(const WebpWriter&) = delete;

  // Returns an error if pictures of `width` x `height` pixels cannot be written. The WebP format is
  // limited to 16383 pixels per side, and builds without libwebp cannot write WebP files.
  static Error Check(const std::string& path, int width, int height);

  // Adds a picture. `alphas` has the alpha of each pixel, or is empty.
  Error Add(const Image& picture, const Bytes& alphas = {});

  // Returns the complete WebP file with `metadata`, whose EXIF is edited to match the pictures
  // (exif.h).
  Result<Bytes> Finish(const Metadata& metadata);

 private:
  struct State;
  const std::unique_ptr<State> state_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_WEBP_H_
