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

// Bytes of the numbers at the start of a configuration. The fuzzer does not select pointers, which
// must be valid.
inline constexpr size_t kNumbersOfConfig = offsetof(starfocus_config, tuning);

// Writes arbitrary bytes into one field of the first `size` bytes in a few cases.
inline void SpoilRarely(Input* input, void* fields, size_t size) {
  if (!input->Rarely()) return;
  const int field = input->Int(0, static_cast<int>(size / 4) - 1);
  input->Bytes(static_cast<uint8_t*>(fields) + 4 * field, 4);
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

// Returns the workspace of a small picture, or null if it is too large for a quick run.
inline std::unique_ptr<void, void (*)(void*)> TakeWorkspace(const test::Config& config,
                                                            size_t bytes) {
  const bool small = int64_t{config.width} * config.height <= 20000 && bytes <= size_t{300} << 20;
  if (!small) return {nullptr, std::free};
  return TakeMemory(bytes);
}

// Returns an engine in `workspace`. The configuration has been accepted before.
inline starfocus_engine* Started(const test::Config& config, void* workspace, size_t bytes) {
  starfocus_engine* engine = nullptr;
  Must(starfocus_init(&config, workspace, bytes, &engine, nullptr) == STARFOCUS_OK);
  return engine;
}

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
