// The SIMD kernels and their contracts. kernels_ref.cc defines every result; each Highway target
// gives the same bits. Pointers need no alignment; vector types never appear here.
#ifndef STARFOCUS_SIMD_KERNELS_H_
#define STARFOCUS_SIMD_KERNELS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Kernels may read this many bytes past the end of any source, and add zero to as many bytes of
// accumulators past the end of any target: every buffer of the workspace carries this padding.
inline constexpr size_t kPadding = 64;

// A stretch of samples (R, G, B interleaved) that one source surface gives to a line:
// value[n] = weight * source[n] + neighbour_weight * source[n + neighbour_offset].
struct Span {
  const uint8_t* source;
  uint32_t target;            // first sample in the target line
  uint32_t samples;           // > 0
  uint16_t weight;            // [0, 32767]
  uint16_t neighbour_weight;  // [0, 32767]; 0: the neighbour is not read
  int32_t neighbour_offset;   // samples: whole pixels, mostly +3 or -3
};

// Layer samples are int16 with 6 fractional bits: [0, kLayerWhite] when in range.
inline constexpr int kLayerBits = 6;
inline constexpr int16_t kLayerWhite = 255 << kLayerBits;
// Filter taps have 14 fractional bits.
inline constexpr int kTapBits = 14;

// Taps of a symmetric 7-tap half-band filter at 0, +-1 and +-3 (those at +-2 are zero).
struct HalfBand {
  int32_t centre, near, far;  // |tap| <= 2^14
};

// A kernel over pixels, symmetric about both axes and diagonals: its octant 0 <= m <= n <= size at
// n (n + 1) / 2 + m. All weights together sum to 2^bits at most.
struct Disc {
  int32_t size;             // [0, kMaxDisc]
  int bits;                 // [1, 24]
  const uint16_t* weights;  // [0, 32767]
};
inline constexpr int32_t kMaxDisc = 13;

// Slices: samples of 7 fractional bits, weighted by how much of the pixel the slice covers, which
// kSliceOne is all of. Rows hold four planes side by side, `plane` samples apart: R, G, B and
// coverage. What kernels write of a row is a multiple of kSliceLanes samples, and as much is read.
inline constexpr int kSliceBits = 7;

// Shares of a pixel that a surface covers: all of it, and all of it where the surface ends beside.
inline constexpr int16_t kSliceWhole = 1 << kSliceBits;
inline constexpr uint8_t kSliceEnd = 255;

inline constexpr int16_t kSliceOne = 32767;
inline constexpr size_t kSliceLanes = 16;
constexpr size_t SliceSamples(size_t count) {
  return (count + kSliceLanes - 1) / kSliceLanes * kSliceLanes;
}

// A row of the surfaces at each pixel, the nearest first: disparities, colours in three planes, and
// how much of the pixel the first one covers (kSliceBits), the others being behind it. Where there
// are fewer, the disparity of the others is below any slice. Only of those kSliceLanes whose bit of
// `hiding` is set more than the first one is looked at: elsewhere it is all of each pixel.
inline constexpr int kSurfaces = 3;
struct SurfaceRow {
  const int16_t* disparity[kSurfaces];
  const uint8_t* rgb[kSurfaces];
  const uint8_t* share;  // [1, kSliceWhole] or kSliceEnd
  size_t plane;          // bytes
  uint64_t hiding;
};

// Disparities [low, high], and up to `overlap` >= high but for the first surface where it ends or
// covers a part of the pixel only: in two slices it would cover twice as much.
struct SliceRange {
  int16_t low, high, overlap;
};

// A symmetric filter of 2 * reach + 1 taps with 15 fractional bits: `centre`, `inner` at
// 1 .. reach - 1 and `outer` at reach. The latter are twice the tap: they weigh the mean of the
// samples on both sides.
struct SliceTaps {
  int32_t reach;  // [1, kMaxSpread]
  int16_t centre, inner, outer;
};
inline constexpr int32_t kMaxSpread = 3;

struct SlicePlanes {
  const int16_t* samples;
  size_t plane;
};

// Of each kSliceLanes samples of a row, up to 64 times: whether a slice covers some, or all of
// them.
struct SliceCover {
  uint64_t some, all;
};

