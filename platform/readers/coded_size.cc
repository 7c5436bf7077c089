// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/coded_size.h"

#include <algorithm>

#include "platform/container.h"

namespace starfocus {
namespace {

// Reads integers with a given number of bits. If a read extends past the end of the data, the
// missing bits are zero and good() returns false.
class Bits {
 public:
  explicit Bits(Span bytes) : bytes_(bytes) {}

  bool good() const { return at_ <= 8 * bytes_.size; }
  uint32_t Read(int count) {
    uint32_t value = 0;
    for (int k = 0; k < count; ++k, ++at_) {
      const uint32_t byte = at_ < 8 * bytes_.size ? bytes_.data[at_ / 8] : 0u;
      value = value << 1 | (byte >> (7 - at_ % 8) & 1);
    }
    return value;
  }
  void Skip(size_t count) { at_ += count; }
  // Reads an exponential Golomb code (23008-2, 9.2), which equals AV1's uvlc().
  uint32_t ReadGolomb() {
    int zeros = 0;
    while (good() && zeros < 32 && Read(1) == 0) ++zeros;
    return zeros < 32 ? (1u << zeros) - 1 + Read(zeros) : UINT32_MAX;
  }

 private:
  const Span bytes_;
  size_t at_ = 0;
};

void Widen(int64_t width, int64_t height, CodedSize* most) {
  most->width = std::max(most->width, width);
  most->height = std::max(most->height, height);
}

// Returns an HEVC NAL unit without its emulation prevention bytes.
Bytes Unescape(Span unit) {
  Bytes bytes;
  size_t zeros = 0;
  for (size_t k = 0; k < unit.size; ++k) {
    if (zeros >= 2 && unit.data[k] == 3) {
      zeros = 0;
      continue;
    }
    zeros = unit.data[k] == 0 ? zeros + 1 : 0;
    bytes.push_back(unit.data[k]);
  }
  return bytes;
}

// Reads an HEVC sequence parameter set (23008-2, 7.3.2.2) as far as the picture size.
void ReadParameterSet(Span unit, CodedSize* most) {
  constexpr int kSequenceSet = 33;
  if (unit.size < 2 || (unit.data[0] >> 1 & 63) != kSequenceSet) return;
  unit.size = std::min(unit.size, size_t{512});
  const Bytes bytes = Unescape(unit);
  Bits bits({bytes.data(), bytes.size()});
  bits.Skip(16 + 4);
  const uint32_t layers = bits.Read(3);  // Number of temporal sub-layers minus 1.
  bits.Skip(1 + 88 + 8);                 // Skips flags, profile and level.
  size_t more = 0;
  for (uint32_t k = 0; k < layers; ++k) {
    if (bits.Read(1) != 0) more += 88;
    if (bits.Read(1) != 0) more += 8;
  }
  if (layers > 0) bits.Skip(2 * (8 - layers));
  bits.Skip(more);
  bits.ReadGolomb();                         // Skips the identifier of the parameter set.
  if (bits.ReadGolomb() == 3) bits.Skip(1);  // Skips the flag for separate colour planes.
  const uint32_t own_width = bits.ReadGolomb(), own_height = bits.ReadGolomb();
  if (bits.good()) Widen(own_width, own_height, most);
}

// Reads an AV1 sequence header (AV1 specification, 5.5.1) as far as the picture size.
void ReadSequenceHeader(Span header, CodedSize* most) {
  Bits bits(header);
  bits.Skip(3 + 1);
  if (bits.Read(1) != 0) {
    bits.Skip(5);  // Skips the level of a still picture.
  } else {
    bool model = false;
    uint32_t delay_bits = 0;
    if (bits.Read(1) != 0) {  // Timing.
      bits.Skip(64);
      if (bits.Read(1) != 0) bits.ReadGolomb();
      model = bits.Read(1) != 0;
      if (model) {
        delay_bits = bits.Read(5) + 1;
        bits.Skip(32 + 5 + 5);
      }
    }
    const bool delay = bits.Read(1) != 0;
    const uint32_t points = bits.Read(5) + 1;
    for (uint32_t k = 0; k < points; ++k) {
      bits.Skip(12);
      if (bits.Read(5) > 7) bits.Skip(1);
      if (model && bits.Read(1) != 0) bits.Skip(2 * size_t{delay_bits} + 1);
      if (delay && bits.Read(1) != 0) bits.Skip(4);
    }
  }
  const int width_bits = static_cast<int>(bits.Read(4)) + 1;
  const int height_bits = static_cast<int>(bits.Read(4)) + 1;
  const int64_t own_width = int64_t{bits.Read(width_bits)} + 1;
  const int64_t own_height = int64_t{bits.Read(height_bits)} + 1;
  if (bits.good()) Widen(own_width, own_height, most);
}

// Reads open bitstream units (AV1 specification, 5.3). Each open bitstream unit has a header, an
// optional size in LEB128, and a payload.
void ReadUnits(Span units, CodedSize* most) {
  constexpr int kSequenceHeader = 1;
  while (units.size >= 2) {
    const uint8_t first = units.data[0];
    const bool extended = (first & 4) != 0, sized = (first & 2) != 0;
    size_t at = extended ? 2 : 1, size = units.size - std::min(units.size, at);
    if (sized) {
      size = 0;
      for (int shift = 0; at < units.size && shift < 28; shift += 7) {
        const uint8_t byte = units.data[at++];
        size |= size_t{byte & 127u} << shift;
        if (byte < 128) break;
      }
    }
    if (at > units.size) return;
    const size_t held = std::min(size, units.size - at);  // `units` may end within the last unit.
    if ((first >> 3 & 15) == kSequenceHeader) {
      ReadSequenceHeader({units.data + at, held}, most);
    }
    units = {units.data + at + held, units.size - at - held};
  }
}

}  // namespace

// `configuration` is the property hvcC: 22 bytes, followed by arrays of NAL units (14496-15,
// 8.3.3.1).
CodedSize HevcSize(Span configuration, const Bytes& head) {
  CodedSize most;
  constexpr size_t kArrays = 22;
  const Span all = configuration;
  size_t at = kArrays + 1;
  const int arrays = all.size > kArrays ? all.data[kArrays] : 0;
  for (int k = 0; k < arrays && at + 3 <= all.size; ++k) {
    const int units = all.data[at + 1] * 256 + all.data[at + 2];
    at += 3;
    for (int i = 0; i < units && at + 2 <= all.size; ++i) {
      const size_t size = size_t{all.data[at]} * 256 + all.data[at + 1];
      at += 2;
      if (size > all.size - at) return most;
      ReadParameterSet({all.data + at, size}, &most);
      at += size;
    }
  }
  for (size_t from = 0; from + 4 < head.size();) {  // A 4-byte size precedes each NAL unit.
    const size_t size = ReadBigEndian32(&head[from]);
    from += 4;
    const size_t held = std::min(size, head.size() - from);
    ReadParameterSet({head.data() + from, held}, &most);
    from += held;
  }
  return most;
}

CodedSize Av1Size(Span configuration, const Bytes& head) {
  CodedSize most;
  constexpr size_t kUnits = 4;
  if (configuration.size > kUnits) {
    ReadUnits({configuration.data + kUnits, configuration.size - kUnits}, &most);
  }
  ReadUnits({head.data(), head.size()}, &most);
  return most;
}

}  // namespace starfocus
