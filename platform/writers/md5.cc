// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/md5.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace starfocus {
namespace {

constexpr size_t kBlock = 64;  // bytes

using State = std::array<uint32_t, 4>;

uint32_t RotateLeft(uint32_t value, int bits) { return value << bits | value >> (32 - bits); }

// Returns the 64 constants of RFC 1321: for i from 1 to 64, the integer part of 2^32 * |sin(i)|,
// with i in radians.
std::array<uint32_t, kBlock> Sines() {
  std::array<uint32_t, kBlock> sines;
  for (size_t i = 0; i < kBlock; ++i) {
    sines[i] = static_cast<uint32_t>(std::floor(std::fabs(std::sin(double(i + 1))) * 4294967296.0));
  }
  return sines;
}

void Digest(const uint8_t* block, State* state) {
  static const std::array<uint32_t, kBlock> sines = Sines();
  constexpr int kShifts[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
  uint32_t words[16];
  for (size_t i = 0; i < 16; ++i) {
    words[i] = uint32_t{block[4 * i]} | uint32_t{block[4 * i + 1]} << 8 |
               uint32_t{block[4 * i + 2]} << 16 | uint32_t{block[4 * i + 3]} << 24;
  }
  auto [a, b, c, d] = *state;
  for (size_t i = 0; i < kBlock; ++i) {
    const size_t round = i / 16;
    const uint32_t mixed[4] = {(b & c) | (~b & d), (d & b) | (~d & c), b ^ c ^ d, c ^ (b | ~d)};
    const size_t word[4] = {i, 5 * i + 1, 3 * i + 5, 7 * i};
    const uint32_t sum = a + mixed[round] + sines[i] + words[word[round] % 16];
    a = d;
    d = c;
    c = b;
    b += RotateLeft(sum, kShifts[round][i % 4]);
  }
  *state = {(*state)[0] + a, (*state)[1] + b, (*state)[2] + c, (*state)[3] + d};
}

}  // namespace

std::string Md5(const std::string& text) {
  // Pad the text to whole blocks with a 1 bit, 0 bits, and the length of the text in bits.
  std::string padded = text + '\x80';
  while (padded.size() % kBlock != kBlock - 8) padded += '\0';
  for (int i = 0; i < 8; ++i) {
    padded += static_cast<char>(uint64_t{text.size()} * 8 >> (8 * i) & 255);
  }
  State state = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  for (size_t at = 0; at < padded.size(); at += kBlock) {
    Digest(reinterpret_cast<const uint8_t*>(padded.data()) + at, &state);
  }
  std::string digits;
  for (int i = 0; i < 32; ++i) {  // bytes from low to high, and digits from high to low
    digits += "0123456789ABCDEF"[state[size_t(i / 8)] >> (4 * ((i % 8) ^ 1)) & 15];
  }
  return digits;
}

}  // namespace starfocus
