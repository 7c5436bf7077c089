// SPDX-License-Identifier: Apache-2.0
// Images and depth maps of every format in memory, light fields of them, and their conversions as
// defined in starfocus/image.h.
#ifndef STARFOCUS_TESTS_SUPPORT_IMAGES_H_
#define STARFOCUS_TESTS_SUPPORT_IMAGES_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/scenes.h"
#include "tests/support/test_scene.h"

namespace test {

// Format and memory layout of an image. `layout` applies to YUV_420_888 with chroma samples 2 bytes
// apart: 0 (U first), 1 (V first), or 2 (separate memory for U and V).
struct ImageKind {
  int format = STARFOCUS_FORMAT_RGB, matrix = 0, range = 0, pixel_stride = 0, padding = 0,
      layout = 0;

  bool IsYuv() const { return format >= STARFOCUS_FORMAT_NV12; }
  bool HasAlpha() const {
    return format == STARFOCUS_FORMAT_RGBX || format == STARFOCUS_FORMAT_BGRX;
  }
  int Step() const {
    if (pixel_stride != 0) return pixel_stride;
    if (!IsYuv()) return HasAlpha() ? 4 : 3;
    return format == STARFOCUS_FORMAT_NV12 || format == STARFOCUS_FORMAT_NV21 ? 2 : 1;
  }
};

inline ImageKind AnyKind(int format, Random* random) {
  ImageKind kind;
  kind.format = format;
  kind.matrix = random->Int(0, 1);
  kind.range = random->Int(0, 1);
  kind.padding = random->Int(0, 1) * random->Int(1, 19);
  kind.layout = random->Int(0, 2);
  if (format == STARFOCUS_FORMAT_YUV_420_888) kind.pixel_stride = random->Int(0, 2);
  if (!kind.IsYuv() && random->Int(0, 1) == 0) {
    kind.pixel_stride = random->Int(kind.HasAlpha() ? 4 : 3, 6);
  }
  return kind;
}

// An image in memory; the memory ends with the last byte of the image's last row. All bytes between
// pixels and rows are poisoned.
class ImageMemory {
 public:
  ImageMemory(int width, int height, const ImageKind& kind)
      : kind_(kind), width_(width), height_(height) {
    const int step = kind.Step(), columns = (width + 1) / 2;
    if (!kind.IsYuv()) {
      Take(0, height, (width - 1) * step + (kind.HasAlpha() ? 4 : 3));
      return;
    }
    Take(0, height, width);
    const bool pairs =
        step == 2 && (kind.format != STARFOCUS_FORMAT_YUV_420_888 || kind.layout < 2);
    if (pairs) {
      Take(1, (height + 1) / 2, 2 * columns);
    } else {
      for (int plane : {1, 2}) Take(plane, (height + 1) / 2, (columns - 1) * step + 1);
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }
  const ImageKind& kind() const { return kind_; }

  // Returns the part of the image that starts at `row`, which must be even.
  starfocus_image Out(int row = 0) {
    starfocus_image out = {kind_.format, kind_.matrix, kind_.range, kind_.pixel_stride, {}, {}};
    for (int plane = 0; plane < 3; ++plane) {
      if (bytes_[plane].empty()) continue;
      const size_t first = size_t(plane == 0 ? row : row / 2) * strides_[plane];
      out.planes[plane] = bytes_[plane].data() + first;
      out.strides[plane] = strides_[plane];
    }
    if (kind_.format == STARFOCUS_FORMAT_YUV_420_888 && out.planes[2] == nullptr) {
      out.planes[2] = static_cast<uint8_t*>(out.planes[1]) + 1;
      out.strides[2] = out.strides[1];
      if (kind_.layout == 1) std::swap(out.planes[1], out.planes[2]);
    }
    return out;
  }
  starfocus_image In(int row = 0) const { return const_cast<ImageMemory*>(this)->Out(row); }

  // Returns a sample. `colour` is 0, 1, 2 for R, G, B, or 3 for alpha.
  uint8_t* Colour(int x, int y, int colour) {
    const bool swaps =
        kind_.format == STARFOCUS_FORMAT_BGR || kind_.format == STARFOCUS_FORMAT_BGRX;
    const int place = swaps && colour < 3 ? 2 - colour : colour;
    return &bytes_[0][size_t(y) * strides_[0] + size_t(x * kind_.Step() + place)];
  }
  uint8_t* Luma(int x, int y) { return &bytes_[0][size_t(y) * strides_[0] + size_t(x)]; }
  // Returns a pointer to a chroma sample. `which` is 1 for U, 2 for V.
  uint8_t* Chroma(int which, int x, int y) {
    const size_t row = size_t(y / 2), column = size_t(x / 2 * kind_.Step());
    if (!bytes_[2].empty()) return &bytes_[which][row * strides_[which] + column];
    const bool v_first = kind_.format == STARFOCUS_FORMAT_NV21 ||
                         (kind_.format == STARFOCUS_FORMAT_YUV_420_888 && kind_.layout == 1);
    return &bytes_[1][row * strides_[1] + column + ((which == 1) == v_first ? 1 : 0)];
  }

  // Returns the bytes of all planes.
  std::vector<uint8_t> Bytes() const {
    std::vector<uint8_t> all;
    for (const auto& plane : bytes_) all.insert(all.end(), plane.begin(), plane.end());
    return all;
  }
  bool operator==(const ImageMemory& other) const {
    return bytes_[0] == other.bytes_[0] && bytes_[1] == other.bytes_[1] &&
           bytes_[2] == other.bytes_[2];
  }

 private:
  void Take(int plane, int rows, int row_bytes) {
    strides_[plane] = size_t(row_bytes + kind_.padding);
    bytes_[plane].assign(size_t(rows - 1) * strides_[plane] + size_t(row_bytes), kPoison);
  }

  ImageKind kind_;
  int width_, height_;
  std::vector<uint8_t> bytes_[3];
  size_t strides_[3] = {};
};

// Functions, such as P(a, c), that the definitions in starfocus/image.h use.
inline int Product(int a, int c) { return (a * c + (1 << 14)) >> 15; }
inline int Rounded(double value) { return int(std::lround(value)); }
inline uint8_t Code(int value) { return uint8_t(std::clamp(value, 0, 255)); }

struct Matrix {
  explicit Matrix(const ImageKind& kind)
      : kr(kind.matrix == 0 ? 0.299 : 0.2126),
        kb(kind.matrix == 0 ? 0.114 : 0.0722),
        p(kind.range == 0 ? 255.0 / 219 : 1),
        q(kind.range == 0 ? 255.0 / 224 : 1),
        y0(kind.range == 0 ? 16 : 0) {}
  double kr, kb, p, q;
  int y0;
};

// Reads the R, G, B codes of a pixel.
inline void GetPixel(ImageMemory* image, int x, int y, uint8_t* rgb) {
  if (!image->kind().IsYuv()) {
    for (int c = 0; c < 3; ++c) rgb[c] = *image->Colour(x, y, c);
    return;
  }
  const Matrix m(image->kind());
  const double kg = 1 - m.kr - m.kb, red = 2 - 2 * m.kr, blue = 2 - 2 * m.kb, one = 1 << 13;
  const int luma = Product(128 * (*image->Luma(x, y) - m.y0), Rounded(2 * one * m.p));
  const int u = 256 * (*image->Chroma(1, x, y) - 128), v = 256 * (*image->Chroma(2, x, y) - 128);
  rgb[0] = Code((luma + Product(v, Rounded(one * m.q * red)) + 32) >> 6);
  rgb[1] = Code((luma + Product(u, Rounded(-one * m.q * blue * m.kb / kg)) +
                 Product(v, Rounded(-one * m.q * red * m.kr / kg)) + 32) >>
                6);
  rgb[2] = Code((luma + Product(u, Rounded(one * m.q * blue)) + 32) >> 6);
}

// Writes a whole image. alpha(x, y) returns the alpha of a pixel.
template <class Alpha>
void PutPicture(const uint8_t* rgb, size_t stride, const Alpha& alpha, ImageMemory* image) {
  const auto code = [&](int x, int y, int c) -> int {
    const int column = std::min(x, image->width() - 1), row = std::min(y, image->height() - 1);
    return rgb[size_t(row) * stride + size_t(3 * column + c)];
  };
  const Matrix m(image->kind());
  const int wr = Rounded(32768 / m.p * m.kr), wb = Rounded(32768 / m.p * m.kb);
  const int wg = Rounded(32768 / m.p) - wr - wb, half = Rounded(16384 / m.q);
  const int ur = Rounded(-16384 / m.q * m.kr / (1 - m.kb));
  const int vb = Rounded(-16384 / m.q * m.kb / (1 - m.kr));
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width(); ++x) {
      if (!image->kind().IsYuv()) {
        for (int c = 0; c < 3; ++c) *image->Colour(x, y, c) = uint8_t(code(x, y, c));
        if (image->kind().HasAlpha()) *image->Colour(x, y, 3) = alpha(x, y);
        continue;
      }
      const int sum = Product(128 * code(x, y, 0), wr) + Product(128 * code(x, y, 1), wg) +
                      Product(128 * code(x, y, 2), wb);
      *image->Luma(x, y) = uint8_t(m.y0 + ((sum + 64) >> 7));
      if (x % 2 != 0 || y % 2 != 0) continue;
      int of[3];
      for (int c = 0; c < 3; ++c) {
        of[c] =
            32 * (code(x, y, c) + code(x + 1, y, c) + code(x, y + 1, c) + code(x + 1, y + 1, c));
      }
      const int u = Product(of[0], ur) + Product(of[1], -ur - half) + Product(of[2], half);
      const int v = Product(of[0], half) + Product(of[1], -half - vb) + Product(of[2], vb);
      *image->Chroma(1, x, y) = Code(128 + ((u + 64) >> 7));
      *image->Chroma(2, x, y) = Code(128 + ((v + 64) >> 7));
    }
  }
}

