// SPDX-License-Identifier: Apache-2.0
// Reports that WebP is not supported in builds without libwebp.
#include "platform/writers/webp.h"

namespace starfocus {

struct WebpWriter::State {
  std::string path;
};

WebpWriter::WebpWriter(std::string path, int, double) : state_(new State) { state_->path = path; }

WebpWriter::~WebpWriter() = default;

Error WebpWriter::Check(const std::string& path, int, int) {
  return Unsupported(path, "WebP", "libwebp (Debian: libwebp-dev)");
}

Error WebpWriter::Add(const Image& picture, const Bytes&) {
  return Check(state_->path, picture.width, picture.height);
}

Result<Bytes> WebpWriter::Finish(const Metadata&) { return Check(state_->path, 0, 0); }

}  // namespace starfocus
