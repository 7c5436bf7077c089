// SPDX-License-Identifier: Apache-2.0
#include "lib/io/deep.h"

#include <cstring>
#include <type_traits>

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

// Returns the words of an image from pixel (x, y) on.
template <class Byte>
auto* WordsOf(const ImagePlanes<Byte>& image, int32_t x, int32_t y) {
  using Word = std::conditional_t<std::is_const_v<Byte>, const uint16_t, uint16_t>;
  return reinterpret_cast<Word*>(image.planes[0] + static_cast<size_t>(y) * image.strides[0]) +
         static_cast<size_t>(x) * (image.is_yuv ? 1 : image.step / 2);
}

constexpr bool IsHalf(int32_t format) {
  return format == STARFOCUS_FORMAT_RGB_HALF || format == STARFOCUS_FORMAT_RGBA_HALF;
}
// Returns the word of alpha 1.
constexpr uint16_t OpaqueWord(int32_t format) { return IsHalf(format) ? 0x3C00 : 65535; }

// Returns four words as one number, in the byte order of the machine.
uint64_t FourWords(const uint16_t* words) {
  uint64_t four;
  std::memcpy(&four, words, sizeof four);
  return four;
}
// Returns the four words of a pixel of one grey.
uint64_t Lanes(uint16_t colours, uint16_t alpha) {
  const uint16_t words[4] = {colours, colours, colours, alpha};
  return FourWords(words);
}

// Highest bits of four words.
constexpr uint64_t kSigns = 0x8000800080008000;
// Compares four words with four others. Sets the highest bit of a word of the result if a <= b, for
// words below 0x8000, and clears this bit if a is 0x8000 or more.
constexpr uint64_t NotAbove(uint64_t a, uint64_t b) { return ((b | kSigns) - (a & ~kSigns)) & ~a; }

// Returns the AND of of(four words) over `count` >= 4 words.
template <class Of>
uint64_t AndOfFours(const uint16_t* words, size_t count, const Of& of) {
  uint64_t all = of(FourWords(words + count - 4));
  for (size_t n = 0; n + 4 <= count; n += 4) all &= of(FourWords(words + n));
  return all;
}

// Returns true if `count` words, `step` apart, equal `word`.
bool AreAll(const uint16_t* words, int32_t count, size_t step, uint16_t word) {
  uint32_t differences = 0;
  for (size_t n = 0; n < static_cast<size_t>(count); ++n) differences |= words[n * step] ^ word;
  return differences == 0;
}

// Looks the colours of `count` pixels up in a table. Pixels are `step` and `to_step` words apart.
void LookUp(const uint16_t* table, const uint16_t* from, size_t step, int32_t count, uint16_t* to,
            size_t to_step) {
  for (int32_t n = 0; n < count; ++n, from += step, to += to_step) {
    const uint16_t r = table[from[0]], g = table[from[1]], b = table[from[2]];
    to[0] = r;
    to[1] = g;
    to[2] = b;
  }
}

// Returns the chroma samples of pixel (x, y).
template <class Byte>
auto* ChromaOf(const ImagePlanes<Byte>& image, int32_t x, int32_t y) {
  ImagePlanes<Byte> chroma = image;
  chroma.planes[0] = image.planes[1];
  chroma.strides[0] = image.strides[1];
  return WordsOf(chroma, x / 2 * 2, image.format == STARFOCUS_FORMAT_P010 ? y / 2 : y);
}

// Reads `count` < kPiece pixels of a deep YUV image. Returns where in `room` they begin: if x is
// odd, the pixel before them is converted too, because kernels begin with whole pairs.
const uint16_t* ReadYuvCodes(const ImageSource& image, int32_t x, int32_t y, int32_t count,
                             uint16_t room[3 * kPiece]) {
  const int32_t before = x % 2;
  simd::BestWordKernels().YuvWordsToRgb(WordsOf(image, x - before, y),
                                        ChromaOf(image, x - before, y),
                                        static_cast<size_t>(count + before), image.Matrix(), room);
  return room + 3 * before;
}

void ReadBytes(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
               int32_t count, uint16_t* rgb) {
  uint8_t room[3 * kPiece];
  for (int32_t n = 0, some; n < count; n += some) {
    some = image.IsPacked() ? count : Min(kPiece, count - n);
    const uint8_t* bytes = image.IsPacked() ? image.Pixel(x, y) : room;
    if (!image.IsPacked()) ReadCodes(simd::BestImageKernels(), image, x + n, y, some, room);
    for (int32_t k = 0; k < 3 * some; ++k) rgb[3 * n + k] = tables.decode_bytes[bytes[k]];
  }
}

