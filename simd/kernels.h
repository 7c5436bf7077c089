// The SIMD kernels and their contracts. kernels_ref.cc defines every result; each Highway target
// gives the same bits. Pointers need no alignment; vector types never appear here.
#ifndef STARFOCUS_SIMD_KERNELS_H_
#define STARFOCUS_SIMD_KERNELS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Kernels may read this many bytes past the end of any source, and add zero to as many bytes of
// accumulators past the end of any target: every buffer of the workspace carries this padding.
inline constexpr size_t kPadding = 64;

// A stretch of samples (R, G, B interleaved) that one source surface gives to a line:
// value[n] = weight * source[n] + neighbour_weight * source[n + neighbour_offset].
struct Span {
  const uint8_t* source;
  uint32_t target;            // first sample in the target line
  uint32_t samples;           // > 0
  uint16_t weight;            // [0, 32767]
  uint16_t neighbour_weight;  // [0, 32767]; 0: the neighbour is not read
  int32_t neighbour_offset;   // samples: +3 or -3
};

// Layer samples are int16 with 6 fractional bits: [0, kLayerWhite] when in range.
inline constexpr int kLayerBits = 6;
inline constexpr int16_t kLayerWhite = 255 << kLayerBits;
// Filter taps have 14 fractional bits.
inline constexpr int kTapBits = 14;

// Taps of a symmetric 7-tap half-band filter at 0, +-1 and +-3 (those at +-2 are zero).
struct HalfBand {
  int32_t centre, near, far;  // |tap| <= 2^14
};

// A symmetric filter of 2 * reach + 1 taps over pixels, with 8 fractional bits: `centre`, `inner`
// at 1 .. reach - 1, `outer` at reach. They sum to 256.
struct SpreadTaps {
  int32_t reach;  // [1, kMaxSpread]
  uint16_t centre, inner, outer;
};
inline constexpr int32_t kMaxSpread = 3;

struct Kernels {
  const char* name;  // of the SIMD target

  // accumulators[target + n] += value[n], for each span. No sum exceeds 2^32 - 1.
  void (*accumulate)(const Span* spans, size_t count, uint32_t* accumulators);

  // line[target + n] = value[n] / 256, halves to even, for each span; weights of a span sum to
  // 256. Rounding halves up would brighten pictures shifted by half pixels by 1/4 gray level.
  // Sources don't overlap the line. Nothing outside the spans is written.
  void (*blend)(const Span* spans, size_t count, uint8_t* line);

  // out[n] = (the taps over in[n + 3 k], |k| <= reach) / 256, halves to even. in and out don't
  // overlap.
  void (*spread)(const uint8_t* in, const SpreadTaps& taps, size_t count, uint8_t* out);

  // out[n] = (accumulators[n] + 2^(shift - 1)) >> shift; shift in [1, 24]; results fit a byte.
  void (*finish)(const uint32_t* accumulators, size_t count, int shift, uint8_t* out);

  // out[n] = round-half-up(disparity[n] * 64). Returns whether every value is within [low, high];
  // when false (NaN included), out is unspecified. |low|, |high| <= 511.
  bool (*convert_disparity)(const float* disparity, size_t count, float low, float high,
                            int16_t* out);

  // out[n] = in[n] << 6.
  void (*widen)(const uint8_t* in, size_t count, int16_t* out);

  // out[n] = in[n] rounded to a whole number, halves to even, and clamped to a byte.
  void (*narrow)(const int16_t* in, size_t count, uint8_t* out);

  // out[n] = (accumulators[n] + 2^(shift - 7)) >> (shift - 6); shift in [7, 24].
  void (*finish_layer)(const uint32_t* accumulators, size_t count, int shift, int16_t* out);

  // out[n] = clamp((centre in[n] + near (in[n - step] + in[n + step])
  //                 + far (in[n - 3 step] + in[n + 3 step]) + 2^13) >> 14, low, high).
  void (*half_band)(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                    int16_t low, int16_t high, int16_t* out);

  // The odd phase of upsampling, between in[n] and in[n + step]: as half_band with
  // near (in[n] + in[n + step]) + far (in[n - step] + in[n + 2 step]) alone.
  void (*between)(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                  int16_t low, int16_t high, int16_t* out);
};

// The best target of this machine, chosen once by Highway.
const Kernels& BestKernels();
// The definition of every result, in plain C++.
const Kernels& ReferenceKernels();

// For tests and the bench, not for a run-time choice (it is slow and changes Highway's choice for
// other threads while it runs): target `index` of those compiled in and supported here, the best
// first; null past the last.
const Kernels* KernelsOfTarget(size_t index);
// The one of that name; null when there is none.
const Kernels* FindKernels(const char* name);

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_KERNELS_H_
