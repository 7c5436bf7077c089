// SPDX-License-Identifier: Apache-2.0
// Scale, range and headroom of every fixed-point value of the engine.
//
// clang-format off
// | value                   | type   | scale    | range                     | headroom                  |
// |-------------------------|--------|----------|---------------------------|---------------------------|
// | disparity d             | int16  | 2^6      | +-500 px per unit u       | 2.3 % below +-511.98      |
// | focus d_t               | int32  | 2^6      | +-10^6 px per unit u      | 33 x                      |
// | disparity without range | int16  | 2^6      | +-500 px per unit u       | 2.3 % below +-511.98      |
// | view position (u, v)    | int16  | 2^14     | [-1, 1]                   | 1 below 2 x               |
// | step u_t / 2^L          | int64  | 2^24     | (0, 1]                    | only in products below    |
// | step * (d - d_t)        | int64  | 2^30     | blur radius, +-134 px     | 2^26 x                    |
// | shift s                 | int32  | 2^8      | +-134 px                  | 2^16 x                    |
// | blur radius of cells    | uint16 | 2^6      | [0, 129] px               | 7.9 x                     |
// | reach of cells          | int16  | 1        | [-8, 131] px              | 250 x                     |
// | subaperture r / N       | int32  | 2^8      | [0, 1], clamped           | -                         |
// | interpolation weight    | int32  | 2^14     | [0, 1/2]                  | -                         |
// | light                   | int16  | 2^7      | [0, 255]: white is 32640  | 0.4 % below 2^15          |
// | colour of a slice       | int16  | 2^7      | [0, 255], times coverage  | 0.4 % below 2^15          |
// | coverage of a slice     | int16  | 2^15     | [0, 1]; 1 is 32767        | saturates                 |
// | wide subaperture        | int32  | 2^8      | (1, 7], clamped           | -                         |
// | wide subaperture part   | int16  | 2^15     | [-1, 0], their sum is -1  | none: 16 bits hold -1     |
// | sum / coverage          | uint64 | 2^48     | 2^32 sums, 2^32 inverses  | none: colours <= coverage |
// | weight of a view        | int16  | varies   | [0, 14500]                | 13 % below 2^14           |
// | sum of a view column    | uint16 | 2^8      | weights: 58000; 1/9 more  | 1 % below 2^16            |
// | sum of all slices       | uint32 | 2^8      | 58000 a column, N <= 41   | 800 x                     |
// | mirrored pixels, mean   | uint16 | 2^7      | [0, 255], of two or four  | signed 16-bit multiplies  |
// | mirrored pixels, weight | uint16 | 2^k      | [0, 32767], k <= 17       | signed 16-bit multiplies  |
// | radius on a slope       | int32  | 2^10     | +-60 px, +-130 px around  | 2^13 x                    |
// | share of larger PSF     | int16  | 2^15     | [0, 1); 1 is 32767        | saturates                 |
// | half move of a slope    | int16  | 2^15     | (-1, 1) px, clamped       | none                      |
// | mixed row, extended     | int16  | 2^6      | [-255, 510]               | 0.4 % below 511.98        |
// | aperture weight         | uint16 | 2^k      | [0, 32767], k <= 17       | signed 16-bit multiplies  |
// | subaperture weight      | uint16 | 2^k      | [0, 32767], k <= 24       | signed 16-bit multiplies  |
// | PSF weight              | uint16 | 2^k      | [0, 32767], k <= 17       | signed 16-bit multiplies  |
// | accumulator             | uint32 | 2^(7+k)  | [0, 255], k <= 17         | 0.4 % below 2^32          |
// | layer sample            | int16  | 2^6      | [0, 255]                  | 2 x                       |
// | two layer samples       | int16  | 2^6      | [0, 510]                  | 0.4 % below 511.98        |
// | filtered along x        | int16  | 2^6      | [-39, 294]                | 74 % below 511            |
// | sum of filter taps      | int32  | 2^20     | [-100, 410]: twice 1.33   | 5 x                       |
// | upsampled along y       | int16  | 2^6      | [-43, 298]                | 71 % below 511            |
// | position of a hole      | int32  | 2^8      | +-66300 px                | 126 x                     |
// | hole sum, layer 0       | int32  | 2^23     | [0, 255]                  | 0.4 % below 2^31          |
// | hole sum, layer L       | int32  | 2^(7+4L) | [0, 255], L <= 2          | 2^8 x                     |
// | share of a mixture      | int32  | 2^14     | [0, 4/5], four of a pixel | 1.6 x in its dividend     |
// | share * light           | int32  | 2^21     | [0, 204], four of a pixel | 1.2 x in the sum of four  |
// | mean colour of a cell   | uint16 | 2^6      | [0, 255]                  | 4 x                       |
// | squared differences     | int32  | 2^12     | [0, 195075], of three     | 2.6 x                     |
// | scale of a map, minus 1 | int32  | 2^16     | [-1/4, 1/4]               | 4 x in its product        |
// clang-format on
//
// Rounding: Round* rounds half up; a plain shift truncates towards minus infinity.
#ifndef STARFOCUS_LIB_BASE_FIXED_H_
#define STARFOCUS_LIB_BASE_FIXED_H_

#include <cstddef>
#include <cstdint>

#ifdef STARFOCUS_CHECK_RANGES
#include <cstdio>
#include <cstdlib>
#endif

