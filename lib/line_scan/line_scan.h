// SPDX-License-Identifier: Apache-2.0
// Center-based line scan (paper, IV-A). A scan finds the surfaces and holes of a rendered view
// along a line in a single pass without z-buffer, and passes them to a sink. Also defines the
// memory of the renderer that scans lines (triangles.cc), and separates boundary pixels
// (lib/matting/mixed_pixels.h) before they are scanned (unmix.cc).
#ifndef STARFOCUS_LIB_LINE_SCAN_LINE_SCAN_H_
#define STARFOCUS_LIB_LINE_SCAN_LINE_SCAN_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/io/block_pixels.h"
#include "lib/io/input.h"
#include "lib/optics/view_grid.h"
#include "lib/plan/renderer.h"
#include "simd/kernels.h"

namespace starfocus {

// A run of equal disparity along a line: positions [begin, end). Runs are found once per line and
// shared by all views of the line. `end` equals `begin` of the previous run in scan order.
struct Run {
  uint16_t begin;
  // End of the surface that the run belongs to: the next depth edge or the end of the line.
  uint16_t surface_end;
  int16_t disparity;     // Middle of the range of the run's disparities, kDisparityBits.
  uint16_t subaperture;  // Width of the run's subaperture r / N, kShiftBits.
};

// Scan order of a line. Views to the right of the centre or below the centre are scanned from the
// right end, because nearer surfaces move in from that end. Views to the left of the centre or
// above the centre are mirrored.
enum class Direction { kRightToLeft, kLeftToRight };

// Sizes of the arrays of RunMarks: `starts` and `edges` have RunMarkWords elements, and `middles`
// has RunMiddles elements.
constexpr size_t RunMarkStride(size_t lines) {
  return (lines + simd::kRunLanes - 1) / simd::kRunLanes * simd::kRunLanes;
}
constexpr size_t RunMarkWords(size_t length, size_t lines) {
  return (length + 15) / 16 * RunMarkStride(lines);
}
constexpr size_t RunMiddles(size_t length, size_t lines) { return length * RunMarkStride(lines); }

// Spread of a run, which is a sequence of adjacent pixels: largest difference between the shifts of
// the pixels, in pixels (kShiftBits). Rendering a run with one shift misplaces the pixels of the
// run by at most half the spread, in any view. Halving the spread brings no improvement
// (docs/constants.md).
inline constexpr int32_t kRunDrift = kShiftOne / 4;

// Returns the largest disparity range of a run, kDisparityBits. A run covers a range of at most
// kRunDrift / (u_t / 2^layer), and ends at every depth edge.
int16_t RunRange(const ViewGrid& grid);

// Returns the largest |i| of the views whose holes are filled from the captured views at half
// distance, if the light field has `views` views.
int32_t HalfViews(const ViewGrid& grid, int32_t views);

// Splits adjacent lines into runs whose disparities vary by at most `range`, greedily in scan
// order. Position q of line k is disparity[q * step + k]; `length` is in [1, 65535]. Sets
// marks->stride. The arrays of `marks` must have room for the lines, and the disparities must be
// followed by simd::kPadding bytes.
void MarkRuns(const simd::LineScanKernels& kernels, int16_t range, const int16_t* disparity,
              ptrdiff_t step, int32_t length, int32_t lines, Direction direction,
              simd::RunMarks* marks);

// Reads the runs of line k in scan order, from high positions to low positions. With kLeftToRight,
// positions are mirrored: position q is pixel length - 1 - q. `subaperture_move` is
// ViewGrid::Move(1). Writes at most `length` runs and returns the number of runs.
int32_t ReadRuns(const simd::RunMarks& marks, int32_t k, int32_t length, const ViewGrid& grid,
                 int64_t subaperture_move, Run* runs);

// A line of the centre view or of a type A view, with its disparities and its runs in scan order.
struct Line {
  const int16_t* rgb;  // light
  const int16_t* disparity;
  ptrdiff_t step;  // distance in samples between the disparities of neighbouring pixels
  int32_t length;
  const Run* runs;
  int32_t run_count;
};

// Widest gap in pixels that may be a stretched surface, regardless of the disparities.
// A comparison of kMaxStretch with twice and half its value is in docs/constants.md.
inline constexpr int32_t kMaxStretch = 4;

// Rounded values of 2^23 / subaperture, for subapertures in [0, kShiftOne]. The value for a
// subaperture of 0 is 0, which gives neighbours no weight.
struct SubapertureReciprocals {
  uint32_t of[kShiftOne + 1] = {};
  constexpr SubapertureReciprocals() {
    for (uint32_t subaperture = 1; subaperture <= kShiftOne; ++subaperture)
      of[subaperture] = ((1u << 23) + subaperture / 2) / subaperture;
  }
};
inline constexpr SubapertureReciprocals kSubapertureReciprocals;

// Returns the weight of the neighbouring pixel (simd::kBlendBits) for a sample whose distance from
// the centre of its own pixel is t = `offset`. The weight is clamp((|t| - 1/2) / L + 1/2, 0, 1). L
// = `subaperture` is the width of the subaperture in kShiftBits, at most one pixel.
inline int32_t SubapertureWeight(int32_t offset, int32_t subaperture) {
  const int32_t twice = 2 * Abs(offset) - kShiftOne + subaperture;  // <= subaperture
  if (twice <= 0) return 0;
  const uint32_t scaled = static_cast<uint32_t>(twice) * kSubapertureReciprocals.of[subaperture];
  return static_cast<int32_t>(Checked(ranges::kSubapertureWeight, (scaled + (1u << 9)) >> 10));
}

// Scans a line for several views. The scan calls the following functions of the sink, with
// positions in pixels of the line that are never mirrored.
//
// sink.Surface(begin, end, source, neighbour, weight): rendered pixel p shows line pixel q = source
// + (p - begin), and with `weight` (simd::kBlendBits) line pixel q + neighbour; `neighbour` is +-1.
//
// sink.Mix(p, source, other, weight): rendered pixel p shows line pixel `source`. A part of p,
// `weight` (kShiftBits), shows line pixel `other`, which lies in front of `source` or behind
// `source`.
//
// sink.Hole(begin, end, pixel, rim, covered): rendered pixels [begin, end) are uncovered. Pixels of
// a hole show the surface of the visible line pixel `pixel`, which continues into the hole. If
// `rim` is not -1, the end of the surface that the line pixel `rim` shows covers the part `covered`
// (kShiftBits) of the hole's outermost pixel on the side where the scan continues.
//
// Each required pixel is passed exactly once, in scan order.
template <Direction kDirection, class Sink>
class LineScan {
 public:
  // `part` are the required pixels of the rendered lines; at least one pixel is required.
  LineScan(const Line& line, const Range& part, const ViewGrid& grid, Sink* sink)
      : line_(line),
        runs_end_(line.runs + line.run_count),
        grid_(grid),
        sink_(sink),
        begin_(kMirrored ? line_.length - part.last : part.first),
        end_(kMirrored ? line_.length - part.first : part.last) {}

