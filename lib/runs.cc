#include "lib/runs.h"

#include "lib/fixed.h"

namespace starfocus {

namespace {

constexpr int32_t kChunk = 8;

struct Range {
  int32_t low, high;
};

// Of kChunk values; a loop that compilers turn into vectors.
Range RangeOf(const int16_t* values) {
  int16_t low = values[0], high = values[0];
  for (int32_t k = 1; k < kChunk; ++k) {
    low = values[k] < low ? values[k] : low;
    high = values[k] > high ? values[k] : high;
  }
  return {low, high};
}

}  // namespace

int32_t FindRuns(const int16_t* disparity, int32_t length, Direction direction, int32_t spread,
                 Run* runs) {
  const bool mirrored = direction == Direction::kLeftToRight;
  const int16_t* next = mirrored ? disparity : disparity + length - 1;
  const int32_t step = mirrored ? 1 : -1;
  int32_t count = 0;
  Range range = {*next, *next};
  int32_t q = length - 1;
  const auto add = [&](int32_t value) {
    const int32_t low = Min(range.low, value), high = Max(range.high, value);
    if (high - low > spread) {
      runs[count++] = {static_cast<uint16_t>(q),
                       static_cast<int16_t>((range.low + range.high) >> 1)};
      range = {value, value};
    } else {
      range = {low, high};
    }
  };
  while (q > 0) {
    if (q >= kChunk) {
      const Range chunk = RangeOf(mirrored ? next + 1 : next - kChunk);
      const Range all = {Min(range.low, chunk.low), Max(range.high, chunk.high)};
      if (all.high - all.low <= spread) {
        range = all;
        next += kChunk * step;
        q -= kChunk;
        continue;
      }
    }
    for (int32_t k = Min(kChunk, q); k > 0; --k, --q) {
      next += step;
      add(*next);
    }
  }
  runs[count++] = {0, static_cast<int16_t>((range.low + range.high) >> 1)};
  return count;
}

}  // namespace starfocus
