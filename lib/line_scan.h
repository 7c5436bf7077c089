// Center-based line scan (paper, IV-A): the surfaces and holes of one rendered view along a line,
// in a single pass without z-buffer.
#ifndef STARFOCUS_LIB_LINE_SCAN_H_
#define STARFOCUS_LIB_LINE_SCAN_H_

#include <cstdint>

#include "lib/fixed.h"
#include "lib/runs.h"
#include "lib/view_grid.h"

namespace starfocus {

// A line of the centre view (or of a type A view) with its disparity.
struct Line {
  const uint8_t* rgb;
  const int16_t* disparity;
  int32_t length;
};

// One view of a line and the part of it that is wanted.
struct LineView {
  const ViewGrid* grid;
  int64_t move;       // ViewGrid::Move of the view's distance along the line
  int64_t cell;       // ViewGrid::Move(1): the width of the aperture cell
  int32_t out_begin;  // rendered pixels [out_begin, out_end), out_begin < out_end
  int32_t out_end;
};

// A gap wider than this is no stretched surface, whatever the disparities say, in pixels.
inline constexpr int32_t kMaxStretch = 4;

// 2^23 / cell, rounded, for cells of [0, kShiftOne]; 0 at 0, where no neighbour counts.
struct CellReciprocals {
  uint32_t of[kShiftOne + 1] = {};
  constexpr CellReciprocals() {
    for (uint32_t cell = 1; cell <= kShiftOne; ++cell) of[cell] = ((1u << 23) + cell / 2) / cell;
  }
};
inline constexpr CellReciprocals kCellReciprocals;

// Weight of the neighbour (kShiftBits) in the aperture cell of width `cell` (kShiftBits) for a
// sample `offset` away from its pixel's centre: clamp((|t| - 1/2) / L + 1/2, 0, 1) of the
// aperture cell, L <= 1.
inline int32_t CellWeight(int32_t offset, int32_t cell) {
  const int32_t twice = 2 * Abs(offset) - kShiftOne + cell;  // <= cell
  if (twice <= 0) return 0;
  const uint32_t scaled = static_cast<uint32_t>(twice) * kCellReciprocals.of[cell];
  return static_cast<int32_t>(Checked(ranges::kCellWeight, (scaled + (1u << 15)) >> 16));
}

// Scans `line` for one view. Calls, in pixels of the line (never mirrored),
//   sink.Surface(begin, end, source, neighbour, weight): rendered pixel p is line pixel
//     source + (p - begin), and its neighbour at +-1 with `weight` (kShiftBits);
//   sink.Hole(begin, end, disparity, pixel): uncovered; what is behind continues with
//     `disparity`, that of the visible line pixel `pixel`.
// Every pixel of [out_begin, out_end) comes exactly once, in scan order.
template <Direction kDirection, class Sink>
class LineScan {
 public:
  LineScan(const Line& line, const Run* runs, int32_t count, const LineView& view, Sink* sink)
      : line_(line), runs_(runs), count_(count), view_(view), sink_(sink) {
    begin_ = kMirrored ? line.length - view.out_end : view.out_begin;
    end_ = kMirrored ? line.length - view.out_begin : view.out_end;
    last_pixel_ = line.length - 1;
  }

  void Scan() {
    int32_t end = line_.length;
    // From the line's own end, not the wanted part's: what a gap borders on may lie beyond.
    last_ = Max(end_, end - Whole(view_.grid->Shift(view_.move, runs_[0].disparity)));
    for (int32_t index = 0; index < count_ && last_ > begin_; ++index) {
      const int32_t begin = runs_[index].begin;
      ScanRun(begin, end, runs_[index].disparity);
      end = begin;
    }
    if (last_ > begin_) Hole(begin_, last_pixel_);
  }

 private:
  static constexpr bool kMirrored = kDirection == Direction::kLeftToRight;

  int32_t Pixel(int32_t q) const { return kMirrored ? line_.length - 1 - q : q; }
  int32_t Disparity(int32_t q) const { return line_.disparity[Pixel(q)]; }

  bool SameSurface(int32_t q) const {  // of positions q and q + 1
    return q >= 0 && q + 1 < line_.length && Abs(Disparity(q) - Disparity(q + 1)) <= kSurfaceStep;
  }

  bool OneSurface(int32_t begin, int32_t end) const {  // of positions [begin, end)
    for (int32_t q = begin; q + 1 < end; ++q) {
      if (!SameSurface(q)) return false;
    }
    return true;
  }