  // `move` is ViewGrid::Move of the distance of the view along the line.
  void Scan(int64_t move) {
    move_ = move;
    edge_ = {nullptr, 0, 0};
    // The scan starts at the end of the line, because the surface next to a gap may lie outside the
    // required part.
    filled_from_ = Max(end_, line_.length - Whole(Shift(*line_.runs)));
    filled_pixel_ = line_.length - 1;
    int32_t run_end = line_.length;
    for (const Run* run = line_.runs; run != runs_end_; ++run) {
      if (filled_from_ <= begin_ && !AwaitsBehind()) break;
      const int32_t shift = Shift(*run), begin = run->begin, whole = Whole(shift);
      const int32_t low = begin - whole;
      if (low < filled_from_) {
        if (low >= end_) {
          // A run outside the required part may still cover a part of the last required pixel.
          edge_ = {EndsAtEdge(run) ? run : nullptr, shift - whole * kShiftOne, whole};
        } else if (IsPlain(run, run_end, whole)) {
          const int32_t offset = shift - whole * kShiftOne;
          Emit(Max(low, begin_), Min(filled_from_, end_), whole, offset > 0 ? 1 : -1,
               SubapertureWeight(offset, Min(run->subaperture, kShiftOne)));
        } else {
          AddRun(run, run_end, shift);
        }
        filled_from_ = low;
        filled_pixel_ = begin;
      }
      run_end = begin;
    }
    FlushEdge();
    if (filled_from_ > begin_) Hole(begin_, filled_from_, filled_pixel_, -1, 0);
  }

