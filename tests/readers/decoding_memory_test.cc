// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/decoding_memory.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/readers/depth_photo_file.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus::decoding_memory_test {
namespace {

namespace fs = std::filesystem;

uint64_t EstimateOf(const std::string& path) {
  const Bytes bytes = ValueOf(ReadFile(path));
  return DecodingBytes({bytes.data(), bytes.size()});
}

TEST_CASE("decoding_memory: every photo takes at most the estimated memory, and not much less") {
  int photos = 0;
  for (const char* folder : {"photo", "heif"}) {
    for (const auto& entry :
         fs::directory_iterator(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/" + std::string(folder))) {
      const std::string path = entry.path().string();
      CAPTURE(path);
      const Bytes bytes = ValueOf(ReadFile(path));
      const Span file = {bytes.data(), bytes.size()};
      const Result<DepthPhoto> photo = DecodeDepthPhoto(path, file, true, Near::kWhite);
      if (!photo) continue;
      ++photos;
      const uint64_t held = photo->picture.pixels.size() + photo->right.pixels.size() +
                            photo->map.values.size() * sizeof(float);
      CHECK(DecodingBytes(file) >= 2 * held);
      // HEIF pictures are padded to blocks of 64 x 64 pixels.
      CHECK(DecodingBytes(file) <= 65536 + 64 * photo->picture.pixels.size());
    }
  }
  CHECK(photos >= 10);
}

TEST_CASE("decoding_memory: the size comes from the header in each format") {
  TempFolder folder;
  for (const std::string name : {"a.png", "a.jpg", "a.ppm", "a.webp"}) {
    CAPTURE(name);
    const Error error = WriteImage(folder.file(name), Image(37, 21));
    if (name == "a.webp" && error) continue;  // a build without libwebp
    REQUIRE(error == "");
    CHECK(EstimateOf(folder.file(name)) >= 37 * 21 * 16);
    CHECK(EstimateOf(folder.file(name)) <= 3 * 37 * 22 * 16);
  }
  for (const std::string text : {"", "II*", "\xff\xd8\xff", "RIFF    WEBP", "\x89PNG\r\n"}) {
    REQUIRE(WriteText(folder.file("b"), text) == "");
    CHECK(EstimateOf(folder.file("b")) == UINT64_MAX);
  }
}

}  // namespace
}  // namespace starfocus::decoding_memory_test
