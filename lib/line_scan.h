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
  ptrdiff_t step;  // from one pixel's disparity to the next one's
  int32_t length;
};

// One view of a line and the part of it that is wanted.
struct LineView {
  const ViewGrid* grid;
  int64_t move;       // ViewGrid::Move of the view's distance along the line
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
      : line_(line),
        runs_(runs),
        runs_end_(runs + count),
        view_(view),
        sink_(sink),
        begin_(kMirrored ? line.length - view.out_end : view.out_begin),
        end_(kMirrored ? line.length - view.out_begin : view.out_end) {}

  void Scan() const {
    // From the line's own end, not the wanted part's: what a gap borders on may lie beyond.
    Filled filled = {Max(end_, line_.length - Whole(Shift(*runs_))), line_.length - 1};
    int32_t run_end = line_.length;
    for (const Run* run = runs_; run != runs_end_ && filled.from > begin_; ++run) {
      const int32_t shift = Shift(*run), begin = run->begin, low = begin - Whole(shift);
      if (low < filled.from) {
        if (low < end_) AddRun(run, run_end, shift, filled);
        filled = {low, begin};
      }
      run_end = begin;
    }
    if (filled.from > begin_) Hole(begin_, filled.from, filled.pixel);
  }

 private:
  static constexpr bool kMirrored = kDirection == Direction::kLeftToRight;

  // The lowest position filled so far, and the line position that filled it: whatever lands at or
  // above it is hidden.
  struct Filled {
    int32_t from, pixel;
  };

  int32_t Pixel(int32_t q) const { return kMirrored ? line_.length - 1 - q : q; }
  int32_t Disparity(int32_t q) const { return line_.disparity[Pixel(q) * line_.step]; }
  int32_t Shift(const Run& run) const { return view_.grid->Shift(view_.move, run.disparity); }
  static int32_t Whole(int32_t shift) { return (shift + kShiftOne / 2) >> kShiftBits; }

  // The run's positions up to `run_end` move together. Emits those that are not hidden, up to what
  // is filled; positions beyond the run's own stretch it over source pixels beyond it.
  void AddRun(const Run* run, int32_t run_end, int32_t shift, const Filled& filled) const {
    const int32_t whole = Whole(shift);
    int32_t end = filled.from;
    if (run_end - whole < end) end = CloseGap(run_end - 1, whole, filled);
    end = Min(end, end_);
    const int32_t first = Max(run->begin - whole, begin_);
    if (first >= end) return;
    const int32_t offset = shift - whole * kShiftOne;
    const int32_t weight = CellWeight(offset, Min(run->cell, kShiftOne));
    if (weight == 0) {
      Emit(first, end, whole, 1, 0);
    } else if (end + whole > run->surface_end) {
      const int32_t own = Max(first, run_end - whole);
      AddBeyondSurface(own, end, whole, offset, weight);
      if (first < own) AddBlended(*run, first, own, whole, offset, weight, run + 1 == runs_end_);
    } else {
      AddBlended(*run, first, end, whole, offset, weight, run + 1 == runs_end_);
    }
  }

  // Positions [first, end) with their neighbours; a pixel beside a depth edge has none across it.
  void AddBlended(const Run& run, int32_t first, int32_t end, int32_t whole, int32_t offset,
                  int32_t weight, bool is_last) const {
    if (offset > 0) {
      const bool alone = end + whole == run.surface_end;
      if (alone) Emit(end - 1, end, whole, 1, 0);
      if (first < end - alone) Emit(first, end - alone, whole, 1, weight);
    } else {
      const bool alone =
          first + whole == run.begin && (is_last || (&run)[1].surface_end == run.begin);
      if (first + alone < end) Emit(first + alone, end, whole, -1, weight);
      if (alone) Emit(first, first + 1, whole, -1, 0);
    }
  }

  // A stretch over another surface: pixels one by one.
  void AddBeyondSurface(int32_t own, int32_t end, int32_t whole, int32_t offset,
                        int32_t weight) const {
    const int32_t side = offset > 0 ? 1 : -1;
    for (; end > own; --end) {
      const int32_t q = end - 1 + whole;
      Emit(end - 1, end, whole, side, SameSurface(side < 0 ? q - 1 : q) ? weight : 0);
    }
  }

  bool SameSurface(int32_t q) const {  // of positions q and q + 1
    return q >= 0 && q + 1 < line_.length && Abs(Disparity(q) - Disparity(q + 1)) <= kSurfaceStep;
  }

  // Between a run's last pixel `q` and what is filled lies a gap: a stretched surface, which the
  // run then covers, or a hole. Returns where the run ends.
  int32_t CloseGap(int32_t q, int32_t whole, const Filled& filled) const {
    const int32_t gap = q + 1 - whole;
    const int32_t step = Disparity(q) - Disparity(filled.pixel);
    const bool stretched = step <= kSurfaceStep && filled.from - gap <= kMaxStretch &&
                           filled.from + whole <= line_.length;
    if (stretched) return filled.from;
    Hole(Max(gap, begin_), filled.from, step < 0 ? q : filled.pixel);
    return gap;
  }

  // What goes on there is the surface of position q.
  void Hole(int32_t begin, int32_t end, int32_t q) const {
    end = Min(end, end_);
    if (begin >= end) return;
    if (kMirrored) {
      sink_->Hole(line_.length - end, line_.length - begin, Disparity(q), Pixel(q));
    } else {
      sink_->Hole(begin, end, Disparity(q), q);
    }
  }

  void Emit(int32_t begin, int32_t end, int32_t whole, int32_t side, int32_t weight) const {
    if (kMirrored) {
      const int32_t first = line_.length - end;
      sink_->Surface(first, line_.length - begin, first - whole, -side, weight);
    } else {
      sink_->Surface(begin, end, begin + whole, side, weight);
    }
  }

  const Line& line_;
  const Run* const runs_;
  const Run* const runs_end_;
  const LineView& view_;
  Sink* const sink_;
  const int32_t begin_;  // wanted positions [begin_, end_)
  const int32_t end_;
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