 private:
  static constexpr bool kMirrored = kDirection == Direction::kLeftToRight;

  int32_t Pixel(int32_t q) const { return kMirrored ? line_.length - 1 - q : q; }
  int32_t Disparity(int32_t q) const { return line_.disparity[Pixel(q) * line_.step]; }
  int32_t Shift(const Run& run) const { return grid_.Shift(move_, run.disparity); }
  static int32_t Whole(int32_t shift) { return (shift + kShiftOne / 2) >> kShiftBits; }

  // Lower end of the last added run, if a farther surface follows. If a run ends between two
  // rendered pixels, the run covers only a part of its last pixel.
  struct Edge {
    const Run* run;  // null: there is no such run
    // Offset from a rendered pixel, kShiftBits. If the offset is negative, the run leaves the part
    // -offset of its last pixel uncovered, and this pixel is mixed later. If the offset is
    // positive, the run covers the part `offset` of the next pixel.
    int32_t offset;
    int32_t whole;
  };

  // Returns true if another surface follows below the run.
  bool EndsAtEdge(const Run* run) const {
    return run + 1 != runs_end_ && run[1].surface_end == run->begin;
  }

  // Returns true if the last required pixel has not yet been mixed with the surface behind the
  // edge.
  bool AwaitsBehind() const {
    return filled_from_ == begin_ && edge_.run != nullptr && edge_.offset < 0;
  }

  // Returns true if the visible part of a run is inside one surface and not next to a gap. Most
  // runs meet this condition.
  bool IsPlain(const Run* run, int32_t run_end, int32_t whole) const {
    const int32_t begin = run->begin, end = Min(filled_from_, end_);
    const bool inside = begin - whole < begin_ || (run + 1 != runs_end_ && !EndsAtEdge(run));
    return inside && run_end - whole >= filled_from_ && edge_.run == nullptr &&
           end + whole < run->surface_end;
  }

  // Adds a run, whose positions [run->begin, run_end) have one shift. Emits the positions of the
  // run below the filled position. If a gap above the run belongs to a stretched surface, the run
  // also fills the gap.
  [[gnu::noinline]] void AddRun(const Run* run, int32_t run_end, int32_t shift) {
    const int32_t whole = Whole(shift);
    const int32_t offset = shift - whole * kShiftOne;
    int32_t end = filled_from_;
    if (run_end - whole < end) {
      FlushEdge();
      end = CloseGap(run_end - 1, whole, offset);
    } else if (edge_.run != nullptr) {
      end = CoverEdge(*run, run_end, whole, end);
    }
    end = Min(end, end_);
    int32_t first = Max(run->begin - whole, begin_);
    edge_ = {EndsAtEdge(run) ? run : nullptr, offset, whole};
    if (edge_.run != nullptr && offset < 0 && first + whole == run->begin) {
      if (first < end) {
        ++first;
      } else {
        edge_.offset = 0;
      }
    }
    if (first >= end) return;
    const int32_t weight = SubapertureWeight(offset, Min(run->subaperture, kShiftOne));
    if (weight == 0) {
      Emit(first, end, whole, 1, 0);
    } else if (end + whole > run->surface_end) {
      const int32_t own = Max(first, run_end - whole);
      AddBeyondSurface(own, end, whole, offset, weight);
      if (first < own) AddBlended(*run, first, own, whole, offset, weight);
    } else {
      AddBlended(*run, first, end, whole, offset, weight);
    }
  }