  static int32_t Whole(int32_t shift) { return (shift + kShiftOne / 2) >> kShiftBits; }

  // Positions [begin, end) move together; last_ is the lowest position filled so far, so whatever
  // lands at or above it is hidden.
  void ScanRun(int32_t begin, int32_t end, int32_t disparity) {
    const int32_t shift = view_.grid->Shift(view_.move, disparity);
    const int32_t whole = Whole(shift);
    const int32_t low = begin - whole;
    if (low >= last_) return;
    if (low < end_) {
      if (end - whole < last_) CloseGap(end - 1, whole);
      SurfaceOfRun(Max(low, begin_), end - whole, disparity, shift);
    }
    last_ = low;
    last_pixel_ = begin;
  }

  // Emits positions from `first` to what is filled; those from `own_end` on stretch the run over
  // source pixels beyond it, one by one where they belong to several surfaces.
  void SurfaceOfRun(int32_t first, int32_t own_end, int32_t disparity, int32_t shift) {
    int32_t end = Min(last_, end_);
    if (first >= end) return;
    const int32_t whole = Whole(shift);
    const int32_t offset = shift - whole * kShiftOne;
    const int32_t width = Min(Abs(view_.grid->Shift(view_.cell, disparity)), kShiftOne);
    const int32_t own = Max(first, own_end);
    if (own < end && !OneSurface(own + whole - 1, end + whole)) {
      for (; end > own; --end) Surface(end - 1, end, whole, offset, width);
    }
    if (first < end) Surface(first, end, whole, offset, width);
  }

  // Between this run's last pixel `q` and what is filled lies a gap: a stretched surface, which
  // the run then covers, or a hole.
  void CloseGap(int32_t q, int32_t whole) {
    const int32_t gap = q + 1 - whole;
    const bool nearer = Disparity(q) - Disparity(last_pixel_) > kSurfaceStep;
    if (!nearer && last_ - gap <= kMaxStretch && last_ + whole <= line_.length) return;
    Hole(Max(gap, begin_), Disparity(q) < Disparity(last_pixel_) ? q : last_pixel_);
    last_ = gap;
  }

  void Hole(int32_t begin, int32_t q) {
    const int32_t end = Min(last_, end_);
    if (begin >= end) return;
    if (kMirrored) {
      sink_->Hole(line_.length - end, line_.length - begin, Disparity(q), Pixel(q));
    } else {
      sink_->Hole(begin, end, Disparity(q), q);
    }
  }

  // Emits [begin, end) of a surface at `whole` pixels and `offset` (kShiftBits) beyond; a pixel
  // beside a depth edge has no neighbour across it.
  void Surface(int32_t begin, int32_t end, int32_t whole, int32_t offset, int32_t width) {
    const int32_t weight = CellWeight(offset, width);
    const int32_t side = offset > 0 ? 1 : -1;
    int32_t first = begin;
    if (weight != 0 && side < 0 && !SameSurface(begin + whole - 1)) ++first;
    if (weight != 0 && side > 0 && !SameSurface(end - 1 + whole)) {
      Emit(end - 1, end, whole, side, 0);
      --end;
    }
    if (first < end) Emit(first, end, whole, side, weight);
    if (begin < first) Emit(begin, first, whole, side, 0);
  }

  void Emit(int32_t begin, int32_t end, int32_t whole, int32_t side, int32_t weight) {
    if (kMirrored) {
      const int32_t first = line_.length - end;
      sink_->Surface(first, line_.length - begin, first - whole, -side, weight);
    } else {
      sink_->Surface(begin, end, begin + whole, side, weight);
    }
  }

  const Line& line_;
  const Run* runs_;
  int32_t count_;
  const LineView& view_;
  Sink* sink_;
  int32_t begin_;  // wanted positions [begin_, end_)
  int32_t end_;
  int32_t last_;        // lowest position filled so far
  int32_t last_pixel_;  // the line position that filled it
};

template <class Sink>
void ScanLine(const Line& line, Direction direction, const Run* runs, int32_t count,
              const LineView& view, Sink* sink) {
  if (direction == Direction::kRightToLeft) {
    LineScan<Direction::kRightToLeft, Sink>(line, runs, count, view, sink).Scan();
  } else {
    LineScan<Direction::kLeftToRight, Sink>(line, runs, count, view, sink).Scan();
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_H_
