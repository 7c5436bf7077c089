// SPDX-License-Identifier: Apache-2.0
// Three fuzz targets of depth photos: `heif` for HEIF files, which also tests the calls of libheif;
// `photo` for all other files, because HEIF is ten times as slow; and `xmp`, whose input is an XMP
// packet. The pictures around this packet are valid, so that nearly all inputs reach the reader of
// depth maps. Each target is built from this file with its name in STARFOCUS_FUZZ_TARGET.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "platform/gain_map.h"
#include "platform/icc_profile.h"
#include "platform/readers/decoding_memory.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heic.h"
#include "platform/readers/heif_boxes.h"
#include "platform/readers/photo_scale.h"
#include "platform/readers/sample_bits.h"
#include "platform/readers/stereo_pair.h"
#include "platform/readers/xmp.h"
#include "platform/writers/jpeg_segments.h"
#include "starfocus/starfocus.h"
#include "tests/fuzz/input.h"
#include "tests/support/photo_files.h"
#include "tests/support/sanitizers.h"

namespace starfocus::fuzz {
namespace {

// Largest number of pixels that a reader accepts. Larger numbers are reduced to this limit.
constexpr int64_t kMostPixels = int64_t{1} << 28;

int64_t PixelsOf(int64_t width, int64_t height) {
  return width > 0 && height > kMostPixels / width ? kMostPixels : width * height;
}

int64_t WholeAt(const uint8_t* data, int bytes) {
  int64_t value = 0;
  for (int k = 0; k < bytes; ++k) value = value << 8 | data[k];
  return value;
}

// Returns the sum of the pixels that all PNG headers and JPEG frames in the file declare. A photo
// may contain several pictures.
int64_t PixelsOfHeaders(const uint8_t* data, size_t size) {
  int64_t pixels = 0;
  for (size_t at = 0; at + 12 <= size; ++at) {
    const uint8_t* here = data + at;
    if (std::memcmp(here, "IHDR", 4) == 0)
      pixels += PixelsOf(WholeAt(here + 4, 4), WholeAt(here + 8, 4));
    if (here[0] == 0xff && here[1] >= 0xc0 && here[1] <= 0xcf && here[1] != 0xc4) {
      pixels += WholeAt(here + 5, 2) * WholeAt(here + 7, 2);
    }
  }
  return pixels;
}

// Returns the number of pixels that the file declares. The program estimates the memory of WebP,
// OpenEXR and TIFF files from the same headers.
int64_t DeclaredPixels(const uint8_t* data, size_t size) {
  for (const auto& [start, bytes_per_pixel] :
       {std::pair("RIFF", 16U), {"v/1\1", 32U}, {"II*", 32U}, {"MM", 32U}}) {
    if (size < 12 || std::memcmp(data, start, std::strlen(start)) != 0) continue;
    const uint64_t bytes = DecodingBytes({data, size});
    return bytes == UINT64_MAX ? 0 : static_cast<int64_t>(bytes / bytes_per_pixel);
  }
  const auto items = HeifBrands({data, size}).empty() ? std::nullopt : ReadHeifItems({data, size});
  if (items) {
    int64_t pixels = 0;
    for (const auto& [id, item] : *items) pixels += PixelsOf(item.width, item.height);
    return pixels;
  }
  return PixelsOfHeaders(data, size);
}

// Returns the number of KiB in the named line of /proc/self/status, or -1 if there is no such line.
int64_t StatusOf(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, name.size(), name) == 0) return std::atoll(line.c_str() + name.size());
  }
  return -1;
}

// Limits the memory that reading a picture takes to 64 MiB plus 20 bytes for each pixel that the
// file declares: 16 bits of RGB and alpha, twice while HEIF is decoded, and 3 bytes of the picture.
// Aborts if a reader exceeds the limit. Only Linux can measure the memory of each input; other
// systems check nothing.
class MemoryBudget {
 public:
  MemoryBudget(const uint8_t* data, size_t size) : pixels_(DeclaredPixels(data, size)) {
    std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak to the current memory use
    before_ = StatusOf("VmHWM:");
  }
  ~MemoryBudget() {
    const int64_t most = kShare * (64 * 1024 + 20 * pixels_ / 1024),
                  used = StatusOf("VmHWM:") - before_;
    if (before_ < 0 || used <= most) return;
    std::fprintf(stderr, "%lld KiB for %lld declared pixels, expected at most %lld\n",
                 static_cast<long long>(used), static_cast<long long>(pixels_),
                 static_cast<long long>(most));
    std::abort();
  }
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

 private:
  // AddressSanitizer keeps freed memory for a while.
  static constexpr int64_t kShare = test::kSanitized ? 4 : 1;