  // Mixes the edge with the run behind the edge, which is visible up to `end`. Returns the end of
  // the visible part after mixing.
  int32_t CoverEdge(const Run& run, int32_t run_end, int32_t whole, int32_t end) {
    const Edge edge = edge_;
    if (edge.run->disparity - run.disparity <= kSurfaceStep) {
      FlushEdge();
      return end;
    }
    edge_.run = nullptr;
    const int32_t at_edge = edge.run->begin;
    if (edge.offset < 0) {
      if (end >= begin_ && end < end_)
        Mix(end, at_edge, Min(end + whole, run_end - 1), -edge.offset);
    } else if (edge.offset > 0 && end - 1 < end_ && end - 1 >= Max(begin_, run.begin - whole)) {
      Mix(end - 1, end - 1 + whole, at_edge, edge.offset);
      return end - 1;
    }
    return end;
  }

  // Ends the edge without mixing it with another run. The last pixel of the edge is emitted as a
  // whole pixel.
  void FlushEdge() {
    if (edge_.run != nullptr && edge_.offset < 0) {
      const int32_t p = edge_.run->begin - edge_.whole;
      if (p >= begin_ && p < end_) Emit(p, p + 1, edge_.whole, 1, 0);
    }
    edge_.run = nullptr;
  }

  // Emits positions [first, end) with their neighbours. The pixel at the upper end of a surface has
  // no neighbour above, and the pixel at the lower end of a line has no neighbour below.
  void AddBlended(const Run& run, int32_t first, int32_t end, int32_t whole, int32_t offset,
                  int32_t weight) const {
    if (offset > 0) {
      const bool alone = end + whole == run.surface_end;
      if (alone) Emit(end - 1, end, whole, 1, 0);
      if (first < end - alone) Emit(first, end - alone, whole, 1, weight);
    } else {
      const bool alone = first + whole == 0;
      if (first + alone < end) Emit(first + alone, end, whole, -1, weight);
      if (alone) Emit(first, first + 1, whole, -1, 0);
    }
  }

  // Stretches the run over another surface, pixel by pixel.
  void AddBeyondSurface(int32_t own, int32_t end, int32_t whole, int32_t offset,
                        int32_t weight) const {
    const int32_t side = offset > 0 ? 1 : -1;
    for (; end > own; --end) {
      const int32_t q = end - 1 + whole;
      Emit(end - 1, end, whole, side, SameSurface(side < 0 ? q - 1 : q) ? weight : 0);
    }
  }

  bool SameSurface(int32_t q) const {  // true if q and q + 1 are on one surface
    return q >= 0 && q + 1 < line_.length && Abs(Disparity(q) - Disparity(q + 1)) <= kSurfaceStep;
  }

  // Closes the gap between the last pixel `q` of a run and the filled position. The gap is either a
  // stretched surface, which the run then covers, or a hole. Returns the end of the run. A nearer
  // run may end between pixels. The pixel that the run covers in part then belongs to the hole, and
  // the run is the rim of the hole.
  int32_t CloseGap(int32_t q, int32_t whole, int32_t offset) const {
    const int32_t gap = q + 1 - whole;
    const int32_t step = Disparity(q) - Disparity(filled_pixel_);
    const bool stretched = step <= kSurfaceStep && filled_from_ - gap <= kMaxStretch &&
                           filled_from_ + whole <= line_.length;
    if (stretched) return filled_from_;
    if (step <= kSurfaceStep) {
      Hole(Max(gap, begin_), filled_from_, step < 0 ? q : filled_pixel_, -1, 0);
      return gap;
    }
    const int32_t begin = offset > 0 ? gap - 1 : gap;
    const int32_t covered = offset > 0 ? kShiftOne - offset : -offset;
    const bool wanted = begin >= begin_ && covered > 0;
    Hole(Max(begin, begin_), filled_from_, filled_pixel_, wanted ? Pixel(q) : -1, covered);
    return begin;
  }

  // Emits a hole that continues the surface of position q.
  void Hole(int32_t begin, int32_t end, int32_t q, int32_t rim, int32_t covered) const {
    end = Min(end, end_);
    if (begin >= end) return;
    if (kMirrored) {
      sink_->Hole(line_.length - end, line_.length - begin, Pixel(q), rim, covered);
    } else {
      sink_->Hole(begin, end, Pixel(q), rim, covered);
    }
  }

