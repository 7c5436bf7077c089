// starfocus-bench-micro: every kernel on every SIMD target, and what surrounds them, beside a
// memcpy of the same size, in bytes read and written per second.
#include "tests/bench/micro.h"

#include <benchmark/benchmark.h>

#include <cstring>
#include <string>
#include <vector>

#include "simd/kernels.h"

namespace {

using starfocus::simd::Kernels;
using starfocus::simd::kPadding;
using starfocus::simd::kRunLanes;
using starfocus::simd::Span;

constexpr size_t kSamples = 3 * 1024;  // of a line
constexpr size_t kSpan = 96;           // samples: surfaces of 32 pixels
constexpr size_t kMargin = 64;

// Cells of all planes side by side: 6 rows with 2 cells around 2 of them.
constexpr int32_t kAround = 2;
constexpr size_t kCellStride = 36, kCellRows = 6;
static_assert(kCellStride * kCellRows * starfocus::simd::kCellPlanes <= kSamples);

struct Buffers {
  std::vector<uint8_t> bytes, line;
  std::vector<uint32_t> sums;
  std::vector<int16_t> in, out;
  std::vector<float> disparity;
  std::vector<Span> spans;
  std::vector<uint16_t> starts, edges;  // of runs
  std::vector<int16_t> middles;
  std::vector<starfocus::simd::StepBits> steps;
  std::vector<uint8_t> distances;  // to depth edges: none

  explicit Buffers(bool pairs)
      : bytes(kSamples + 2 * kMargin + kPadding),
        line(bytes.size()),
        sums(bytes.size(), 1 << 20),
        in(bytes.size()),
        out(bytes.size()),
        disparity(bytes.size(), 1.5f),
        starts(bytes.size()),
        edges(bytes.size()),
        middles(bytes.size()),
        steps(bytes.size()),
        distances(bytes.size()) {
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = uint8_t(i * 37);
    for (size_t i = 0; i < in.size(); ++i) in[i] = int16_t(i * 61 % 16320);
    for (size_t i = 0; i < kSamples; i += kSpan) {
      const auto neighbour = uint16_t(pairs ? 100 : 0);
      spans.push_back({bytes.data() + kMargin + i, uint32_t(i), uint32_t(kSpan),
                       uint16_t(256 - neighbour), neighbour, 3});
    }
  }

