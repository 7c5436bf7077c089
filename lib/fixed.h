// Every fixed-point value of the engine: its scale, range and headroom, once.
//
// clang-format off
// | value                | type   | scale   | range                     | headroom                  |
// |----------------------|--------|---------|---------------------------|---------------------------|
// | disparity d          | int16  | 2^6     | +-500 px per unit u       | 2.3 % below +-511.98      |
// | focus d_t            | int32  | 2^6     | +-10^6 px per unit u      | 33 x                      |
// | step u_t / 2^L       | int64  | 2^24    | (0, 1]                    | only in products below    |
// | step * (d - d_t)     | int64  | 2^30    | blur radius, +-129 px     | 2^26 x                    |
// | shift s              | int32  | 2^8     | +-129 px                  | 2^16 x                    |
// | cell width r / N     | int32  | 2^8     | [0, 1], clamped           | -                         |
// | interpolation weight | int32  | 2^8     | [0, 1/2]                  | -                         |
// | aperture weight      | uint16 | 2^k     | [0, 32767], sum 2^k       | signed 16-bit multiplies  |
// | accumulator          | uint32 | 2^k     | <= 255 * 2^k, k <= 24     | 0.4 % below 2^32          |
// clang-format on
//
// Rounding: Round* rounds half up; a plain shift truncates towards minus infinity.
#ifndef STARFOCUS_LIB_FIXED_H_
#define STARFOCUS_LIB_FIXED_H_

#include <cstdint>

namespace starfocus {

inline constexpr int kDisparityBits = 6;
inline constexpr int kStepBits = 24;
inline constexpr int kShiftBits = 8;
inline constexpr int32_t kShiftOne = 1 << kShiftBits;
inline constexpr int kMaxWeightBits = 24;
inline constexpr int32_t kMaxWeight = 32767;

// Two neighbouring pixels belong to one surface when their disparities differ by at most this.
inline constexpr int32_t kSurfaceStep = (3 << kDisparityBits) / 2;

constexpr int64_t RoundShift(int64_t value, int bits) {
  return (value + (int64_t{1} << (bits - 1))) >> bits;
}

constexpr int32_t Min(int32_t a, int32_t b) { return a < b ? a : b; }
constexpr int32_t Max(int32_t a, int32_t b) { return a > b ? a : b; }
constexpr int32_t Abs(int32_t a) { return a < 0 ? -a : a; }
constexpr int32_t Clamp(int32_t value, int32_t low, int32_t high) {
  return value < low ? low : value > high ? high : value;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FIXED_H_
