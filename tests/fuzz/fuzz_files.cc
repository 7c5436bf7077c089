// SPDX-License-Identifier: Apache-2.0
// The readers of single files: PFM maps, PNG, PPM and JPEG pictures, and small texts.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "platform/container.h"
#include "platform/image_io.h"
#include "platform/levels.h"
#include "platform/pfm.h"
#include "tests/fuzz/input.h"

namespace {

// A file in memory, and the path that opens it.
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
  starfocus::FloatMap map;
  if (!starfocus::ReadPfm(file.path(), &map)) {
    if (map.values.size() != size_t(map.width) * size_t(map.height)) std::abort();
  }
  starfocus::Bytes bytes;
  const bool small = !starfocus::ReadSmallFile(file.path(), &bytes);
  if (small != (size <= starfocus::kMostSmallBytes) || (small && bytes.size() != size))
    std::abort();
  if (starfocus::DescribeFile(bytes).empty()) std::abort();
  starfocus::Image image;
  if (!starfocus::ReadImage(file.path(), &image)) {
    if (image.pixels.size() != image.stride() * size_t(image.height)) std::abort();
  }
  starfocus::Bytes copy(data, data + size);
  starfocus::FloatMap levels;
  if (!starfocus::DecodeLevels("levels", &copy, &levels)) {
    if (levels.values.size() != size_t(levels.width) * size_t(levels.height)) std::abort();
    for (const float level : levels.values) {
      if (level < 0 || level > 1) std::abort();
    }
  }
  copy.assign(data, data + size);
  starfocus::Samples samples;
  if (!starfocus::DecodeCoverage("coverage", &copy, &samples)) {
    for (const float sample : samples.map.values) {
      if (!(sample >= 0 && sample <= static_cast<float>(samples.largest))) std::abort();
    }
  }
  return 0;
}
