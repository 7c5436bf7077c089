// SPDX-License-Identifier: Apache-2.0
#include "lib/io/deep.h"

#include <cstring>

#include "lib/base/curves.h"

namespace starfocus {
namespace {

// Number of pixels that are converted at once, in arrays on the stack.
constexpr int32_t kPiece = 128;

constexpr uint32_t kHalfInfinity = 0x7C00;

// Returns a 16-bit share of alpha as light, and the reverse.
constexpr uint16_t AlphaOfCode(uint32_t code) {
  return static_cast<uint16_t>((code * kLightWhite + 65535 / 2) / 65535);
}
constexpr uint16_t CodeOfAlpha(uint32_t alpha) {
  return static_cast<uint16_t>((alpha * 65535 + kLightWhite / 2) / kLightWhite);
}

// Returns the light of a positive half float; more than 64 times white is limited.
int64_t LightOfHalf(uint32_t half) {
  if (half > kHalfInfinity) return 0;  // NaN
  const uint32_t exponent = half >> 10, mantissa = half & 1023;
  const int64_t digits = (exponent == 0 ? mantissa : mantissa + 1024) * int64_t{kLightWhite};
  const int bits = 25 - static_cast<int>(exponent == 0 ? 1 : exponent);
  return bits <= 0 ? digits << -bits : (digits + (int64_t{1} << bits >> 1)) >> bits;
}

// Returns the half float that is nearest to light / kLightWhite.
uint16_t HalfOfLight(int64_t light) {
  int exponent = 1;  // as stored; 1 also for subnormal floats
  while (light << 14 >= int64_t{kLightWhite} << exponent) ++exponent;
  const int64_t units = ((light << (26 - exponent)) / kLightWhite + 1) >> 1;
  // The leading bit of `units` is not stored, but adds 1 to the exponent.
  return static_cast<uint16_t>(((exponent - 1) << 10) + units);
}

void FillEncode(int32_t transfer, uint16_t* encode) {
  uint32_t code = 0;
  for (int32_t deep = 0; deep < 65536; ++deep) {
    const int64_t light = int64_t{LightOfDeep(deep)} << kCurveBits;
    while (code < 65535 && LightOfCode(transfer, code) < light) ++code;
    const bool below =
        code > 0 && light - LightOfCode(transfer, code - 1) < LightOfCode(transfer, code) - light;
    encode[deep] = static_cast<uint16_t>(below ? code - 1 : code);
  }
}

uint16_t Word(const uint8_t* bytes) {
  uint16_t word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}
void SetWord(uint8_t* bytes, int32_t word) {
  const auto value = static_cast<uint16_t>(word);
  std::memcpy(bytes, &value, sizeof value);
}

constexpr int32_t ClampCode(int32_t code) { return Clamp(code, 0, 65535); }

// Scale of 16-bit YUV words to codes, 16 fractional bits. White is 235 * 256 or 1023 * 64.
constexpr int32_t ToCodes(bool full) { return full ? 65599 : 65792; }
constexpr int32_t FromCodes(bool full) { return full ? 65473 : 65281; }
int32_t Scaled(int32_t value, int32_t scale) {
  return static_cast<int32_t>((int64_t{value} * scale + (1 << 15)) >> 16);
}

const uint8_t* ChromaOf(const ImageSource& image, int32_t x, int32_t y) {
  const int32_t row = image.format == STARFOCUS_FORMAT_P010 ? y / 2 : y;
  return image.planes[1] + static_cast<size_t>(row) * image.strides[1] +
         4 * static_cast<size_t>(x / 2);
}

void ReadYuvCodes(const ImageSource& image, int32_t x, int32_t y, int32_t count, uint16_t* rgb) {
  const simd::YuvMatrix& m = image.Matrix();
  const uint8_t* luma = image.planes[0] + static_cast<size_t>(y) * image.strides[0] + 2 * x;
  const int32_t scale = ToCodes(image.matrix % 2 != 0);
  int32_t chroma[3] = {};  // what the chroma of two pixels adds to R, G and B; 13 fractional bits
  for (int32_t n = 0; n < count; ++n, luma += 2, rgb += 3) {
    if (n == 0 || (x + n) % 2 == 0) {
      const uint8_t* const at = ChromaOf(image, x + n, y);
      const int32_t u = Word(at) - 32768, v = Word(at + 2) - 32768;
      chroma[0] = v * m.rv + (1 << 12);
      chroma[1] = u * m.gu + v * m.gv + (1 << 12);
      chroma[2] = u * m.bu + (1 << 12);
    }
    const int32_t l = ((Word(luma) - 256 * m.black) * m.y) >> 1;
    for (int c = 0; c < 3; ++c) {
      rgb[c] = static_cast<uint16_t>(ClampCode(Scaled((l + chroma[c]) >> 13, scale)));
    }
  }
}

void ReadByteCodes(const ImageSource& image, int32_t x, int32_t y, int32_t count, uint16_t* rgb) {
  uint8_t bytes[3 * kPiece];
  ReadCodes(simd::BestImageKernels(), image, x, y, count, bytes);
  for (int32_t n = 0; n < 3 * count; ++n) rgb[n] = static_cast<uint16_t>(257 * bytes[n]);
}

// Multiplies the light of a pixel with its alpha.
void Premultiply(int32_t alpha, uint16_t* rgb) {
  for (int c = 0; c < 3; ++c) {
    const int64_t light = int64_t{LightOfDeep(rgb[c])} * alpha;
    rgb[c] = DeepOfLight((light + kLightWhite / 2) / kLightWhite);
  }
}

void ReadWords(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
               int32_t count, uint16_t* rgb, uint16_t* alpha) {
  const uint8_t* from = image.Pixel(x, y);
  for (int32_t n = 0; n < count; ++n, from += image.step, rgb += 3) {
    for (int c = 0; c < 3; ++c) rgb[c] = tables.decode[Word(from + 2 * c)];
    if (!image.refocuses_alpha) continue;
    const uint16_t code = Word(from + 6);
    const uint16_t a = code == 65535 ? uint16_t{kLightWhite} : AlphaOfCode(code);
    if (a != kLightWhite) Premultiply(a, rgb);
    if (alpha != nullptr) alpha[n] = a;
  }
}

void ReadHalves(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
                int32_t count, uint16_t* rgb, uint16_t* alpha) {
  const uint8_t* from = image.Pixel(x, y);
  const auto deep = [&](const uint8_t* at) {
    const uint16_t half = Word(at);
    return half < 0x8000 ? tables.decode_half[half] : uint16_t{0};
  };
  for (int32_t n = 0; n < count; ++n, from += image.step, rgb += 3) {
    for (int c = 0; c < 3; ++c) rgb[c] = deep(from + 2 * c);
    if (!image.refocuses_alpha || alpha == nullptr) continue;
    const uint16_t a = deep(from + 6);
    alpha[n] = a < kLightWhite ? a : kLightWhite;
  }
}

// Divides the light of a pixel by its alpha.
void Unmultiply(const uint16_t* rgb, int32_t alpha, uint16_t* straight) {
  for (int c = 0; c < 3; ++c) {
    const int64_t light = int64_t{LightOfDeep(rgb[c])} * kLightWhite;
    straight[c] = alpha == 0 ? uint16_t{0} : DeepOfLight((light + alpha / 2) / alpha);
  }
}

// Returns the 8-bit code of a 16-bit code at pixel (x, y). Codes between two 8-bit codes are
// dithered with an 8 x 8 threshold matrix, so that the mean of a smooth area is right. Codes within
// a sixteenth of an 8-bit code are rounded, so that a flat picture stays flat.
uint8_t Dithered(uint32_t code, uint32_t x, uint32_t y) {
  constexpr uint32_t kSnap = 256 / 16;
  const uint32_t fine = (code * 65280 + 32767) / 65535, whole = fine >> 8, rest = fine & 255;
  if (rest <= kSnap || rest >= 256 - kSnap) return static_cast<uint8_t>((fine + 128) >> 8);
  // Bayer's matrix: the bits of x ^ y and of y, interleaved, lowest bits first.
  const uint32_t d = x ^ y;
  const uint32_t rank =
      (d & 1) << 5 | (y & 1) << 4 | (d & 2) << 2 | (y & 2) << 1 | (d & 4) >> 1 | (y & 4) >> 2;
  return static_cast<uint8_t>(whole + (rest > 4 * rank + 2 ? 1 : 0));
}

void WriteWords(const DeepTables& tables, const DeepRow& row, int32_t width, uint8_t* to,
                const ImageTarget& image) {
  const uint16_t* rgb = row.rgb;
  for (int32_t n = 0; n < width; ++n, to += image.step, rgb += 3) {
    const uint16_t alpha = row.alpha == nullptr ? uint16_t{kLightWhite} : row.alpha[n];
    uint16_t straight[3];
    const bool divides = image.refocuses_alpha && alpha != kLightWhite;
    if (divides) Unmultiply(rgb, alpha, straight);
    for (int c = 0; c < 3; ++c) SetWord(to + 2 * c, tables.encode[(divides ? straight : rgb)[c]]);
    if (image.refocuses_alpha) SetWord(to + 6, CodeOfAlpha(alpha));
  }
}

void WriteHalves(const DeepTables& tables, const DeepRow& row, int32_t width, uint8_t* to,
                 const ImageTarget& image) {
  const uint16_t* rgb = row.rgb;
  for (int32_t n = 0; n < width; ++n, to += image.step, rgb += 3) {
    for (int c = 0; c < 3; ++c) SetWord(to + 2 * c, tables.encode_half[rgb[c]]);
    const uint16_t alpha = row.alpha == nullptr ? uint16_t{kLightWhite} : row.alpha[n];
    if (image.refocuses_alpha) SetWord(to + 6, tables.encode_half[alpha]);
  }
}

// Returns the word of a 10-bit sample, which is rounded from 16 bits and clamped.
constexpr int32_t TenBits(int32_t word) { return Clamp((word + 32) >> 6, 0, 1023) << 6; }

void WriteLuma(const DeepTables& tables, const uint16_t* rgb, int32_t width, uint8_t* to,
               const ImageTarget& image) {
  const simd::YuvMatrix& m = image.Matrix();
  const int32_t scale = FromCodes(image.matrix % 2 != 0);
  for (int32_t n = 0; n < width; ++n, rgb += 3) {
    // The weights sum to at most 2^15.
    const int32_t luma = (tables.encode[rgb[0]] * m.yr + tables.encode[rgb[1]] * m.yg +
                          tables.encode[rgb[2]] * m.yb + (1 << 14)) >>
                         15;
    SetWord(to + 2 * n, TenBits(256 * m.black + Scaled(luma, scale)));
  }
}

}  // namespace

void FillDeepTables(int32_t transfer, DeepTables* tables) {
  for (uint32_t code = 0; code < 65536; ++code) {
    const uint32_t light = LightOfCode(transfer, code);
    tables->decode[code] = DeepOfLight((light + (1 << kCurveBits >> 1)) >> kCurveBits);
    tables->encode_half[code] = HalfOfLight(LightOfDeep(static_cast<int32_t>(code)));
    if (code < 0x8000) tables->decode_half[code] = DeepOfLight(LightOfHalf(code));
  }
  FillEncode(transfer, tables->encode);
}

void ReadDeep(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
              int32_t count, uint16_t* rgb, uint16_t* alpha) {
  for (int32_t n = 0; alpha != nullptr && n < count; ++n) alpha[n] = kLightWhite;
  const int32_t format = image.format;
  if (format == STARFOCUS_FORMAT_RGB16 || format == STARFOCUS_FORMAT_RGBA16) {
    return ReadWords(tables, image, x, y, count, rgb, alpha);
  }
  if (format == STARFOCUS_FORMAT_RGB_HALF || format == STARFOCUS_FORMAT_RGBA_HALF) {
    return ReadHalves(tables, image, x, y, count, rgb, alpha);
  }
  const auto read = IsDeep(format) ? ReadYuvCodes : ReadByteCodes;
  for (int32_t n = 0; n < count; n += kPiece) {
    uint16_t codes[3 * kPiece];
    const int32_t some = Min(kPiece, count - n);
    read(image, x + n, y, some, codes);
    for (int32_t k = 0; k < 3 * some; ++k) rgb[3 * n + k] = tables.decode[codes[k]];
  }
}

void WriteDeep(const DeepTables& tables, const DeepRow& row, int32_t width, int32_t y,
               const ImageTarget& image) {
  uint8_t* const to = image.planes[0] + static_cast<size_t>(y) * image.strides[0];
  if (image.is_yuv) return WriteLuma(tables, row.rgb, width, to, image);
  const bool is_half = image.format >= STARFOCUS_FORMAT_RGB_HALF;
  (is_half ? WriteHalves : WriteWords)(tables, row, width, to, image);
}

void WriteDeepChroma(const DeepTables& tables, const uint16_t* upper, const uint16_t* lower,
                     int32_t width, int32_t y, const ImageTarget& image) {
  const simd::YuvMatrix& m = image.Matrix();
  const int32_t scale = FromCodes(image.matrix % 2 != 0);
  const int32_t row = image.format == STARFOCUS_FORMAT_P010 ? y / 2 : y;
  uint8_t* to = image.planes[1] + static_cast<size_t>(row) * image.strides[1];
  for (int32_t x = 0; x < width; x += 2, to += 4) {
    const size_t left = 3 * static_cast<size_t>(x), right = x + 1 < width ? left + 3 : left;
    int64_t sums[3];
    for (size_t c = 0; c < 3; ++c) {
      sums[c] = int64_t{tables.encode[upper[left + c]]} + tables.encode[upper[right + c]] +
                tables.encode[lower[left + c]] + tables.encode[lower[right + c]];
    }
    const auto word = [&](int32_t r, int32_t g, int32_t b) {
      const int64_t sum = sums[0] * r + sums[1] * g + sums[2] * b;
      return TenBits(32768 + Scaled(static_cast<int32_t>((sum + (1 << 16)) >> 17), scale));
    };
    SetWord(to, word(m.ur, m.ug, m.ub));
    SetWord(to + 2, word(m.vr, m.vg, m.vb));
  }
}

void DitherRow(const DeepTables& tables, const DeepRow& row, int32_t x, int32_t y, int32_t count,
               bool straight, uint8_t* rgb) {
  for (int32_t n = 0; n < count; ++n) {
    uint16_t pixel[3];
    std::memcpy(pixel, row.rgb + 3 * n, sizeof pixel);
    if (straight && row.alpha != nullptr && row.alpha[n] != kLightWhite) {
      Unmultiply(row.rgb + 3 * n, row.alpha[n], pixel);
    }
    for (int c = 0; c < 3; ++c) {
      rgb[3 * n + c] =
          Dithered(tables.encode[pixel[c]], static_cast<uint32_t>(x + n), static_cast<uint32_t>(y));
    }
  }
}

}  // namespace starfocus