  starfocus::simd::CellPlanes Cells() const {
    return {in.data() + kAround * (kCellStride + 1), kCellStride * kCellRows, kCellStride};
  }
};

// A square of kSamples samples: lines side by side, and pixels to transpose.
constexpr size_t kLines = 48, kLength = kSamples / kLines;
static_assert(kLines % kRunLanes == 0);
constexpr size_t kRows = 32, kColumns = kSamples / 3 / kRows;

constexpr starfocus::simd::HalfBand kTaps = {8192, 4096, 0};
// A box of 3.5 pixels.
constexpr starfocus::simd::SliceTaps kSliceTaps = {2, 9362, 18724, 4682};
// A slice of 6 rows of 4 planes; tiles of as many samples, and 5 views of two of them.
constexpr size_t kPlane = kSamples / 4 / 6;
constexpr size_t kTileRows = kSamples / 4 / starfocus::simd::kSliceLanes;
constexpr size_t kSliceViews = 5;
constexpr size_t kStackPlane = 256;
static_assert(7 * kStackPlane <= kSamples);
static_assert(kPlane % starfocus::simd::kSliceLanes == 0);
// Radius 3.2 or so: weights need not sum to anything for their time.
constexpr uint16_t kDiscWeights[15] = {900, 900, 900, 880, 880, 860, 700, 690,
                                       600, 300, 100, 90,  40,  0,   0};
constexpr starfocus::simd::Disc kDisc = {4, 16, kDiscWeights};
using Body = void (*)(const Kernels&, Buffers*);

// The nearer slice covers half a pixel.
void Composite(const Kernels& kernels, Buffers* b) {
  const int16_t weights[kSliceViews] = {9000, 9000, 9000, 9000, 9000};
  uint8_t near[kTileRows];
  std::memset(near, 1, sizeof(near));
  const uint8_t shown[2] = {0, 1};
  starfocus::simd::SliceOffset offsets[2 * kSliceViews];
  for (size_t n = 0; n < 2 * kSliceViews; ++n) {
    const auto back = static_cast<int16_t>(-3000 * static_cast<int>(n / 2));
    offsets[n] = {0, {back, back, 0, 0}};
  }
  const starfocus::simd::TileSlice slices[2] = {{b->in.data(), near, kSamples / 4},
                                                {b->in.data() + 8, near, kSamples / 4}};
  kernels.Composite({weights, offsets, kSliceViews, slices, 2, shown, 2, 0}, kTileRows,
                    b->sums.data());
}

// Of 128 pixels, a quarter lie 15 units before the others and hide them at their left, for views at
// half distance to look at as well.
void LookBehind(const Kernels& kernels, Buffers* b) {
  using starfocus::simd::kSliceLanes;
  int16_t disparity[kPlane + 2 * kSliceLanes] = {};
  uint8_t left[kPlane] = {};
  for (size_t n = kSliceLanes; n < kPlane; ++n) {
    if (n % 16 >= 4) continue;
    left[n] = uint8_t(n % 16 + 1);
    disparity[kSliceLanes + n] = 15 << 6;
  }
  const uint8_t* none = b->distances.data();
  starfocus::simd::DepthRow row = {};
  row.disparity = disparity + kSliceLanes;
  row.width = kPlane;
  row.high = 15 << 6;
  row.unit_bits = 6;
  row.side_views = row.half_views = true;
  for (int side = 0; side < 4; ++side) row.edges[side] = side == 1 ? left : none;
  uint16_t found[2][kPlane / kSliceLanes];
  const starfocus::simd::HiddenRow hidden = {{b->out.data(), b->out.data() + kPlane},
                                             {b->starts.data(), b->edges.data()},
                                             {found[0], found[1]},
                                             b->line.data()};
  for (size_t n = 0; n < kSamples / kPlane; ++n) {
    benchmark::DoNotOptimize(kernels.LookBehind(row, hidden));
  }
}

struct Case {
  const char* name;
  bool pairs;
  size_t bytes;  // read and written per sample
  Body body;
};

const Case kCases[] = {
    {"accumulate", false, 1 + 8,
     [](const Kernels& k, Buffers* b) {
       k.Accumulate(b->spans.data(), b->spans.size(), b->sums.data());
     }},
    {"accumulate_pairs", true, 1 + 8,
     [](const Kernels& k, Buffers* b) {
       k.Accumulate(b->spans.data(), b->spans.size(), b->sums.data());
     }},
    {"blend", true, 1 + 1,
     [](const Kernels& k, Buffers* b) {
       k.Blend(b->spans.data(), b->spans.size(), b->line.data());
     }},
    // Over the same lines, so that each stays in the cache for those around it.
    {"disc", false, 1 + 1,
     [](const Kernels& k, Buffers* b) {
       for (size_t n = 0; n < kSamples; n += kSpan) {
         k.FilterDisc(b->bytes.data() + kMargin + kSpan * 4, kSpan, kDisc, 1, kSpan, b->line.data(),
                      kSpan);
       }
     }},
    {"split", false, 1 + 1,
     [](const Kernels& k, Buffers* b) {
       k.Split(b->bytes.data(), kSamples / 3, kSamples / 3, b->line.data());
     }},
    {"find_edges", false, 2 + 2 + 2 * 4 + 1,
     [](const Kernels& k, Buffers* b) {
       k.FindEdges(b->in.data(), b->in.data() + 1, {48, 6}, kSamples, b->out.data(),
                   b->middles.data(), b->line.data());
     }},
    {"find_ranges", false, 2,
     [](const Kernels& k, Buffers* b) {
       starfocus::simd::DisparityRange ranges[kPlane / starfocus::simd::kSliceLanes];
       for (size_t n = 0; n < kSamples; n += 8 * kPlane) {
         k.FindRanges(b->in.data() + n, kPlane, 8, kPlane, ranges);
         benchmark::DoNotOptimize(ranges);
       }
     }},
    {"find_within", false, 2,
     [](const Kernels& k, Buffers* b) {
       uint16_t within[8];
       for (size_t n = 0; n < kSamples; n += 8 * starfocus::simd::kSliceLanes) {
         k.FindWithin(b->in.data() + n, starfocus::simd::kSliceLanes, 8, {2000, 9000}, within);
         benchmark::DoNotOptimize(within);
       }
     }},
    {"find_steps", false, 2,
     [](const Kernels& k, Buffers* b) {
       k.FindSteps(b->in.data(), kSamples, 20000, b->steps.data());
     }},
    {"beside_steps", false, 2,
     [](const Kernels& k, Buffers* b) {
       k.BesideSteps(b->in.data() + kMargin, 8, kSamples, 20000, b->starts.data());
     }},
    {"look_behind", false, 2 + 4 + 2 * 2 + 1, LookBehind},
    {"interpolate", false, 1 + 1 + 1,
     [](const Kernels& k, Buffers* b) {
       constexpr size_t kPixels = starfocus::simd::kSliceLanes;
       const uint8_t* bytes = b->bytes.data();
       for (size_t n = 0; n < kSamples; n += 3 * kPixels) {
         k.Interpolate(bytes + n, bytes + n + 3, bytes, kSamples / 3, b->line.data() + n / 3);
       }
     }},
    {"select_slice", false, 3 * (2 + 3) / 4 + 1 + 2,
     [](const Kernels& k, Buffers* b) {
       const int16_t* in = b->in.data();
       const uint8_t* rgb = b->bytes.data();
       const starfocus::simd::SurfaceRow row = {
           {in, in + 16, in + 32}, {rgb, rgb, rgb}, rgb, kPlane, ~uint64_t{0}};
       for (size_t n = 0; n < 6; ++n) {
         benchmark::DoNotOptimize(k.SelectSlice(row, {2000, 8000, 9000}, kPlane, kPlane,
                                                b->out.data() + 4 * n * kPlane));
       }
     }},
    {"spread_slice", false, 2 + 2,
     [](const Kernels& k, Buffers* b) {
       k.SpreadSlice(b->in.data() + kMargin, 1, kSliceTaps, kSamples, b->out.data());
     }},
    {"shift_slice", false, 2 + 2,
     [](const Kernels& k, Buffers* b) {
       uint8_t near[kTileRows + starfocus::simd::kRowsAhead];
       k.ShiftSlice({b->in.data(), starfocus::simd::kSliceLanes}, {-9000, -9000, 0, 0}, kTileRows,
                    kSamples / 4, b->out.data(), near + starfocus::simd::kRowsAhead);
       benchmark::DoNotOptimize(near);
     }},
    // Of each view and slice.
    {"composite", false, 2 * kSliceViews * 2 + 8, Composite},
    // Again and again, to as many samples as the others.
    {"finish_composite", false, 4 * 4 / 3 + 4,
     [](const Kernels& k, Buffers* b) {
       for (size_t n = 0; n < kSamples; n += 3 * kStackPlane) {
         k.FinishComposite(b->sums.data(), kStackPlane, b->bytes.data(), {1000, 16}, kStackPlane,
                           b->sums.data() + 4 * kStackPlane);
       }
     }},
    {"find_runs", false, 2 + 2,
     [](const Kernels& k, Buffers* b) {
       k.FindRuns(b->in.data(), kLines, kLength, kLines, {2000, 12000},
                  {b->starts.data(), b->edges.data(), b->middles.data(), kLines});
     }},
    // Cells of 64 pixels in rows of 8 cells; of all that is read, the cells alone count.
    {"measure_cell", false, 2,
     [](const Kernels& k, Buffers* b) {
       constexpr size_t kStride = 64;
       for (size_t cell = 0; cell < kSamples / 64; ++cell) {
         const int16_t* rows[10];
         for (size_t y = 0; y < 10; ++y) rows[y] = b->in.data() + 1 + y * kStride + cell % 7 * 8;
         starfocus::simd::CellMeasure measure;
         k.MeasureCell(rows, {4000, 12000, 2000, 4000}, &measure);
         benchmark::DoNotOptimize(measure);
       }
     }},
    // Of each cell's planes; whatever they hold.
    {"reach_block", false, 2 * starfocus::simd::kCellPlanes / 4,
     [](const Kernels& k, Buffers* b) {
       constexpr int16_t kMargins[3] = {0, 4, 12};
       for (size_t block = 0; block < kSamples / 4; ++block) {
         starfocus::simd::BlockReach reach;
         k.ReachBlock(b->Cells(), kAround, kMargins, &reach);
         benchmark::DoNotOptimize(reach);
       }
     }},
    {"surround_cells", false, 2 * 4 + 2 * 4,
     [](const Kernels& k, Buffers* b) {
       for (size_t n = 0; n < kSamples; n += 32) {
         int16_t ranges[3][32];
         uint16_t widest[32];
         k.SurroundCells(b->Cells(), kAround, 32, {ranges[0], ranges[1], widest, ranges[2]});
         benchmark::DoNotOptimize(ranges);
       }
     }},
    {"transpose", false, 1 + 1,
     [](const Kernels& k, Buffers* b) {
       k.Transpose(b->bytes.data(), 3 * kColumns, kRows, kColumns, b->line.data(), 3 * kRows);
     }},
    {"finish", false, 4 + 1,
     [](const Kernels& k, Buffers* b) { k.Finish(b->sums.data(), kSamples, 24, b->line.data()); }},
    {"convert_disparity", false, 4 + 2,
     [](const Kernels& k, Buffers* b) {
       benchmark::DoNotOptimize(
           k.ConvertDisparity(b->disparity.data(), kSamples, -8, 8, b->out.data()));
     }},
    {"widen_phases", false, 1 + 2,
     [](const Kernels& k, Buffers* b) {
       k.WidenPhases(b->bytes.data(), kSamples / 6, b->out.data(), b->middles.data());
     }},
    {"split_phases", false, 2 + 2,
     [](const Kernels& k, Buffers* b) {
       k.SplitPhases(b->in.data(), kSamples / 6, b->out.data(), b->middles.data());
     }},
    {"narrow", false, 2 + 1,
     [](const Kernels& k, Buffers* b) { k.Narrow(b->in.data(), kSamples, b->line.data()); }},
    {"finish_layer", false, 4 + 2,
     [](const Kernels& k, Buffers* b) {
       k.FinishLayer(b->sums.data(), kSamples, 24, b->out.data());
     }},
    {"half_band", false, 2 + 2,
     [](const Kernels& k, Buffers* b) {
       k.FilterHalfBand(b->in.data() + kMargin, 3, kTaps, kSamples, 0, 16320, b->out.data());
     }},
    {"halve", false, 2 + 2 + 2,
     [](const Kernels& k, Buffers* b) {
       const int16_t* in = b->in.data() + kMargin;
       k.Halve(in, in, kTaps, kSamples, b->out.data());
     }},
    {"between", false, 2 + 2,
     [](const Kernels& k, Buffers* b) {
       k.Between(b->in.data() + kMargin, 3, kTaps, kSamples, 0, 16320, b->out.data());
     }},
};

// Whoever adds a kernel adds its case; accumulate has two.
static_assert(sizeof(Kernels) ==
                  sizeof(const char*) + (sizeof(kCases) / sizeof(kCases[0]) - 1) * sizeof(Body),
              "a case for every kernel");

void Register(const Kernels* kernels) {
  for (const Case& one : kCases) {
    const std::string name = std::string(one.name) + "/" + kernels->name;
    benchmark::RegisterBenchmark(name.c_str(), [kernels, &one](benchmark::State& state) {
      Buffers buffers(one.pairs);
      for (auto _ : state) {
        one.body(*kernels, &buffers);
        // Sums grow with every pass; their overflow changes no time.
        benchmark::ClobberMemory();
      }
      state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(kSamples * one.bytes));
    });
  }
}

// Reads and writes half of the bytes each.
void RegisterCopies() {
  for (const size_t bytes : {2, 3, 4, 5, 6, 9}) {
    const std::string name = "memcpy/" + std::to_string(bytes) + "_bytes_per_sample";
    benchmark::RegisterBenchmark(name.c_str(), [bytes](benchmark::State& state) {
      const size_t count = kSamples * bytes / 2;
      std::vector<uint8_t> from(count, 1), to(count);
      for (auto _ : state) {
        std::memcpy(to.data(), from.data(), count);
        benchmark::ClobberMemory();
      }
      state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(2 * count));
    });
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const Kernels* kernels = nullptr;
  for (size_t i = 0; (kernels = starfocus::simd::KernelsOfTarget(i)) != nullptr; ++i) {
    Register(kernels);
    starfocus::bench::RegisterLineScan(kernels);
    starfocus::bench::RegisterWholePictures(kernels->name);
  }
  Register(&starfocus::simd::ReferenceKernels());
  starfocus::bench::RegisterLineScan(&starfocus::simd::ReferenceKernels());
  starfocus::bench::RegisterDeblocking();
  RegisterCopies();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