  const int64_t pixels_;
  int64_t before_ = 0;
};

// Checks that the XMP that a writer makes is well-formed. The written XMP may be nested deeper than
// the XMP that was read.
void CheckCaptions(const Metadata& metadata) {
  const std::string packet = XmpPacket(metadata.xmp);
  if (packet.empty() || !CanReadXmp()) return;
  const Result<XmpNode> root = ParseXmp("captions", packet.data(), packet.size());
  Must(!Contains(root, "well-formed"));
}

// Checks a gain map, and that the light of a small photo is finite and not negative.
void CheckGain(const DepthPhoto& photo) {
  const GainMap& map = photo.gain_map;
  Must(map.levels.size() == map.row_levels() * size_t(map.height));
  if (map.levels.empty()) return;
  Must(!CheckGainMap("gain map", map));
  if (photo.picture.pixels.size() > 1 << 16) return;
  const DeepImage light = ApplyGainMap(photo.picture, map);
  Must(light.samples.size() == photo.picture.pixels.size());
  for (const uint16_t half : light.samples) Must(half < 0x7c00);
}

void CheckPhoto(const uint8_t* data, size_t size) {
  std::optional<MemoryBudget> budget(std::in_place, data, size);
  const Near near = size % 2 == 0 ? Near::kUnknown : Near::kWhite;
  Result<DepthPhoto> decoded = DecodeDepthPhoto("photo", {data, size}, true, near);
  budget.reset();
  Must(StatedSamplesOf(Bytes(data, data + size)).bits >= 0);
  if (!decoded) return;
  DepthPhoto& photo = *decoded;
  Must(!photo.picture.pixels.empty());
  CheckCaptions(photo.metadata);
  CheckGain(photo);
  const Bytes& icc = photo.metadata.icc;
  Must(icc.empty() || IsRgbProfile(icc));
  Must(!DescriptionOf(icc) || !icc.empty());
  if (photo.map.values.empty() && photo.matte.values.empty()) {
    return Must(!ReadStereoPair("photo", {data, size}, &photo) ||
                photo.right.pixels.size() == photo.picture.pixels.size());
  }
  for (const FloatMap* map : {&photo.map, &photo.matte}) {
    Must(map->values.size() == size_t(map->width) * size_t(map->height));
  }
  // Only small photos are processed further, since the engine has its own fuzz target.
  if (photo.picture.pixels.size() > 1 << 20) return;
  Result<LightField> made = MakePhotoField("photo", &photo);
  if (!made) return;
  LightField& field = *made;
  FitMap(&field);
  const Image& view = field.views[0];
  Must(view.pixels.size() == view.stride() * size_t(view.height));
  Must(field.width() == view.width && field.height() == view.height);
  for (const float disparity : field.disparity.values) {
    Must(!(std::fabs(disparity) > float(STARFOCUS_MAX_DISPARITY)));
  }
}

using namespace photos;

struct Pictures {
  std::string jpeg = Encode(Ramp(8, 8), ".jpg"), png = Encode(Ramp(4, 4), ".png");
};

void CheckFile(const std::string& file) {
  CheckPhoto(reinterpret_cast<const uint8_t*>(file.data()), file.size());
}

void CheckPacket(const uint8_t* data, size_t size) {
  static const Pictures pictures;
  if (size < 1 || size > 60000) return;
  const std::string packet(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string range = "GDepth:Format=\"RangeInverse\" GDepth:Near=\"1\" GDepth:Far=\"2\"",
                    near = XmpSegment(Packet(kGoogle, "GDepth:Near=\"1\""));
  if (data[0] % 4 == 0) {  // Apple's packet is in the second picture
    CheckFile(MultiPicture(pictures.jpeg, Insert(pictures.jpeg, XmpSegment(packet))));
  } else if (data[0] % 4 == 1) {  // extended XMP: the main packet has everything except the map
    CheckFile(Gdepth(pictures.jpeg, range, "/>" + packet, 1 + size / 3));
  } else {  // the only packet, or a second one
    const std::string first = data[0] % 4 == 2 ? "" : near;
    CheckFile(Insert(pictures.jpeg, first + XmpSegment(packet)) + pictures.png);
  }
}

}  // namespace
}  // namespace starfocus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr std::string_view kTarget = STARFOCUS_FUZZ_TARGET;
  const bool is_heif = starfocus::IsHeif({data, size});
  if (kTarget == "xmp") starfocus::fuzz::CheckPacket(data, size);
  if (kTarget == (is_heif ? "heif" : "photo")) starfocus::fuzz::CheckPhoto(data, size);
  return 0;
}