// What a view sees of up to four pixels p of a slice, one after the other: p[1] + first (p[1] -
// p[0])
// + third (p[1] - p[2]) + fourth (p[2] - p[3]), where first is `inside` if p[0] is covered as p[1],
// else `edge`. All in [-1, 0] with 15 bits: 16 hold -1, but not 1. With a third one inside and edge
// are the same; without it there is no fourth.
struct SliceFraction {
  int16_t inside, edge, third, fourth;
};

// Rows of a tile that composite may read beyond the last one it adds.
inline constexpr size_t kRowsAhead = 6;

// What a row of a tile and the next kRowsAhead ones show of a slice.
enum RowsNear : uint8_t { kNothingNear, kSomethingNear, kCoveredNear };  // all of their pixels

// A slice in a tile, kSliceLanes columns of pixels whose rows follow each other in each of four
// planes, `plane` samples apart: the row that an unmoved view shows first, and the RowsNear of each
// row from there on.
struct TileSlice {
  const int16_t* samples;
  const uint8_t* near;
  size_t plane;
};

// Where a view shows a slice: moved by whole pixels, and what it sees of a row and the next ones.
struct SliceOffset {
  int32_t whole;
  SliceFraction fraction;
};

inline constexpr size_t kMaxSeen = 32;

// Views of a tile above each other. offsets[view * count + k] is where a view shows slice k of
// `slices`; those of `shown`, the nearest first, are seen.
struct SliceViews {
  const int16_t* weights;  // [0, 2^14), 58000 at most together
  const SliceOffset* offsets;
  size_t views;
  const TileSlice* slices;
  size_t count;
  const uint8_t* shown;
  size_t shown_count;  // kMaxSeen at most
  size_t row;          // the first of what is composited
};

// Lowest and highest disparity of several; low > high: there is none.
struct DisparityRange {
  int16_t low, high;
};

// From sums of slices to accumulators of weights that sum to 2^bits: pixels covered less than
// `least` take the centre view's colour.
struct CompositeFinish {
  uint32_t least;  // > 0
  int bits;        // [1, 24]
};
inline constexpr int kInverseBits = 48;

// Depth edges that hide what lies behind: steps of more than `step`, seen up to a pixel per
// 2^unit_bits of depth away.
struct EdgeLimits {
  int16_t step;
  int unit_bits;  // [6, 8]
};

// How far away the pixel beside an edge may lie, in units of disparity: the edge's far side is one
// pixel more, 255 at most, and distances that 16 bits do not hold are none.
constexpr int16_t FarthestEdge(int unit_bits) {
  const int32_t units = int32_t{254} << unit_bits;
  return static_cast<int16_t>(units < INT16_MAX ? units : INT16_MAX - 1);
}

// Between pixels of a row: bit k of falls tells whether pixel k lies nearer than the next one by
// more than a step, bit k of rises whether the next one does.
struct StepBits {
  uint16_t falls, rises;
};

// A row of a field, behind whose depth edges surfaces are looked for. Rows lie `stride` apart, with
// no disparity above `high`; kSliceLanes more samples are read before the row and behind it.
struct DepthRow {
  const int16_t* disparity;
  ptrdiff_t stride;
  int32_t width, above, below;  // pixels of the row; rows above and below it
  int16_t high;
  int unit_bits;                // of EdgeLimits
  bool side_views, half_views;  // whether there are any, and such at half distance
  const uint8_t* edges[4];      // distances to the right, left, bottom and top, as by find_edges
};

// No surface: the disparity where there are fewer than kSurfaces.
inline constexpr int16_t kNoSurface = INT16_MIN;

// Where the colour of a hidden surface is found: bit k, whether side k shows it (it is the mean of
// those), bit kSourceHalf + k whether only the view at half distance does, and above
// kSourceDistance the distance of the pixel that is repeated when no view does, else 0. 0: there is
// no surface.
inline constexpr int kSourceHalf = 4, kSourceDistance = 8;
inline constexpr int16_t kUnseen =
    256;  // added to the distance of what no view shows, for an order

// What look_behind writes of a row: the surfaces behind the first one, which pixels have them (bit
// k of found[c]: pixel c kSliceLanes + k), and what the first one covers (SurfaceRow).
struct HiddenRow {
  int16_t* disparity[kSurfaces - 1];
  uint16_t* source[kSurfaces - 1];
  uint16_t* found[kSurfaces - 1];
  uint8_t* share;
};