// Multiplies the light of a pixel by its alpha.
void Premultiply(int32_t alpha, uint16_t* rgb) {
  for (int c = 0; c < 3; ++c) {
    const int64_t light = int64_t{LightOfDeep(rgb[c])} * alpha;
    rgb[c] = DeepOfLight((light + kLightWhite / 2) / kLightWhite);
  }
}

// Reads pixels of R, G and B of 16 bits or half floats. Writes only those values of `alpha` that
// are not opaque: the caller has set all to opaque.
void ReadWords(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
               int32_t count, uint16_t* rgb, uint16_t* alpha) {
  const bool is_half = IsHalf(image.format);
  const uint16_t* const from = WordsOf(image, x, y);
  const uint16_t* const decode = is_half ? tables.decode_half : tables.decode;
  const size_t step = image.step / 2, pixels = static_cast<size_t>(count);
  LookUp(decode, from, step, count, rgb, 3);
  if (!image.refocuses_alpha || AreAll(from + 3, count, step, OpaqueWord(image.format))) return;
  for (size_t n = 0; n < pixels; ++n) {
    const uint16_t word = from[n * step + 3];
    const uint16_t a =
        is_half ? static_cast<uint16_t>(Min(decode[word], kLightWhite)) : AlphaOfCode(word);
    if (!is_half) Premultiply(a, rgb + 3 * n);
    if (alpha != nullptr) alpha[n] = a;
  }
}

// Divides the light of a pixel by its alpha.
void Unmultiply(const uint16_t* rgb, int32_t alpha, uint16_t* straight) {
  for (int c = 0; c < 3; ++c) {
    const int64_t light = int64_t{LightOfDeep(rgb[c])} * kLightWhite;
    straight[c] = alpha == 0 ? uint16_t{0} : DeepOfLight((light + alpha / 2) / alpha);
  }
}

// Fills `more` of DitherWords for row y with the thresholds of Bayer's matrix. With these, the mean
// of a smooth area is right.
void FillThresholds(uint32_t y, uint16_t* more) {
  for (uint32_t x = 0; x < 8; ++x) {
    // The rank in the matrix has the bits of x ^ y and of y, interleaved, lowest bits first.
    const uint32_t d = x ^ y;
    const uint32_t rank =
        (d & 1) << 5 | (y & 1) << 4 | (d & 2) << 2 | (y & 2) << 1 | (d & 4) >> 1 | (y & 4) >> 2;
    more[x] = static_cast<uint16_t>(253 - 4 * rank);
  }
}

}  // namespace

void FillDeepTables(int32_t transfer, DeepTables* tables) {
  for (uint32_t code = 0; code < 65536; ++code) {
    const uint32_t light = LightOfCode(transfer, code);
    tables->decode[code] = DeepOfLight((light + (1 << kCurveBits >> 1)) >> kCurveBits);
    tables->encode_half[code] = HalfOfLight(LightOfDeep(static_cast<int32_t>(code)));
    tables->decode_half[code] = code < 0x8000 ? DeepOfLight(LightOfHalf(code)) : uint16_t{0};
  }
  for (int code = 0; code < 256; ++code) tables->decode_bytes[code] = tables->decode[257 * code];
  FillEncode(transfer, tables->encode);
}

bool MayExceedWhite(const DeepTables& tables, int32_t format) {
  return IsHalf(format) || tables.encode[kLightWhite] != 65535;
}

bool IsPlain(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
             int32_t count) {
  const bool is_half = IsHalf(image.format), may_exceed = MayExceedWhite(tables, image.format);
  if (!may_exceed && !image.refocuses_alpha) return true;
  if (!IsDeep(image.format) || image.is_yuv || (may_exceed && !is_half)) return false;
  // Hardware prefetchers stop at the end of a page of memory.
  constexpr int32_t kAhead = 512;  // pixels
  image.Prefetch(x + kAhead, y, count);
  const uint64_t white = Lanes(0x3C00, 0x3C00), alpha = Lanes(0, OpaqueWord(image.format));
  const uint16_t* const from = WordsOf(image, x, y);
  const size_t step = image.step / 2, words = static_cast<size_t>(count) * step;
  if (step != (image.refocuses_alpha ? 4 : 3) || words < 4) return false;
  if (!is_half) {
    return AndOfFours(from, words, [&](uint64_t four) { return four | ~alpha; }) == ~uint64_t{0};
  }
  const auto is_dark = [&](uint64_t four) { return NotAbove(four, white); };
  const auto is_opaque = [&](uint64_t four) { return is_dark(four) & NotAbove(alpha, four); };
  return kSigns == (kSigns & (image.refocuses_alpha ? AndOfFours(from, words, is_opaque)
                                                    : AndOfFours(from, words, is_dark)));
}

