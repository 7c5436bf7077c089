// SPDX-License-Identifier: Apache-2.0
// Fuzz target: readers of single files. The files are maps in PFM, NPY, NPZ and TIFF, pictures in
// PNG, PPM and JPEG, and small texts.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "platform/container.h"
#include "platform/depth_file.h"
#include "platform/image_io.h"
#include "platform/levels.h"
#include "platform/pfm.h"
#include "tests/fuzz/input.h"

namespace {

// A file in memory, and a path that opens this file.
class MemoryFile {
 public:
  MemoryFile(const uint8_t* data, size_t size) : handle_(memfd_create("fuzz", 0)) {
    if (handle_ < 0 || write(handle_, data, size) != static_cast<ssize_t>(size)) std::abort();
  }
  ~MemoryFile() { close(handle_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(handle_); }

 private:
  int handle_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const MemoryFile file(data, size);
  if (const auto map = starfocus::ReadPfm(file.path())) {
    if (map->values.size() != size_t(map->width) * size_t(map->height)) std::abort();
  }
  const auto small = starfocus::ReadSmallFile(file.path());
  if (bool(small) != (size <= starfocus::kMostSmallBytes) || (small && small->size() != size))
    std::abort();
  if (starfocus::DescribeFile(*small).empty()) std::abort();
  if (const auto image = starfocus::ReadImage(file.path())) {
    if (image->pixels.size() != image->stride() * size_t(image->height)) std::abort();
  }
  const starfocus::Bytes bytes(data, data + size);
  if (const auto levels = starfocus::DecodeLevels("levels", bytes)) {
    if (levels->values.size() != size_t(levels->width) * size_t(levels->height)) std::abort();
    for (const float level : levels->values) {
      if (level < 0 || level > 1) std::abort();
    }
  }
  if (const auto samples =
          starfocus::DecodeDepthFile("depth", starfocus::Alpha::kTransparent, bytes)) {
    const starfocus::FloatMap& map = samples->map;
    if (map.values.size() != size_t(map.width) * size_t(map.height)) std::abort();
  }
  if (const auto samples = starfocus::DecodeSamples("coverage", starfocus::Alpha::kTaken, bytes)) {
    for (const float sample : samples->map.values) {
      if (!(sample >= 0 && sample <= static_cast<float>(samples->largest))) std::abort();
    }
  }
  return 0;
}