// When a run of a line ends, kDisparityBits of lib/fixed.h or any other scale.
struct RunLimits {
  int16_t spread;  // a run's disparities differ by at most this, [0, edge]
  int16_t edge;    // a step by more than this is a depth edge, < 32767
};

// What find_runs writes of lines side by side, `stride` apart in each row of marks; stride is a
// multiple of kRunLanes and at least the number of lines. Bit q % 16 of starts[q / 16 * stride + k]
// tells whether position q of line k starts a run, that of edges whether a depth edge lies before
// it; both are 0 at q = 0. middles[q * stride + k]: the middle, rounded down, of the lowest and
// highest disparity of the run up to q.
struct RunMarks {
  uint16_t* starts;
  uint16_t* edges;
  int16_t* middles;
  size_t stride;
};
inline constexpr size_t kRunLanes = 16;

// Bytes that transpose may write past the end of each row.
inline constexpr size_t kTransposePadding = 13;

// What measure_cell finds in 8x8 disparities and their neighbours.
struct CellMeasure {
  int16_t column_low[8], column_high[8];  // lowest and highest disparity of each column
  int16_t row_low[8], row_high[8];        // and row
  uint16_t nearest;                       // smallest |disparity - focus|
  // Lowest and highest disparity of the nearer sides of depth edges between the cell's pixels and
  // their neighbours to all sides; edge_low > edge_high: there is none.
  int16_t edge_low, edge_high;
  // Over steps from pixel to pixel inside the cell, along rows and along columns: the sum of steps
  // within a surface, each at most slope_limit; the number of depth edges; the sum of their steps,
  // each at most gap_limit.
  uint32_t slopes[2], edges[2], gaps[2];
};
struct CellLimits {
  int16_t focus;  // for nearest
  int16_t edge;   // a step by more than this is a depth edge, <= 4369: 15 steps fit 16 bits
  int16_t slope_limit, gap_limit;
};

// Cells of a picture in planes of int16, `plane` apart, with rows `stride` apart.
enum CellPlane {
  kReachLeft,  // pixels beyond a side that the cell splats, and how deep inside those lie
  kReachRight,
  kReachTop,
  kReachBottom,
  kInsideLeft,
  kInsideRight,
  kInsideTop,
  kInsideBottom,
  kReachPlane,   // pixels that its blur reaches at most: of any side
  kRadiusPlane,  // largest blur radius, and that at depth edges: 0 where there is none
  kEdgePlane,
  kLowPlane,  // disparities
  kHighPlane,
  kCellPlanes
};
struct CellPlanes {
  const int16_t* cells;  // plane 0
  size_t plane, stride;
};
inline constexpr int16_t kCellPixels = 8;

// What reaches a block of 2 x 2 cells: the largest radii of those cells and what splats into them;
// and on the sides kReachLeft, ... how far beyond it pixels lie that splat into it or the margin of
// each layer around it.
struct BlockReach {
  int16_t radius, edge;
  int16_t border[3][4];
};

// What lies around a cell: its range of disparities, the largest range of one of its cells, and the
// largest blur radius at depth edges.
struct CellRanges {
  int16_t *low, *high;
  uint16_t* widest;
  int16_t* edge;
};

struct Kernels {
  const char* name;  // of the SIMD target

  // accumulators[target + n] += value[n], for each span. No sum exceeds 2^32 - 1.
  void (*accumulate)(const Span* spans, size_t count, uint32_t* accumulators);

  // line[target + n] = value[n] / 256, halves to even, for each span; weights of a span sum to
  // 256. Rounding halves up would brighten pictures shifted by half pixels by 1/4 gray level.
  // Sources don't overlap the line. Nothing outside the spans is written.
  void (*blend)(const Span* spans, size_t count, uint8_t* line);

  // out[y][n] = (the disc's sum over in[y][n]) / 2^bits, halves up, for y < rows and n < count.
  // Strides in bytes. in and out don't overlap.
  void (*disc)(const uint8_t* in, size_t in_stride, const Disc& disc, size_t rows, size_t count,
               uint8_t* out, size_t out_stride);

  // out[c * plane + n] = rgb[3 n + c].
  void (*split)(const uint8_t* rgb, size_t count, size_t plane, uint8_t* out);

