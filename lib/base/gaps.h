// SPDX-License-Identifier: Apache-2.0
// Gaps in lines of disparities, where the map does not know them.
#ifndef STARFOCUS_LIB_BASE_GAPS_H_
#define STARFOCUS_LIB_BASE_GAPS_H_

#include <cstdint>

namespace starfocus {

// Tells whether a disparity is known: neither NaN nor infinite.
inline bool IsFinite(float value) { return value - value == 0.0f; }

// Fills the gap (left, right) between known elements of a line; -1 and length stand for none.
// Between two, the farther surface goes on: what is unknown beside an edge is mostly what the edge
// hides.
template <class Line>
void FillGap(const Line& line, int32_t length, int32_t left, int32_t right) {
  if (left < 0 && right >= length) return;
  const int32_t a = left < 0 ? right : left, b = right >= length ? left : right;
  const auto farther = line[a] < line[b] ? line[a] : line[b];
  for (int32_t k = left + 1; k < right; ++k) line[k] = farther;
}

// Fills the gaps of a line of `length` elements, of which is_known(element) tells which ones are
// none. Returns whether there was a known one; else the line stays as it is.
template <class Line, class IsKnown>
bool FillGaps(const Line& line, int32_t length, const IsKnown& is_known) {
  int32_t last = -1;
  for (int32_t k = 0; k <= length; ++k) {
    if (k < length && !is_known(line[k])) continue;
    FillGap(line, length, last, k);
    if (k < length) last = k;
  }
  return last >= 0;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_GAPS_H_