namespace starfocus {

inline constexpr int kDisparityBits = 6;
inline constexpr int kViewBits = 14;
inline constexpr int16_t kViewOne = 1 << kViewBits;
inline constexpr int kStepBits = 24;
inline constexpr int kShiftBits = 8;
inline constexpr int32_t kShiftOne = 1 << kShiftBits;
inline constexpr int kShareBits = 14;
inline constexpr int kMaxWeightBits = 24;
// Base-2 logarithm of the largest sum of light weights in an accumulator.
inline constexpr int kMaxLightBits = 17;
inline constexpr int32_t kMaxWeight = 32767;

// Largest difference between the disparities of two neighbouring pixels of one surface,
// kDisparityBits.
inline constexpr int32_t kSurfaceStep = (3 << kDisparityBits) / 2;

// Largest step of disparity between neighbouring pixels of layer 0 that is not a depth edge of the
// slice renderer, kDisparityBits.
inline constexpr int16_t kDepthEdge = (3 << kDisparityBits) / 4;

// Permitted range of a fixed-point value that several functions compute.
struct FixedRange {
  const char* name;
  int64_t low, high;
};

namespace ranges {
inline constexpr int64_t kPixel = 1 << kShiftBits;
inline constexpr int64_t kBlurEnd = 129;
inline constexpr FixedRange kDisparity = {"disparity", -500 * 64, 500 * 64};
inline constexpr FixedRange kFocus = {"focus", -1000000 * 64, 1000000 * 64};
// Limit of shifts in pixels. The limit exceeds the largest blur radius because the outermost views
// of N = 4 lie at 128/123 of the lens radius (LensInSubapertures).
inline constexpr int64_t kShiftEnd = 134;
inline constexpr FixedRange kShift = {"shift", -kShiftEnd* kPixel, kShiftEnd* kPixel};
inline constexpr FixedRange kRadius = {"blur radius of a cell", 0, kBlurEnd << kDisparityBits};
inline constexpr FixedRange kReach = {"reach of a cell", -8, kBlurEnd + 2};
inline constexpr FixedRange kSubapertureWeight = {"interpolation weight", 0, 1 << 13};
inline constexpr FixedRange kWeight = {"aperture weight", 0, kMaxWeight};
inline constexpr FixedRange kBlurWeight = {"weight of a PSF", 0, kMaxWeight};
inline constexpr FixedRange kFilteredAlongX = {"filtered along x", -39 * 64, 294 * 64};
inline constexpr FixedRange kUpsampledAlongY = {"upsampled along y", -43 * 64, 298 * 64};
inline constexpr FixedRange kLayerSample = {"layer sample", 0, 255 * 64};
inline constexpr FixedRange kHolePosition = {"position of a hole", -66300 * kPixel, 66300 * kPixel};
inline constexpr FixedRange kHolePixel = {"hole at layer 0", 0, (255 << 7) * kPixel* kPixel};
inline constexpr FixedRange kUnmixed = {"unmixed pixel", 0, 255 << 7};
inline constexpr FixedRange kRemainder = {"weight that remains unassigned", 0, 0};
}  // namespace ranges

// Returns `value`. With STARFOCUS_CHECK_RANGES, which only one debug build defines, a value outside
// its range is passed to on_range_failure. If on_range_failure is null, the program aborts. Builds
// without STARFOCUS_CHECK_RANGES do not check ranges.
#ifdef STARFOCUS_CHECK_RANGES
inline constexpr bool kCheckRanges = true;
inline void (*on_range_failure)(const FixedRange& range, int64_t value) = nullptr;

inline void FailRange(const FixedRange& range, int64_t value) {
  if (on_range_failure != nullptr) {
    on_range_failure(range, value);
    return;
  }
  std::fprintf(stderr, "starfocus: %s is %lld, outside [%lld, %lld]\n", range.name,
               static_cast<long long>(value), static_cast<long long>(range.low),
               static_cast<long long>(range.high));
  std::abort();
}

template <class T>
T Checked(const FixedRange& range, T value) {
  const auto wide = static_cast<int64_t>(value);
  if (wide < range.low || wide > range.high) FailRange(range, wide);
  return value;
}
#else
inline constexpr bool kCheckRanges = false;
template <class T>
constexpr T Checked(const FixedRange&, T value) {
  return value;
}
#endif

// Applies Checked to the elements of an array.
template <class T>
void CheckAll(const FixedRange& range, const T* values, size_t count) {
  if (!kCheckRanges) return;
  for (size_t n = 0; n < count; ++n) Checked(range, values[n]);
}

// Checks accumulators of pixels whose weights sum to 2^sum_bits.
inline void CheckSums(const uint32_t* sums, size_t count, int sum_bits) {
  CheckAll({"accumulator", 0, int64_t{255} << sum_bits}, sums, count);
}

constexpr int64_t RoundShift(int64_t value, int bits) {
  return (value + (int64_t{1} << (bits - 1))) >> bits;
}

constexpr int32_t Min(int32_t a, int32_t b) { return a < b ? a : b; }
constexpr int32_t Max(int32_t a, int32_t b) { return a > b ? a : b; }
constexpr int32_t Abs(int32_t a) { return a < 0 ? -a : a; }
constexpr int32_t Clamp(int32_t value, int32_t low, int32_t high) {
  return value < low ? low : value > high ? high : value;
}

// Returns the index of the lowest set bit; bits != 0.
inline int32_t LowestBit(uint32_t bits) { return __builtin_ctz(bits); }

// Returns the index of the highest set bit; bits != 0.
inline int32_t HighestBit(uint32_t bits) { return 31 - __builtin_clz(bits); }

// Returns the number of bits that are 1.
inline uint32_t CountBits(uint64_t bits) {
  return static_cast<uint32_t>(__builtin_popcountll(bits));
}

// Calls visit(index) for each set bit, in ascending order.
template <class Visit>
void ForEachBit(uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(LowestBit(bits));
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_FIXED_H_
