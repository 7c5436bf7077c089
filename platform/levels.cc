// SPDX-License-Identifier: Apache-2.0
#include "platform/levels.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <limits>

#include "platform/container.h"
#include "platform/image_io.h"
#include "platform/png.h"
#include "platform/ppm.h"
#include "platform/stb_memory.h"

namespace starfocus {
namespace {

// A pixel counts as coloured if its channels differ by more than a tenth of white. JPEG compression
// changes the channels of grey pixels by less than a tenth of white. A picture counts as a colour
// picture if at least one pixel in a hundred is coloured.
constexpr int kColourPart = 10;
constexpr size_t kColouredPart = 100;

// Returns the error for a colour picture, whose grey levels have no meaning.
Error RejectColours(const std::string& where, Alpha alpha) {
  if (alpha == Alpha::kTaken) {
    return Expected(where, "a picture with transparent pixels or in grey levels",
                    "an opaque colour picture");
  }
  return Expected(where, "a depth picture in grey levels",
                  "a colour picture (colours do not define an order of depth)");
}

// Interleaved samples of 1 (grey) to 4 (RGB and alpha) channels.
template <class Sample>
struct Pixels {
  const Sample* first;
  int channels;
  size_t count;

  bool has_alpha() const { return channels % 2 == 0; }
  int AlphaAt(size_t k) const { return first[k * size_t(channels) + size_t(channels) - 1]; }
  bool IsOpaque(int largest) const {
    for (size_t k = 0; k < count && has_alpha(); ++k) {
      if (AlphaAt(k) < largest) return false;
    }
    return true;
  }
};

// Converts pixels to grey levels or alpha. The caller must have set the size of the map and the
// sample value of white in `result`.
template <class Sample>
Result<Samples> TakeLevels(const std::string& where, const Sample* first, int channels, Alpha alpha,
                           Samples result) {
  const size_t count = size_t(result.map.width) * size_t(result.map.height);
  const Pixels<Sample> pixels = {first, channels, count};
  std::vector<float>& values = result.map.values;
  values.reserve(count);
  if (alpha == Alpha::kTaken && !pixels.IsOpaque(result.largest)) {
    result.is_alpha = true;
    for (size_t k = 0; k < count; ++k) values.push_back(static_cast<float>(pixels.AlphaAt(k)));
    return result;
  }
  const bool marks = alpha == Alpha::kTransparent && pixels.has_alpha(), is_grey = channels < 3;
  size_t coloured = 0;
  for (size_t k = 0; k < count; ++k) {
    const Sample* pixel = first + k * size_t(channels);
    if (marks && 2 * pixels.AlphaAt(k) < result.largest) {
      values.push_back(std::numeric_limits<float>::quiet_NaN());
    } else if (is_grey) {
      values.push_back(static_cast<float>(pixel[0]));
    } else {
      const auto [low, high] = std::minmax({int{pixel[0]}, int{pixel[1]}, int{pixel[2]}});
      if ((high - low) * kColourPart > result.largest) ++coloured;
      values.push_back(static_cast<float>(pixel[0] + pixel[1] + pixel[2]) / 3);
    }
  }
  if (coloured * kColouredPart < count) return result;
  return RejectColours(where, alpha);
}

// Decodes a PNG file that DecodeImage has read without an error.
Result<Samples> DecodePngSamples(const std::string& where, const Bytes& bytes, Alpha alpha) {
  const PngHeader header = *ReadPngHeader(bytes);
  constexpr int kColour = 2;  // Bit of the PNG colour type: RGB or a palette of RGB.
  const int channels = (header.colour & kColour) != 0 ? 4 : 2;
  const auto size = static_cast<int>(bytes.size());
  const StbMemory memory;
  int width = 0, height = 0, own = 0;
  if (header.depth == 16) {
    const stbi_us* pixels =
        stbi_load_16_from_memory(bytes.data(), size, &width, &height, &own, channels);
    if (pixels != nullptr) {
      return TakeLevels(where, pixels, channels, alpha, {{width, height, {}}, 65535});
    }
  } else {
    const stbi_uc* pixels =
        stbi_load_from_memory(bytes.data(), size, &width, &height, &own, channels);
    if (pixels != nullptr) {
      return TakeLevels(where, pixels, channels, alpha, {{width, height, {}}, 255});
    }
  }
  return Expected(where, "an undamaged picture",
                  "a damaged one (" + std::string(stbi_failure_reason()) + ")");
}

}  // namespace

Result<Samples> DecodeSamples(const std::string& where, Alpha alpha, const Bytes& bytes) {
  if (!bytes.empty() && bytes.front() == 'P') {
    const Result<PnmSamples> pnm = DecodePnmSamples(where, bytes);
    if (!pnm) return pnm.error();
    return TakeLevels(where, pnm->samples.data(), pnm->channels, alpha,
                      {{pnm->width, pnm->height, {}}, pnm->largest});
  }
  Result<DecodedPicture> picture = DecodeImage(where, bytes);
  if (!picture) return picture.error();
  Image& image = picture->image;
  if (IsPng(bytes)) {
    image = {};  // Frees memory.
    return DecodePngSamples(where, bytes, alpha);
  }
  if (alpha == Alpha::kTaken && picture->is_transparent) {
    return Expected(where, "an alpha channel in a PNG file", "one in another format");
  }
  return TakeLevels(where, image.pixels.data(), 3, alpha, {{image.width, image.height, {}}, 255});
}

Result<FloatMap> DecodeLevels(const std::string& where, const Bytes& bytes) {
  Result<Samples> samples = DecodeSamples(where, Alpha::kTransparent, bytes);
  if (!samples) return samples.error();
  for (float& value : samples->map.values) value /= static_cast<float>(samples->largest);
  return std::move(samples->map);
}

}  // namespace starfocus