// A depth map in memory.
struct DepthMemory {
  starfocus_depth_map map = {};
  std::vector<uint64_t> words;

  uint8_t* At(int x, int y) {
    const int size = map.type == STARFOCUS_DEPTH_FLOAT ? 4 : map.type == STARFOCUS_DEPTH_U8 ? 1 : 2;
    return reinterpret_cast<uint8_t*>(words.data()) + size_t(y) * map.stride + size_t(x * size);
  }
  void Put(int x, int y, double z) {
    if (map.type == STARFOCUS_DEPTH_FLOAT) {
      const auto value = float(z);
      std::memcpy(At(x, y), &value, 4);
    } else if (map.type == STARFOCUS_DEPTH_U8) {
      *At(x, y) = uint8_t(std::clamp(std::lround(z), 0L, 255L));
    } else {
      // DEPTH16 has any confidence in its upper 3 bits.
      const uint16_t value = map.type == STARFOCUS_DEPTH_U16
                                 ? uint16_t(std::clamp(std::lround(z), 0L, 65535L))
                             : map.type == STARFOCUS_DEPTH_DEPTH16
                                 ? uint16_t(std::clamp(std::lround(z), 1L, 8191L) | (x + y) << 13)
                                 : HalfOf(z);
      std::memcpy(At(x, y), &value, 2);
    }
  }
  float Get(int x, int y) {
    if (map.type == STARFOCUS_DEPTH_U8) return float(*At(x, y));
    uint16_t word = 0;
    float value = 0;
    std::memcpy(&value, At(x, y), map.type == STARFOCUS_DEPTH_FLOAT ? 4 : 0);
    std::memcpy(&word, At(x, y), 2);
    if (map.type == STARFOCUS_DEPTH_U16) return float(word);
    if (map.type == STARFOCUS_DEPTH_DEPTH16) {
      return word % 8192 == 0 ? std::numeric_limits<float>::quiet_NaN() : float(word % 8192);
    }
    return map.type == STARFOCUS_DEPTH_FLOAT ? value : FloatOf(word);
  }

