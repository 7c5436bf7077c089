#include "lib/runs.h"

#include "lib/fixed.h"

namespace starfocus {

int32_t FindRuns(const int16_t* disparity, int32_t length, Direction direction, int32_t spread,
                 Run* runs) {
  const bool mirrored = direction == Direction::kLeftToRight;
  const int16_t* next = mirrored ? disparity : disparity + length - 1;
  const int32_t step = mirrored ? 1 : -1;
  int32_t count = 0;
  int32_t low = *next, high = *next;
  for (int32_t q = length - 1; q > 0; --q) {
    next += step;
    const int32_t d = *next;
    const int32_t new_low = Min(low, d), new_high = Max(high, d);
    if (new_high - new_low > spread) {
      runs[count++] = {static_cast<uint16_t>(q), static_cast<int16_t>((low + high) >> 1)};
      low = high = d;
    } else {
      low = new_low;
      high = new_high;
    }
  }
  runs[count++] = {0, static_cast<int16_t>((low + high) >> 1)};
  return count;
}

}  // namespace starfocus
