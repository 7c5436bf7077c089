// SPDX-License-Identifier: Apache-2.0
// Fuzz target: the XMP of a photo. The input is the XMP packet. The pictures of the photo are
// valid, so that nearly all inputs reach the reader of depth maps.
#include <cstdlib>
#include <string>

#include "platform/readers/depth_photo_file.h"
#include "tests/fuzz/check_photo.h"
#include "tests/fuzz/input.h"
#include "tests/support/photo_files.h"

namespace {

using namespace starfocus::photos;

struct Pictures {
  std::string jpeg = Encode(Ramp(8, 8), ".jpg"), png = Encode(Ramp(4, 4), ".png");
};

void Decode(const std::string& file) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(file.data());
  const auto photo =
      starfocus::DecodeDepthPhoto("photo", {bytes, file.size()}, true, starfocus::Near::kUnknown);
  if (photo && photo->picture.pixels.empty()) std::abort();
  starfocus::fuzz::CheckCaptions(photo->metadata);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const Pictures pictures;
  if (size < 1 || size > 60000) return 0;
  const std::string packet(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 4 == 0) {  // Apple's packet is in the second picture
    Decode(MultiPicture(pictures.jpeg, Insert(pictures.jpeg, XmpSegment(packet))));
  } else if (data[0] % 4 == 1) {  // extended XMP: the main packet has everything except the map
    Decode(Gdepth(pictures.jpeg,
                  "GDepth:Format=\"RangeInverse\" GDepth:Near=\"1\" GDepth:Far=\"2\"",
                  "/>" + packet, 1 + size / 3));
  } else if (data[0] % 4 == 2) {
    Decode(Insert(pictures.jpeg, XmpSegment(packet)) + pictures.png);
  } else {  // a second packet
    Decode(Insert(pictures.jpeg,
                  XmpSegment(Packet(kGoogle, "GDepth:Near=\"1\"")) + XmpSegment(packet)) +
           pictures.png);
  }
  return 0;
}
