// SPDX-License-Identifier: Apache-2.0
// Converts the numbers of arrays in files to floats.
#ifndef STARFOCUS_PLATFORM_DECODERS_NUMBERS_H_
#define STARFOCUS_PLATFORM_DECODERS_NUMBERS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus {

enum class ByteOrder { kLittle, kBig };

// Byte order of numbers in the memory of this machine.
inline constexpr ByteOrder kOwnByteOrder =
    __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? ByteOrder::kBig : ByteOrder::kLittle;

enum class NumberKind { kUnsigned, kSigned, kFloat };

// Type of the numbers of an array.
struct NumberType {
  NumberKind kind;
  size_t bytes;
  ByteOrder order;
};

// Returns true if ReadNumbers supports the type: integers of 1, 2, 4 or 8 bytes, and IEEE floats of
// 2, 4 or 8 bytes.
bool CanReadNumbers(const NumberType& type);

// Returns the largest integer of a supported type, at most 65535, or 0 for floats. Types of 32 and
// 64 bits usually store values of 16 bits, for which libraries have no other type.
int LargestNumber(const NumberType& type);

// Converts `count` numbers of a supported type. Integers of more than 24 bits are rounded. 64-bit
// floats beyond the range of float become infinite.
void ReadNumbers(const NumberType& type, const uint8_t* data, size_t count, float* values);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_NUMBERS_H_
