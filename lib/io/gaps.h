// SPDX-License-Identifier: Apache-2.0
// Fills unknown disparities in lines of a depth map.
#ifndef STARFOCUS_LIB_IO_GAPS_H_
#define STARFOCUS_LIB_IO_GAPS_H_

#include <cstdint>

namespace starfocus {

// Returns true if a disparity is known, that is, neither NaN nor infinite.
inline bool IsFinite(float value) { return value - value == 0.0f; }

// Fills the elements between the known elements `left` and `right`. If `left` is -1 or `right` is
// `length`, the line has no known element on that side of the gap. A gap between two surfaces gets
// the farther disparity, because unknown values at an edge mostly belong to the surface that the
// edge hides.
template <class Line>
void FillGap(const Line& line, int32_t length, int32_t left, int32_t right) {
  if (left < 0 && right >= length) return;
  const int32_t a = left < 0 ? right : left, b = right >= length ? left : right;
  const auto farther = line[a] < line[b] ? line[a] : line[b];
  for (int32_t k = left + 1; k < right; ++k) line[k] = farther;
}

// Fills all gaps of a line of `length` elements. is_known(element) returns false in gaps. Returns
// false and leaves the line unchanged if the line has no known element.
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

#endif  // STARFOCUS_LIB_IO_GAPS_H_
