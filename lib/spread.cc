#include "lib/spread.h"

#include <cstring>

namespace starfocus {
namespace {

using simd::kMaxSpread;
using simd::SpreadTaps;

constexpr int kCellBits = 2;                  // fractional bits of the table's cells
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

// Copies pixels [begin, end) with the first and last repeated kMaxSpread times.
void CopySurface(const uint8_t* rgb, int32_t begin, int32_t end, uint8_t* surface) {
  for (int32_t k = 0; k < kMaxSpread; ++k) std::memcpy(surface + 3 * k, rgb + 3 * begin, 3);
  std::memcpy(surface + 3 * kMaxSpread, rgb + 3 * begin, 3 * static_cast<size_t>(end - begin));
  for (int32_t k = 0; k < kMaxSpread; ++k) {
    std::memcpy(surface + 3 * (kMaxSpread + end - begin + k), rgb + 3 * (end - 1), 3);
  }
}

// Writes the pixels of one surface, stretch by stretch of one cell, from the line's end on.
class SurfaceSpreader {
 public:
  SurfaceSpreader(const simd::Kernels& kernels, const uint8_t* rgb, uint8_t* surface, uint8_t* out)
      : kernels_(kernels), rgb_(rgb), surface_(surface), out_(out) {}

  void Begin(int32_t begin, int32_t end) {
    begin_ = begin;
    at_ = done_ = end_ = end;
    cell_ = 0;
    copied_ = false;
  }
  // Pixels from `begin` to the last ones added have this cell.
  void Add(int32_t begin, int32_t cell) {
    if (cell != cell_) {
      Flush();
      cell_ = cell;
    }
    at_ = begin;
  }
  // Done up to the last pixels added.
  void Flush() {
    if (cell_ > kOneCell && at_ < end_) {
      if (!copied_) CopySurface(rgb_, begin_, end_, surface_);
      copied_ = true;
      kernels_.spread(surface_ + 3 * (kMaxSpread + at_ - begin_), kTaps.of[cell_],
                      3 * static_cast<size_t>(done_ - at_), out_ + 3 * at_);
    }
    done_ = at_;
  }

 private:
  const simd::Kernels& kernels_;
  const uint8_t* rgb_;
  uint8_t *surface_, *out_;
  int32_t begin_ = 0, end_ = 0;  // of the surface
  int32_t at_ = 0, done_ = 0;    // pixels [at_, done_) wait
  int32_t cell_ = 0;
  bool copied_ = false;
};

}  // namespace

SpreadTaps SpreadTapsOf(int32_t cell) { return kTaps.of[IndexOf(cell)]; }

void SpreadLine(const simd::Kernels& kernels, const ViewGrid& grid, const Line& line,
                const Run* runs, int32_t count, uint8_t* surface, uint8_t* out) {
  const int64_t cell_move = grid.Move(1);
  // Cells of a run's pixels are within this of its middle's.
  const auto slack = static_cast<int32_t>(
      RoundShift(cell_move * (grid.spread / 2 + 1), kStepBits + kDisparityBits - kShiftBits) + 2);
  SurfaceSpreader spreader(kernels, line.rgb, surface, out);
  for (int32_t k = 0, end = line.length; k < count; end = runs[k++].begin) {
    const int32_t surface_end = runs[k].surface_end;
    if (end == surface_end) {
      int32_t last = k;
      while (last + 1 < count && runs[last + 1].surface_end == surface_end) ++last;
      spreader.Begin(runs[last].begin, end);
    }
    const int32_t lowest = IndexOf(Max(0, runs[k].cell - slack));
    const int32_t highest = IndexOf(runs[k].cell + slack);
    if (lowest == highest || highest <= kOneCell) {
      spreader.Add(runs[k].begin, lowest);
    } else {
      // Pixel by pixel: where runs end depends on the direction they are found in. Neighbours
      // mostly have one disparity, or at least one cell.
      int32_t before = line.disparity[(end - 1) * line.step];
      const auto cell_of = [&](int32_t disparity) {
        return IndexOf(Abs(grid.Shift(cell_move, disparity)));
      };
      int32_t cell = cell_of(before);
      for (int32_t next = end - 1; --next >= runs[k].begin;) {
        const int32_t disparity = line.disparity[next * line.step];
        if (disparity == before) continue;
        before = disparity;
        const int32_t next_cell = cell_of(disparity);
        if (next_cell == cell) continue;
        spreader.Add(next + 1, cell);
        cell = next_cell;
      }
      spreader.Add(runs[k].begin, cell);
    }
    if (k + 1 == count || runs[k + 1].surface_end != surface_end) spreader.Flush();
  }
}

}  // namespace starfocus