  // Goes on by one row from far to near: moved[n] and behind[n] tell how many units of disparity
  // the next edge below the far row lies away, and the disparity beyond it; they are updated to the
  // near row. distance[n]: in pixels, where the near pixel hides that, else 0. moved starts as
  // INT16_MAX.
  void (*find_edges)(const int16_t* near, const int16_t* far, const EdgeLimits& limits,
                     size_t count, int16_t* moved, int16_t* behind, uint8_t* distance);

  // Ranges of each kSliceLanes columns of rows, of those that are not INT16_MIN (no surface).
  // Whole kSliceLanes are read.
  void (*find_ranges)(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                      DisparityRange* ranges);

  // Bit k of within[row]: whether disparity[row * stride + k], k < kSliceLanes, is in the range.
  void (*find_within)(const int16_t* disparity, size_t stride, size_t rows,
                      const DisparityRange& range, uint16_t* within);

  // Steps of more than `step` after each pixel n < count of a row, by kSliceLanes of them; pixel
  // `count` is read.
  void (*find_steps)(const int16_t* row, size_t count, int16_t step, StepBits* steps);

  // Bit k of beside[c]: whether a pixel next to pixel c kSliceLanes + k < count, in its row or its
  // column, is nearer by more than `step`.
  void (*beside_steps)(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                       uint16_t* beside);

  // Behind a pixel lies what is beyond its edges: of all sides the surface of least distance, the
  // nearer one of two as far away, and then the same of what lies more than a pixel per unit from
  // that. Sides that a side view shows come before all others: where no pixel towards the side lies
  // nearer, by half a pixel per unit, and moves in the view to within 3/4 of a pixel of the place
  // behind. Shares are kSliceEnd beside an edge, else kSliceWhole. Returns of which kSliceLanes of
  // the row something is hidden; only there `source` and `found` are written. width <= 64
  // kSliceLanes.
  uint64_t (*look_behind)(const DepthRow& row, const HiddenRow& hidden);

  // Interpolates kSliceLanes pixels, each between two: out[c * plane + n] = (here[3 n + c] (256 -
  // weight[n]) + next[3 n + c] weight[n]) / 256, halves up.
  void (*interpolate)(const uint8_t* here, const uint8_t* next, const uint8_t* weight, size_t plane,
                      uint8_t* out);

  // Of the surfaces within the range, at each pixel n < count: the colour of the first one times
  // its share, plus that of the next one times the rest, and what both cover; zeros where there is
  // none. count <= 64 kSliceLanes.
  SliceCover (*select_slice)(const SurfaceRow& row, const SliceRange& range, size_t count,
                             size_t plane, int16_t* out);

  // out[n] = the taps over in[n + k step], |k| <= reach, saturated: each of them times its sample
  // or the mean of two (halves up), rounded halves up.
  void (*spread_slice)(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                       int16_t* out);

  // Moves rows by a fraction of a sample into a tile: out[n] is what is seen of in[n] and what
  // follows it, each product rounded halves up. `plane`: of the tile. Where anything of a row is
  // covered, near[row - kRowsAhead] to near[row] become kSomethingNear, and the first of them
  // kCoveredNear where all of these rows is; the others stay as they are.
  void (*shift_slice)(const SlicePlanes& in, const SliceFraction& fraction, size_t rows,
                      size_t plane, int16_t* out, uint8_t* near);

  // Adds the views of a tile to sums[(4 row + plane) kSliceLanes + n]. A slice takes of the view's
  // light what it covers, and gives as much of its colours; of the last light it gives the share
  // that is left (up to a ninth of the weight too much), as if slices beside each other covered
  // different parts of a pixel. What is seen of rows as by shift_slice; products (15 bits) are
  // rounded halves up. No sum exceeds 2^32 - 1.
  void (*composite)(const SliceViews& views, size_t rows, uint32_t* sums);

  // Colours over coverage: out[3 n + c] = sums[c * plane + n] * (2^kInverseBits / covered) in units
  // of 2^-bits, halves up and 255 at most, where covered = sums[3 * plane + n] >= least; the
  // division truncates. rgb[3 n + c] << bits elsewhere. Whole kSliceLanes are read.
  void (*finish_composite)(const uint32_t* sums, size_t plane, const uint8_t* rgb,
                           const CompositeFinish& finish, size_t count, uint32_t* out);

