// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

namespace starfocus {
namespace {

template <class T, class Bits>
T As(Bits bits) {
  T value;
  static_assert(sizeof(value) == sizeof(bits));
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// Converts an IEEE float of 16 bits: a sign, 5 bits of exponent and 10 bits of fraction.
float HalfOf(uint64_t bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31), fraction = static_cast<int>(bits & 1023);
  float value = std::ldexp(static_cast<float>(fraction + (exponent > 0 ? 1024 : 0)),
                           std::max(exponent, 1) - 25);
  if (exponent == 31) value = fraction == 0 ? HUGE_VALF : std::numeric_limits<float>::quiet_NaN();
  return (bits >> 15 & 1) != 0 ? -value : value;
}

float DoubleOf(uint64_t bits) {
  const auto value = As<double>(bits);
  if (std::fabs(value) <= double{std::numeric_limits<float>::max()} || std::isnan(value)) {
    return static_cast<float>(value);
  }
  return value > 0 ? HUGE_VALF : -HUGE_VALF;
}

template <class T>
float SignedOf(uint64_t bits) {
  return static_cast<float>(static_cast<T>(bits));
}

float UnsignedOf(uint64_t bits) { return static_cast<float>(bits); }

float FloatOf(uint64_t bits) { return As<float>(static_cast<uint32_t>(bits)); }

struct Conversion {
  NumberKind kind;
  size_t bytes;
  int largest;
  float (*convert)(uint64_t bits);
};
constexpr Conversion kConversions[] = {
    {NumberKind::kUnsigned, 1, UINT8_MAX, UnsignedOf},
    {NumberKind::kUnsigned, 2, UINT16_MAX, UnsignedOf},
    {NumberKind::kUnsigned, 4, UINT16_MAX, UnsignedOf},
    {NumberKind::kUnsigned, 8, UINT16_MAX, UnsignedOf},
    {NumberKind::kSigned, 1, INT8_MAX, SignedOf<int8_t>},
    {NumberKind::kSigned, 2, INT16_MAX, SignedOf<int16_t>},
    {NumberKind::kSigned, 4, UINT16_MAX, SignedOf<int32_t>},
    {NumberKind::kSigned, 8, UINT16_MAX, SignedOf<int64_t>},
    {NumberKind::kFloat, 2, 0, HalfOf},
    {NumberKind::kFloat, 4, 0, FloatOf},
    {NumberKind::kFloat, 8, 0, DoubleOf},
};

const Conversion* Find(const NumberType& type) {
  return std::find_if(
      std::begin(kConversions), std::end(kConversions),
      [&type](const Conversion& one) { return one.kind == type.kind && one.bytes == type.bytes; });
}

}  // namespace

bool CanReadNumbers(const NumberType& type) { return Find(type) != std::end(kConversions); }

int LargestNumber(const NumberType& type) { return Find(type)->largest; }

void ReadNumbers(const NumberType& type, const uint8_t* data, size_t count, float* values) {
  const auto convert = Find(type)->convert;
  // All sizes are powers of two, so that `at ^ flip` counts from the last byte in big-endian
  // numbers.
  const size_t bytes = type.bytes, flip = type.order == ByteOrder::kBig ? bytes - 1 : 0;
  for (size_t k = 0; k < count; ++k, data += bytes) {
    uint64_t bits = 0;
    for (size_t at = 0; at < bytes; ++at) bits |= uint64_t{data[at ^ flip]} << 8 * at;
    values[k] = convert(bits);
  }
}

}  // namespace starfocus
