// SPDX-License-Identifier: Apache-2.0
// Draws arguments of the C ABI from the bytes of a fuzzer. Every buffer is on the heap and has
// exactly the required size, so that AddressSanitizer reports all accesses outside it.
#ifndef STARFOCUS_TESTS_FUZZ_ENGINE_INPUT_H_
#define STARFOCUS_TESTS_FUZZ_ENGINE_INPUT_H_

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>

#include "starfocus/starfocus.h"
#include "tests/fuzz/input.h"
#include "tests/support/config.h"

namespace starfocus::fuzz {

inline constexpr int kViews[] = {1, 5, 9, 17};

// Returns aligned memory for an engine, or null if the system has too little.
inline std::unique_ptr<void, void (*)(void*)> TakeMemory(size_t bytes) {
  void* memory = nullptr;
  if (posix_memalign(&memory, STARFOCUS_ALIGNMENT, bytes) != 0) memory = nullptr;
  return {memory, std::free};
}

inline void DrawDisparities(Input* input, test::Config* config) {
  const double most = input->Rarely() ? STARFOCUS_MAX_DISPARITY : 12;
  const double a = input->Real(-most, most), b = input->Real(-most, most);
  config->disparity_min = static_cast<float>(std::min(a, b));
  config->disparity_max = static_cast<float>(std::max(a, b));
}

// Writes arbitrary bytes into one field in a few cases. The fuzzer does not select pointers, which
// must be valid.
inline void SpoilRarely(Input* input, test::Config* config) {
  if (!input->Rarely()) return;
  constexpr size_t kNumbers = offsetof(starfocus_config, tuning);
  uint8_t* bytes = reinterpret_cast<uint8_t*>(static_cast<starfocus_config*>(config));
  input->Bytes(bytes + input->Int(0, static_cast<int>(kNumbers / 4) - 1) * 4, 4);
}

// Returns callbacks that cancel after at most `most` calls of progress in a few cases.
inline starfocus_callbacks DrawCallbacks(int most, Input* input) {
  static int32_t left;  // number of calls of progress before the cancellation
  starfocus_callbacks callbacks = {};
  if (!input->Rarely()) return callbacks;
  left = input->Int(0, most);
  callbacks.progress = [](void* data, int32_t, int32_t) -> int {
    return (*static_cast<int32_t*>(data))-- == 0;
  };
  callbacks.progress_data = &left;
  return callbacks;
}

// Owns rows, with up to `padding` values between them. No memory follows the last row.
template <class T>
struct Rows {
  Rows(size_t width, int32_t height, int padding, Input* input)
      : stride(width + static_cast<size_t>(input->Int(0, padding))),
        count(stride * static_cast<size_t>(height - 1) + width),
        values(new T[count]()) {}

  size_t stride, count;
  std::unique_ptr<T[]> values;
};

// Fills a picture with kStep bytes of the input, which change from one repetition to the next.
template <size_t kStep = 16>
void FillPicture(Input* input, Rows<uint8_t>* picture) {
  uint8_t step[kStep];
  input->Bytes(step, sizeof(step));
  for (size_t i = 0; i < picture->count; ++i) {
    picture->values[i] = static_cast<uint8_t>(step[i % kStep] + (i / kStep) * step[0]);
  }
}

// Fills a plane with runs of random levels.
inline void FillRuns(Input* input, Rows<uint8_t>* plane) {
  uint8_t levels[32];
  input->Bytes(levels, sizeof(levels));
  const auto length = static_cast<size_t>(input->Int(1, 40));
  for (size_t i = 0; i < plane->count; ++i) plane->values[i] = levels[i / length % 32];
}

// Returns the disparity of a level from 0 to 255.
inline float DisparityOf(const test::Config& config, uint8_t level) {
  const auto low = static_cast<float>(config.disparity_min);
  const auto high = static_cast<float>(config.disparity_max);
  return std::clamp(low + (high - low) * static_cast<float>(level) / 255.0F, low, high);
}

}  // namespace starfocus::fuzz

#endif  // STARFOCUS_TESTS_FUZZ_ENGINE_INPUT_H_