  static uint16_t HalfOf(double z) {
    if (std::isnan(z)) return 0x7E00;
    if (std::isinf(z)) return z < 0 ? 0xFC00 : 0x7C00;
    int exponent = 0;
    const double fraction = std::frexp(std::fabs(z), &exponent);
    if (z == 0 || exponent < -13) return 0;
    const long mantissa = std::lround(fraction * 2048);
    return uint16_t((z < 0 ? 0x8000 : 0) + ((exponent + 14) << 10) + mantissa - 1024);
  }
  static float FloatOf(uint16_t half) {
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    using Limits = std::numeric_limits<float>;
    if (exponent == 31 && fraction != 0) return Limits::quiet_NaN();
    if (exponent == 31) return half >= 0x8000 ? -Limits::infinity() : Limits::infinity();
    const double size =
        exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return float(half >= 0x8000 ? -size : size);
  }
};

// Makes a depth map of width x height values from a scene's disparities. Each value is the
// disparity of the middle of the pixels that the value represents.
inline DepthMemory MakeDepth(const Scene& scene, int width, int height, starfocus_depth_type type,
                             starfocus_depth_meaning meaning, int padding) {
  DepthMemory depth;
  starfocus_depth_map& map = depth.map;
  map.width = width, map.height = height, map.type = type, map.meaning = meaning;
  const double span = double(scene.disparity_max) - double(scene.disparity_min);
  // In reciprocal maps, near surfaces have small values. An offset makes all disparities positive.
  map.offset =
      float(double(scene.disparity_min) - (meaning == STARFOCUS_DEPTH_LINEAR ? 0 : 0.2 * span));
  const double steps = type == STARFOCUS_DEPTH_U8    ? 250
                       : type == STARFOCUS_DEPTH_U16 ? 60000
                                                     : 1000;
  map.scale = float(meaning == STARFOCUS_DEPTH_LINEAR ? span / steps : steps * 0.19 * span);
  const int size = type == STARFOCUS_DEPTH_FLOAT ? 4 : type == STARFOCUS_DEPTH_U8 ? 1 : 2;
  map.stride = size_t((width + padding) * size);
  depth.words.assign((map.stride * size_t(height) + 7) / 8, 0xCDCDCDCDCDCDCDCDu);
  map.data = depth.words.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double d = double(scene.Disparity((2 * x + 1) * scene.width / (2 * width),
                                              (2 * y + 1) * scene.height / (2 * height)));
      const double from = d - double(map.offset), scale = double(map.scale);
      depth.Put(x, y, meaning == STARFOCUS_DEPTH_LINEAR ? from / scale : scale / from);
    }
  }
  return depth;
}

