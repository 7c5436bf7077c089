#include "lib/spread.h"

#include <cstring>

namespace starfocus {
namespace {

using simd::kMaxSpread;
using simd::SpreadTaps;

constexpr int kCellBits = 3;                  // fractional bits of the table's cells
constexpr int32_t kOneCell = 1 << kCellBits;  // a pixel
constexpr int32_t kLargestCell = (2 * kMaxSpread + 1) * kOneCell;

// What a box of L pixels, 2 k - 1 < L <= 2 k + 1, covers of the pixels around it. Linear
// interpolation makes it wider still by the variance of a quarter pixel or less; taps narrower by
// that, so that the variance is the box's, would let views that lie whole pixels apart show as
// stripes.
constexpr SpreadTaps MakeTaps(int32_t cell) {
  int32_t k = 1;
  while ((2 * k + 1) * kOneCell < cell) ++k;
  const double length = static_cast<double>(cell) / kOneCell;
  SpreadTaps taps = {};
  taps.reach = k;
  taps.outer = static_cast<uint16_t>(256 * (length - (2 * k - 1)) / (2 * length) + 0.5);
  taps.inner = static_cast<uint16_t>(256 / length + 0.5);
  taps.centre = static_cast<uint16_t>(256 - 2 * taps.outer - 2 * (k - 1) * taps.inner);
  return taps;
}

struct TapTable {
  SpreadTaps of[kLargestCell + 1] = {};
  constexpr TapTable() {
    for (int32_t cell = kOneCell; cell <= kLargestCell; ++cell) of[cell] = MakeTaps(cell);
  }
};
constexpr TapTable kTaps;

// Of the taps for a cell of kShiftBits.
int32_t IndexOf(int32_t cell) {
  constexpr int kBits = kShiftBits - kCellBits;
  return Min(kLargestCell, (cell + (1 << (kBits - 1))) >> kBits);
}

struct Range {
  int16_t low, high;
};

// A loop that compilers turn into vectors.
Range RangeOf(const int16_t* values, int32_t count) {
  Range range = {values[0], values[0]};
  for (int32_t k = 1; k < count; ++k) {
    range.low = values[k] < range.low ? values[k] : range.low;
    range.high = values[k] > range.high ? values[k] : range.high;
  }
  return range;
}

// The cells of a line's pixels, from their disparities alone: runs would depend on the direction
// they are found in.
class LineCells {
 public:
  LineCells(const ViewGrid& grid, int64_t cell_move, const Line& line)
      : grid_(grid), cell_move_(cell_move), line_(line) {}

  bool AnyWide() const {
    const Range range = RangeOf(line_.disparity, line_.length);
    return Max(Index(range.low), Index(range.high)) > kOneCell;
  }
  int32_t At(int32_t x) const { return Index(line_.disparity[x]); }

  // Where the surface of pixel `begin` ends.
  int32_t SurfaceEnd(int32_t begin) const {
    const int16_t* d = line_.disparity;
    int32_t x = begin + 1;
    while (x < line_.length) {
      if (x + kChunk <= line_.length) {
        const Range range = RangeOf(d + x - 1, kChunk + 1);
        if (range.high - range.low <= kSurfaceStep) {
          x += kChunk;
          continue;
        }
      }
      const int32_t last = Min(line_.length, x + kChunk);
      for (; x < last; ++x) {
        if (Abs(d[x] - d[x - 1]) > kSurfaceStep) return x;
      }
    }
    return x;
  }

  // Where the pixels from `begin` on, up to `end`, no longer have its cell.
  int32_t CellEnd(int32_t begin, int32_t end) const {
    const int32_t cell = At(begin);
    int32_t x = begin + 1;
    while (x < end) {
      if (x + kChunk <= end && ChunkHas(x, cell)) {
        x += kChunk;
        continue;
      }
      const int32_t last = Min(end, x + kChunk);
      for (; x < last; ++x) {
        if (At(x) != cell) return x;
      }
    }
    return x;
  }

 private:
  static constexpr int32_t kChunk = 8;

  int32_t Index(int32_t disparity) const {
    return IndexOf(Abs(grid_.Shift(cell_move_, disparity)));
  }
  // On either side of the focus cells grow with the distance from it.
  bool ChunkHas(int32_t x, int32_t cell) const {
    const Range range = RangeOf(line_.disparity + x, kChunk);
    const bool one_side = range.low >= grid_.focus || range.high <= grid_.focus;
    return one_side && Index(range.low) == cell && Index(range.high) == cell;
  }

  const ViewGrid& grid_;
  int64_t cell_move_;
  const Line& line_;
};

// Copies pixels [begin, end) with the first and last repeated kMaxSpread times.
void CopySurface(const uint8_t* rgb, int32_t begin, int32_t end, uint8_t* surface) {
  for (int32_t k = 0; k < kMaxSpread; ++k) std::memcpy(surface + 3 * k, rgb + 3 * begin, 3);
  std::memcpy(surface + 3 * kMaxSpread, rgb + 3 * begin, 3 * static_cast<size_t>(end - begin));
  for (int32_t k = 0; k < kMaxSpread; ++k) {
    std::memcpy(surface + 3 * (kMaxSpread + end - begin + k), rgb + 3 * (end - 1), 3);
  }
}

}  // namespace

SpreadTaps SpreadTapsOf(int32_t cell) { return kTaps.of[IndexOf(cell)]; }

void SpreadLine(const simd::Kernels& kernels, const ViewGrid& grid, int64_t cell_move,
                const Line& line, uint8_t* surface, uint8_t* out) {
  std::memcpy(out, line.rgb, 3 * static_cast<size_t>(line.length));
  const LineCells cells(grid, cell_move, line);
  if (!cells.AnyWide()) return;
  for (int32_t begin = 0; begin < line.length;) {
    const int32_t end = cells.SurfaceEnd(begin);
    bool copied = false;
    for (int32_t x = begin; x < end;) {
      const int32_t cell_end = cells.CellEnd(x, end), cell = cells.At(x);
      if (cell > kOneCell) {
        if (!copied) CopySurface(line.rgb, begin, end, surface);
        copied = true;
        kernels.spread(surface + 3 * (kMaxSpread + x - begin), kTaps.of[cell],
                       3 * static_cast<size_t>(cell_end - x), out + 3 * x);
      }
      x = cell_end;
    }
    begin = end;
  }
}

}  // namespace starfocus