  // Splits lines 0 .. lines - 1 of `length` positions, greedily from position 0 on; position q of
  // line k is disparity[q * step + k].
  void (*find_runs)(const int16_t* disparity, ptrdiff_t step, size_t length, size_t lines,
                    const RunLimits& limits, const RunMarks& marks);

  // Measures the cell at rows[1] .. rows[8], columns 0 .. 7; rows[0] and rows[9] are the rows above
  // and below, and columns -1 and 8 are read as well.
  void (*measure_cell)(const int16_t* const rows[10], const CellLimits& limits,
                       CellMeasure* measure);

  // What reaches the block whose first cell is at planes.cells, from as many as `around` cells
  // away. `margins`: of the layers, ascending from 0; in margins pixels count by whole cells.
  void (*reach_block)(const CellPlanes& planes, int32_t around, const int16_t margins[3],
                      BlockReach* reach);

  // What lies around each of `count` cells of a row from planes.cells on: cells d <= around away
  // (in columns or rows, the larger) that it, or that themselves, reach (d - 1) kCellPixels and
  // more far. Whole kSliceLanes are read and written.
  void (*surround_cells)(const CellPlanes& planes, int32_t around, size_t count,
                         const CellRanges& ranges);

  // Pixel `column` of row `row` of `in` becomes pixel `row` of row `column` of `out`. Strides in
  // bytes. Up to kTransposePadding bytes past the end of each row of `out` may be written, in order
  // of the rows of `in`: a picture can be transposed in strips of a multiple of four rows.
  void (*transpose)(const uint8_t* in, size_t in_stride, size_t rows, size_t columns, uint8_t* out,
                    size_t out_stride);

  // out[n] = (accumulators[n] + 2^(shift - 1)) >> shift; shift in [1, 24]; results fit a byte.
  void (*finish)(const uint32_t* accumulators, size_t count, int shift, uint8_t* out);

  // out[n] = round-half-up(disparity[n] * 64). Returns whether every value is within [low, high];
  // when false (NaN included), out is unspecified. |low|, |high| <= 511.
  bool (*convert_disparity)(const float* disparity, size_t count, float low, float high,
                            int16_t* out);

  // Parts a line of pixels into its phases, as samples: even[3 n + c] = in[6 n + c] << 6 and
  // odd[3 n + c] = in[6 n + 3 + c] << 6, for n < pairs.
  void (*widen_phases)(const uint8_t* in, size_t pairs, int16_t* even, int16_t* odd);

  // The same of samples, which stay as they are. A sample past the end of each phase may be
  // written.
  void (*split_phases)(const int16_t* in, size_t pairs, int16_t* even, int16_t* odd);

  // out[n] = in[n] rounded to a whole number, halves to even, and clamped to a byte.
  void (*narrow)(const int16_t* in, size_t count, uint8_t* out);

  // out[n] = (accumulators[n] + 2^(shift - 7)) >> (shift - 6); shift in [7, 24].
  void (*finish_layer)(const uint32_t* accumulators, size_t count, int shift, int16_t* out);

  // out[n] = clamp((centre in[n] + near (in[n - step] + in[n + step])
  //                 + far (in[n - 3 step] + in[n + 3 step]) + 2^13) >> 14, low, high).
  void (*half_band)(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                    int16_t low, int16_t high, int16_t* out);

  // Filters a line of samples in range and keeps the even pixels, from the line's phases: as
  // half_band, saturated alone, with centre even[n] + near (odd[n - 3] + odd[n])
  // + far (odd[n - 6] + odd[n + 3]).
  void (*halve)(const int16_t* even, const int16_t* odd, const HalfBand& taps, size_t count,
                int16_t* out);

  // The odd phase of upsampling, between in[n] and in[n + step]: as half_band with
  // near (in[n] + in[n + step]) + far (in[n - step] + in[n + 2 step]) alone.
  void (*between)(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                  int16_t low, int16_t high, int16_t* out);
};

// The best target of this machine, chosen once by Highway.
const Kernels& BestKernels();
// The definition of every result, in plain C++.
const Kernels& ReferenceKernels();

// For tests and the bench, not for a run-time choice (it is slow and changes Highway's choice for
// other threads while it runs): target `index` of those compiled in and supported here, the best
// first; null past the last.
const Kernels* KernelsOfTarget(size_t index);
// The one of that name; null when there is none.
const Kernels* FindKernels(const char* name);

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_KERNELS_H_
