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

// Treatment of the alpha channel of a depth picture.
enum class Alpha {
  kIgnored,
  kTransparent,  // Pixels that are less than half opaque become NaN.
  kTaken         // The alpha channel replaces the grey levels.
};

// Converts interleaved samples of 1 (grey) to 4 (RGB and alpha) channels to grey levels. The caller
// must have set the size of the map and the sample value of white in `result`.
template <class Sample>
Result<Samples> TakeGrey(const std::string& where, const Sample* pixel, int channels, Alpha alpha,
                         Samples result) {
  const bool has_alpha = channels % 2 == 0, is_grey = channels < 3;
  const size_t count = size_t(result.map.width) * size_t(result.map.height);
  size_t coloured = 0;
  result.map.values.reserve(count);
  for (size_t k = 0; k < count; ++k, pixel += channels) {
    if (has_alpha && alpha == Alpha::kTaken) {
      result.map.values.push_back(static_cast<float>(pixel[channels - 1]));
    } else if (has_alpha && alpha == Alpha::kTransparent &&
               2 * pixel[channels - 1] < result.largest) {
      result.map.values.push_back(std::numeric_limits<float>::quiet_NaN());
    } else if (is_grey) {
      result.map.values.push_back(static_cast<float>(pixel[0]));
    } else {
      const auto [low, high] = std::minmax({int{pixel[0]}, int{pixel[1]}, int{pixel[2]}});
      if ((high - low) * kColourPart > result.largest) ++coloured;
      result.map.values.push_back(static_cast<float>(pixel[0] + pixel[1] + pixel[2]) / 3);
    }
  }
  if (coloured * kColouredPart < count) return result;
  return Expected(where, "a depth picture in grey levels",
                  "a colour picture (colours do not define an order of depth)");
}

// Decodes a PNG file that DecodeImage has read without an error.
Result<Samples> DecodePngSamples(const std::string& where, const Bytes& bytes, Alpha alpha) {
  const PngHeader header = *ReadPngHeader(bytes);
  constexpr int kHasAlpha = 4;  // Bit of the PNG colour type: alpha channel.
  if (alpha == Alpha::kTaken && (header.colour & kHasAlpha) == 0) alpha = Alpha::kIgnored;
  constexpr int kColour = 2;  // Bit of the PNG colour type: RGB or a palette of RGB.
  const int channels = (header.colour & kColour) != 0 ? 4 : 2;
  const auto size = static_cast<int>(bytes.size());
  const StbMemory memory;
  int width = 0, height = 0, own = 0;
  if (header.depth == 16) {
    const stbi_us* pixels =
        stbi_load_16_from_memory(bytes.data(), size, &width, &height, &own, channels);
    if (pixels != nullptr) {
      return TakeGrey(where, pixels, channels, alpha, {{width, height, {}}, 65535});
    }
  } else {
    const stbi_uc* pixels =
        stbi_load_from_memory(bytes.data(), size, &width, &height, &own, channels);
    if (pixels != nullptr) {
      return TakeGrey(where, pixels, channels, alpha, {{width, height, {}}, 255});
    }
  }
  return Expected(where, "an undamaged picture",
                  "a damaged one (" + std::string(stbi_failure_reason()) + ")");
}

Result<Samples> Decode(const std::string& where, Alpha alpha, const Bytes& bytes) {
  if (!bytes.empty() && bytes.front() == 'P') {
    const Result<PnmSamples> pnm = DecodePnmSamples(where, bytes);
    if (!pnm) return pnm.error();
    return TakeGrey(where, pnm->samples.data(), pnm->channels, alpha,
                    {{pnm->width, pnm->height, {}}, pnm->largest});
  }
  Result<DecodedPicture> picture = DecodeImage(where, bytes);
  if (!picture) return picture.error();
  Image& image = picture->image;
  if (!IsPng(bytes)) {
    return TakeGrey(where, image.pixels.data(), 3, alpha, {{image.width, image.height, {}}, 255});
  }
  image = {};  // Frees memory.
  return DecodePngSamples(where, bytes, alpha);
}

}  // namespace

Result<Samples> DecodeSamples(const std::string& where, bool use_alpha, const Bytes& bytes) {
  return Decode(where, use_alpha ? Alpha::kTransparent : Alpha::kIgnored, bytes);
}

Result<Samples> DecodeCoverage(const std::string& where, const Bytes& bytes) {
  return Decode(where, Alpha::kTaken, bytes);
}

Result<FloatMap> DecodeLevels(const std::string& where, const Bytes& bytes) {
  Result<Samples> samples = DecodeSamples(where, true, bytes);
  if (!samples) return samples.error();
  for (float& value : samples->map.values) value /= static_cast<float>(samples->largest);
  return std::move(samples->map);
}

}  // namespace starfocus
