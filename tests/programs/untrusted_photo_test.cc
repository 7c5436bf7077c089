// SPDX-License-Identifier: Apache-2.0
// Checks what an untrusted photo may do: the memory that decoding it takes is estimated before, and
// a helper process that a file has taken over can send only valid photos.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "platform/file.h"
#include "platform/helper/helper.h"
#include "platform/image_io.h"
#include "platform/readers/confined_photo.h"
#include "platform/readers/decoding_memory.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/text.h"
#include "tests/support/error_line.h"

namespace starfocus::untrusted_photo_test {
namespace {

namespace fs = std::filesystem;

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
  for (const std::string name : {"a.png", "a.jpg", "a.ppm", "a.webp"}) {
    CAPTURE(name);
    const Result<Bytes> bytes = EncodePicture(name, Image(37, 21), {});
    if (name == "a.webp" && !bytes) continue;  // a build without libwebp
    const uint64_t estimate = DecodingBytes({bytes->data(), bytes->size()});
    CHECK(estimate >= 37 * 21 * 16);
    CHECK(estimate <= 3 * 37 * 22 * 16);
  }
  for (const std::string text : {"", "II*", "\xff\xd8\xff", "RIFF    WEBP", "\x89PNG\r\n"}) {
    const Bytes bytes(text.begin(), text.end());
    CHECK(DecodingBytes({bytes.data(), bytes.size()}) == UINT64_MAX);
  }
}

TEST_CASE("confined_photo: texts arrive without control characters, and paths do not arrive") {
  ConfineDecoders();
  if (!DecodersAreConfined()) return;
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  const std::string evil = "a\x1b]0;owned\a\n\r\xc2\x9b" + all;
  DepthPhoto sent;
  sent.format = sent.map_problem = sent.depth_path = evil;
  sent.facts = {{evil, evil}};
  sent.notes = {evil, std::string(100000, 'x')};
  const Result<DepthPhoto> photo =
      Confined<DepthPhoto>("photo.jpg", [&] { return Result<DepthPhoto>(sent); });
  REQUIRE(photo);
  for (const std::string& text : {photo->format, photo->map_problem, photo->facts[0].first,
                                  photo->facts[0].second, photo->notes[0]}) {
    CHECK(text == Printable(evil));
    CHECK(text != evil);
  }
  CHECK(photo->notes[1].size() == 65536);
  CHECK(photo->depth_path.empty());
}

TEST_CASE("confined_photo: numbers of a photo that no decoder can find are rejected") {
  ConfineDecoders();
  if (!DecodersAreConfined()) return;
  using Field = double DepthPhoto::*;
  for (const Field field : {&DepthPhoto::focus_x, &DepthPhoto::focus_y, &DepthPhoto::subject_x,
                            &DepthPhoto::subject_y, &DepthPhoto::focal_35mm}) {
    for (const double value : {-1.0, 1e308, double{NAN}, double{INFINITY}, -1e-300}) {
      DepthPhoto photo;
      photo.*field = value;
      CHECK(Confined<DepthPhoto>("p", [&] { return Result<DepthPhoto>(photo); }).error() != "");
    }
  }
}

}  // namespace
}  // namespace starfocus::untrusted_photo_test
