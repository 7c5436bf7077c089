#include "lib/spread.h"

#include <cstring>

namespace starfocus {
namespace {

using simd::kMaxSpread;
using simd::SpreadTaps;

constexpr int kCellBits = 3;  // cells of the table
constexpr int32_t kLargestCell = (2 * kMaxSpread + 1) << kCellBits;

// With L between 2 k - 1 and 2 k + 1, (1 - m) box(2 k - 1) + m box(2 k + 1) has the variance
// (L^2 - 1) / 12 for m = (L^2 - (2 k - 1)^2) / 8 k.
constexpr SpreadTaps MakeTaps(int32_t cell) {
  const int32_t one = 1 << kCellBits;
  int32_t k = 1;
  while ((2 * k + 1) * one < cell) ++k;
  const double length = static_cast<double>(cell) / one;
  const double m = (length * length - (2 * k - 1) * (2 * k - 1)) / (8.0 * k);
  SpreadTaps taps = {};
  taps.reach = k;
  taps.outer = static_cast<uint16_t>(256 * m / (2 * k + 1) + 0.5);
  taps.inner = static_cast<uint16_t>(256 * ((1 - m) / (2 * k - 1) + m / (2 * k + 1)) + 0.5);
  taps.centre = static_cast<uint16_t>(256 - 2 * taps.outer - 2 * (k - 1) * taps.inner);
  return taps;
}

struct TapTable {
  SpreadTaps of[kLargestCell + 1] = {};
  constexpr TapTable() {
    for (int32_t cell = 1 << kCellBits; cell <= kLargestCell; ++cell) of[cell] = MakeTaps(cell);
  }
};
constexpr TapTable kTaps;

// Copies pixels [begin, end) with the first and last repeated kMaxSpread times.
void CopySurface(const uint8_t* rgb, int32_t begin, int32_t end, uint8_t* surface) {
  for (int32_t k = 0; k < kMaxSpread; ++k) std::memcpy(surface + 3 * k, rgb + 3 * begin, 3);
  std::memcpy(surface + 3 * kMaxSpread, rgb + 3 * begin, 3 * static_cast<size_t>(end - begin));
  for (int32_t k = 0; k < kMaxSpread; ++k) {
    std::memcpy(surface + 3 * (kMaxSpread + end - begin + k), rgb + 3 * (end - 1), 3);
  }
}

}  // namespace

SpreadTaps SpreadTapsOf(int32_t cell) {
  return kTaps.of[Min(kLargestCell,
                      (cell + (1 << (kShiftBits - kCellBits - 1))) >> (kShiftBits - kCellBits))];
}

void SpreadLine(const simd::Kernels& kernels, const Run* runs, int32_t count, int32_t length,
                uint8_t* surface, uint8_t* rgb) {
  int32_t end = length;
  for (int32_t first = 0; first < count;) {
    // Runs [first, last) make one surface [begin, end).
    int32_t last = first, widest = 0;
    do {
      widest = Max(widest, runs[last++].cell);
    } while (last < count && runs[last].surface_end == end);
    const int32_t begin = runs[last - 1].begin;
    if (widest > kShiftOne) CopySurface(rgb, begin, end, surface);
    for (int32_t run_end = end; first < last; run_end = runs[first++].begin) {
      const int32_t at = runs[first].begin;
      if (runs[first].cell <= kShiftOne) continue;
      kernels.spread(surface + 3 * (kMaxSpread + at - begin), SpreadTapsOf(runs[first].cell),
                     3 * static_cast<size_t>(run_end - at), rgb + 3 * at);
    }
    end = begin;
  }
}

}  // namespace starfocus
