// SPDX-License-Identifier: Apache-2.0
// Draws values from the bytes of a fuzzer.
#ifndef STARFOCUS_TESTS_FUZZ_INPUT_H_
#define STARFOCUS_TESTS_FUZZ_INPUT_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace starfocus::fuzz {

// Ends the process, which reports a failure of the target, unless `holds` is true.
inline void Must(bool holds) {
  if (!holds) std::abort();
}

// Reads the bytes of an input, and zeros after the end of the input.
class Input {
 public:
  Input(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  bool empty() const { return size_ == 0; }
  size_t size() const { return size_; }
  const uint8_t* data() const { return data_; }

  void Bytes(void* to, size_t count) {
    const size_t given = count < size_ ? count : size_;
    if (given != 0) std::memcpy(to, data_, given);
    std::memset(static_cast<uint8_t*>(to) + given, 0, count - given);
    Skip(given);
  }
  void Skip(size_t count) {
    if (count == 0) return;
    data_ += count;
    size_ -= count;
  }
  template <class T>
  T Value() {
    T value;
    Bytes(&value, sizeof(value));
    return value;
  }
  // Returns an integer in [low, high].
  int Int(int low, int high) {
    return low + static_cast<int>(Value<uint32_t>() % static_cast<uint32_t>(high - low + 1));
  }
  // Returns a real number in [low, high].
  double Real(double low, double high) {
    return low + (high - low) * (Value<uint16_t>() / 65535.0);
  }
  bool Rarely() { return Value<uint8_t>() >= 0xf8; }

 private:
  const uint8_t* data_;
  size_t size_;
};

}  // namespace starfocus::fuzz

#endif  // STARFOCUS_TESTS_FUZZ_INPUT_H_
