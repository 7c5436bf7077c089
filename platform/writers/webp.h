// SPDX-License-Identifier: Apache-2.0
// WebP files: a picture, or several one after the other.
#ifndef STARFOCUS_PLATFORM_WRITERS_WEBP_H_
#define STARFOCUS_PLATFORM_WRITERS_WEBP_H_

#include <memory>
#include <string>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Encodes pictures of one size as they come; more than one are shown for a tenth of a second each,
// for ever again. Nothing but the coded pictures is kept.
class WebpWriter {
 public:
  // `path` only names the file in errors; quality is 1 to 100.
  WebpWriter(std::string path, int quality);
  ~WebpWriter();
  WebpWriter(const WebpWriter&) = delete;
  WebpWriter& operator=(const WebpWriter&) = delete;

  // Whether pictures of this size can be written: the format has 16383 pixels a side, and
  // a program built without libwebp writes none.
  static Error Check(const std::string& path, int width, int height);

  Error Add(const Image& picture);

  // The whole file, with metadata changed to what is true of the pictures (exif.h).
  Result<Bytes> Finish(const Metadata& metadata);

 private:
  struct State;
  const std::unique_ptr<State> state_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_WEBP_H_