// Returns the disparity of a depth value, in 1/64 pixel, or kUnknown.
constexpr int kUnknown = -32768;
inline int DepthAt(DepthMemory* depth, int x, int y) {
  const starfocus_depth_map& map = depth->map;
  const float z = depth->Get(x, y);
  const float scaled = map.meaning == STARFOCUS_DEPTH_LINEAR ? map.scale * z : map.scale / z;
  const float d = scaled + map.offset;
  if ((map.has_invalid != 0 && z == map.invalid) || !std::isfinite(d)) return kUnknown;
  return int(std::floor(64.0f * d + 0.5f));
}

inline int Between(int d0, int d1, int share) {
  if (std::abs(d1 - d0) > 96) return share < 128 ? d0 : d1;
  return d0 + ((share * (d1 - d0) + 128) >> 8);
}

// Returns the position, in 1/256 columns, of picture column x (of `width` columns) in a map of
// `small` columns.
inline int PlaceInMap(int x, int width, int small) {
  const int64_t p = int64_t{128} * (2 * x + 1) * small / width - 128;
  return int(std::clamp<int64_t>(p, 0, int64_t{256} * (small - 1)));
}

// Converts a depth map to width x height disparities. Unknown disparities become NaN.
inline std::vector<float> ConvertDepth(DepthMemory* depth, int width, int height) {
  const starfocus_depth_map& map = depth->map;
  std::vector<float> disparity;
  for (int y = 0; y < height; ++y) {
    const int py = PlaceInMap(y, height, map.height), upper = py / 256;
    const int lower = std::min(upper + 1, map.height - 1);
    for (int x = 0; x < width; ++x) {
      const int px = PlaceInMap(x, width, map.width), left = px / 256;
      const int right = std::min(left + 1, map.width - 1);
      const int d0 = Between(DepthAt(depth, left, upper), DepthAt(depth, left, lower), py % 256);
      const int d1 = Between(DepthAt(depth, right, upper), DepthAt(depth, right, lower), py % 256);
      const int d = Between(d0, d1, px % 256);
      disparity.push_back(d == kUnknown ? std::numeric_limits<float>::quiet_NaN() : float(d) / 64);
    }
  }
  return disparity;
}