  void Mix(int32_t p, int32_t q, int32_t other, int32_t weight) const {
    sink_->Mix(kMirrored ? line_.length - 1 - p : p, Pixel(q), Pixel(other), weight);
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
  const Run* const runs_end_;
  const ViewGrid& grid_;
  Sink* const sink_;
  const int32_t begin_;  // positions [begin_, end_) of the rendered line are required
  const int32_t end_;
  int64_t move_ = 0;
  // Lowest position of the rendered line that is filled so far, and the line position shown there.
  // Pixels that are scanned later and move to a filled position are hidden.
  int32_t filled_from_ = 0, filled_pixel_ = 0;
  Edge edge_ = {nullptr, 0, 0};
};

// Scans the pixels `part` of the rendered lines for a range of views. next(k) prepares the sink for
// view k and returns the move of this view.
template <class Sink, class Next>
void ScanLine(const Line& line, Direction direction, const Range& part, const Range& views,
              const ViewGrid& grid, Sink* sink, const Next& next) {
  if (direction == Direction::kRightToLeft) {
    LineScan<Direction::kRightToLeft, Sink> scan(line, part, grid, sink);
    for (int32_t k = views.first; k < views.last; ++k) scan.Scan(next(k));
  } else {
    LineScan<Direction::kLeftToRight, Sink> scan(line, part, grid, sink);
    for (int32_t k = views.first; k < views.last; ++k) scan.Scan(next(k));
  }
}

// Scratch memory of the renderer for one worker. E is the largest side of an extended rectangle,
// and R the largest side of a rectangle without border. The comments of the members state the
// number of elements of each buffer. Each buffer is followed by simd::kPadding bytes.
struct LineScanScratch : RendererScratch {
  const simd::LineScanKernels* kernels;
  // Light of the field and of the transposed field: E rows of RgbStride(E) each.
  int16_t* block_rgb[2];
  int16_t* block_disparity[2];  // Disparities of both fields: E^2 each.
  int16_t* diagonal_rgb;        // Light of a diagonal line: 3 E.
  int16_t* diagonal_disparity;  // Disparities of this line: E.
  int64_t* moves;               // ViewGrid::Move of views 0 to N along an axis: N + 1.
  simd::RunMarks marks;         // Marks of the runs of E lines with E positions each.
  Run* runs;                    // Runs of all lines of a field: E^2.
  int32_t* run_counts;          // Number of runs of each line: E.
  Run* line_runs;               // Runs of one line: E.
  int16_t* strip_rgb;           // Type A lines before they are transposed: 3 R kRowsAtOnce.
  int16_t* view_disparity;      // Disparities of the type A view, one line per row: R E.
  int16_t* columns_rgb;   // Light of the type A view, one line per column: R rows of RgbStride(E).
  uint32_t* column_sums;  // Sums of the pass over rows, in column order: 3 R^2.
  uint32_t* line_accumulators;  // Accumulators of one line: 3 E.
  simd::Span* spans;            // Spans of a SpanList: kSpanCapacity.
  int16_t* holes;               // Colours of holes that these spans show: hole_samples.
  size_t hole_samples;          // 6 E, at least the samples of one line.
};
inline constexpr size_t kSpanCapacity = 512;

// Removes the nearer surface from adjacent pixels of a sharp farther surface, if the nearer surface
// is more defocused. Without this removal, the nearer surface's part of mixed pixels would remain
// sharp, and would outline an object that the blur has dissolved. The colour of the far surface
// comes from a captured side view in which the nearer surface does not cover the far surface.
// Pixels that are not mixtures of both colours are not changed.
//
// The field must come from LoadBlock. Pixels outside the picture and the outermost pixels, which do
// not splat into the rectangle, are not changed. Only layer 0 requires UnmixEdges, because
// subsampled layers are sufficiently blurred.
void UnmixEdges(const simd::Kernels& kernels, const Input& input, const ViewGrid& grid,
                BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_LINE_SCAN_H_