void ReadDeep(const DeepTables& tables, const ImageSource& image, int32_t x, int32_t y,
              int32_t count, uint16_t* rgb, uint16_t* alpha) {
  for (int32_t n = 0; alpha != nullptr && n < count; ++n) alpha[n] = kLightWhite;
  const int32_t format = image.format;
  if (IsDeep(format) && !image.is_yuv) {
    return ReadWords(tables, image, x, y, count, rgb, alpha);
  }
  if (!IsDeep(format)) return ReadBytes(tables, image, x, y, count, rgb);
  for (int32_t n = 0, some; n < count; n += some) {
    uint16_t room[3 * kPiece];
    some = Min(kPiece - 1, count - n);
    const uint16_t* const codes = ReadYuvCodes(image, x + n, y, some, room);
    LookUp(tables.decode, codes, 3, some, rgb + 3 * n, 3);
  }
}

void WriteDeep(const DeepTables& tables, const DeepRow& row, int32_t width, int32_t y,
               const ImageTarget& image) {
  const bool is_half = IsHalf(image.format);
  const uint16_t* const encode = is_half ? tables.encode_half : tables.encode;
  const size_t step = image.step / 2, pixels = static_cast<size_t>(width);
  uint16_t* const to = WordsOf(image, 0, y);
  if (!image.refocuses_alpha) return LookUp(encode, row.rgb, 3, width, to, step);
  if (row.alpha == nullptr || AreAll(row.alpha, width, 1, kLightWhite)) {
    LookUp(encode, row.rgb, 3, width, to, step);
    const uint16_t opaque = OpaqueWord(image.format);
    for (size_t n = 0; n < pixels; ++n) to[n * step + 3] = opaque;
    return;
  }
  for (size_t n = 0; n < pixels; ++n) {
    uint16_t straight[3];
    if (!is_half) Unmultiply(row.rgb + 3 * n, row.alpha[n], straight);
    LookUp(encode, is_half ? row.rgb + 3 * n : straight, 3, 1, to + n * step, 3);
    to[n * step + 3] = is_half ? encode[row.alpha[n]] : CodeOfAlpha(row.alpha[n]);
  }
}

void WriteDeepYuv(const DeepTables& tables, const uint16_t* const rows[2], const Range& luma,
                  int32_t width, int32_t y, const ImageTarget& image) {
  const simd::WordKernels& kernels = simd::BestWordKernels();
  for (int32_t x = 0; x < width; x += kPiece) {
    uint16_t codes[2][3 * kPiece];
    const int32_t some = Min(kPiece, width - x);
    const auto count = static_cast<size_t>(some);
    for (int k = 0; k < 2; ++k) {
      if (rows[k] == nullptr || (k == 1 && rows[1] == rows[0])) continue;
      LookUp(tables.encode, rows[k] + 3 * x, 3, some, codes[k], 3);
    }
    for (int32_t at = luma.first; at < luma.last; ++at) {
      kernels.RgbToLumaWords(codes[at - y], count, image.Matrix(), WordsOf(image, x, at));
    }
    if (rows[1] == nullptr) continue;
    kernels.RgbToChromaWords(codes[0], codes[rows[1] != rows[0] ? 1 : 0], count, image.Matrix(),
                             ChromaOf(image, x, y));
  }
}

void DitherRow(const DeepTables& tables, const DeepRow& row, int32_t y, int32_t count,
               bool straight, uint8_t* rgb) {
  static_assert(kPiece % simd::kDitherColumns == 0);
  uint16_t more[8];
  FillThresholds(static_cast<uint32_t>(y), more);
  straight = straight && !AreAll(row.alpha, count, 1, kLightWhite);
  for (int32_t n = 0; n < count; n += kPiece) {
    uint16_t codes[3 * kPiece];
    const int32_t some = Min(kPiece, count - n);
    LookUp(tables.encode, row.rgb + 3 * n, 3, some, codes, 3);
    for (int32_t k = 0; straight && k < some; ++k) {
      uint16_t pixel[3];
      Unmultiply(row.rgb + 3 * (n + k), row.alpha[n + k], pixel);
      LookUp(tables.encode, pixel, 3, 1, codes + 3 * k, 3);
    }
    simd::BestWordKernels().DitherWords(codes, static_cast<size_t>(some), more, rgb + 3 * n);
  }
}

}  // namespace starfocus