struct ImageField {
  std::vector<ImageMemory> views;
  DepthMemory depth;
  Scene converted;  // the light field, converted to R, G, B

  // Returns the part of the light field that starts at `row`. A depth map with fewer rows than the
  // picture is always passed completely.
  starfocus_light_field Field(int row = 0) const {
    starfocus_light_field field = starfocus::NewLightField();
    for (size_t k = 0; k < views.size(); ++k) field.views[k] = views[k].In(row);
    field.depth = depth.map;
    if (depth.map.height == converted.height) {
      field.depth.data = static_cast<const char*>(depth.map.data) + size_t(row) * depth.map.stride;
    }
    return field;
  }
  uint8_t Alpha(int x, int y) const {
    ImageMemory& centre = const_cast<ImageMemory&>(views[0]);
    return centre.kind().HasAlpha() ? *centre.Colour(x, y, 3) : 255;
  }
  // Converts `out` to an image of kind `kind`. Pixel (0, 0) of `out` is pixel (x, y) of the
  // picture.
  ImageMemory Converted(const Output& out, const ImageKind& kind, int x = 0, int y = 0) const {
    ImageMemory image(out.width, out.height, kind);
    PutPicture(
        out.bytes.data(), out.stride,
        [&](int column, int row) { return Alpha(x + column, y + row); }, &image);
    return image;
  }
};

// Makes a light field of images. The range of disparities is wider than the range of the scene by
// 0.5 on each side, since maps of few bits round disparities.
inline ImageField MakeImageField(const Scene& scene, const std::vector<ImageKind>& kinds,
                                 DepthMemory depth, Random* random) {
  ImageField field;
  field.converted = EmptyScene(scene.width, scene.height, scene.views(), scene.disparity_min - 0.5f,
                               scene.disparity_max + 0.5f);
  for (int view = 0; view < scene.views(); ++view) {
    ImageMemory image(scene.width, scene.height, kinds[size_t(view) % kinds.size()]);
    PutPicture(
        scene.Pixel(view, 0, 0), scene.stride, [&](int, int) { return random->Byte(); }, &image);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        GetPixel(&image, x, y, field.converted.Pixel(view, x, y));
      }
    }
    field.views.push_back(std::move(image));
  }
  field.depth = std::move(depth);
  field.converted.disparity = ConvertDepth(&field.depth, scene.width, scene.height);
  return field;
}

inline test::Config ImageConfig(const ImageField& field, double max_blur = 20) {
  test::Config config = ConfigFor(field.converted, max_blur);
  config.features |= STARFOCUS_FEATURE_IMAGES;
  return config;
}

// Streams a light field of images, with at most `push_rows` rows per push and `pull_rows` rows per
// pull.
inline starfocus_status Stream(Engine* engine, const ImageField& field,
                               const starfocus::Params& params, int push_rows, int pull_rows,
                               ImageMemory* image, starfocus_report* report) {
  starfocus_status status = starfocus_stream_begin(engine->get(), &params);
  const int height = image->height();
  for (int pushed = 0, pulled = 0; status == STARFOCUS_OK && pulled < height;) {
    int32_t consumed = 0, written = 0;
    const int rows = std::min(push_rows, height - pushed);
    if (rows > 0) {
      const starfocus_light_field images = field.Field(pushed);
      status = starfocus_stream_push(engine->get(), &images, rows, &consumed);
      if (status != STARFOCUS_OK) return status;
      CHECK((consumed % 2 == 0 || pushed + consumed == height));
    }
    const starfocus_image out = image->Out(pulled);
    status = starfocus_stream_pull(engine->get(), &out, std::min(pull_rows, height - pulled),
                                   &written, report);
    pushed += consumed;
    pulled += written;
    if (status == STARFOCUS_OK && consumed == 0 && written == 0) return STARFOCUS_ERROR_STATE;
  }
  return status;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_IMAGES_H_
