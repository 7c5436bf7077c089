// SPDX-License-Identifier: Apache-2.0
// Measures parts of the engine that call kernels: the line scan, deblocking and whole pictures.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "examples/lab/bench/micro.h"
#include "examples/lab/bench/timed_engine.h"
#include "lib/line_scan/line_scan.h"
#include "starfocus/experimental.h"
#include "tests/support/inside.h"

namespace starfocus::bench {
namespace {

constexpr int kPixels = 1024, kSurface = 32;  // Pixels per line and per surface.
constexpr int kSide = 256;                    // Width and height of the pictures, pixels.
constexpr int kViewNumber = 4;                // N of the aperture.

// A sink of the line scan that only counts pixels.
struct Ignore {
  int64_t pixels = 0;
  template <class... More>
  void Surface(int32_t begin, int32_t end, More...) {
    pixels += end - begin;
  }
  template <class... More>
  void Hole(int32_t begin, int32_t end, More...) {
    pixels += end - begin;
  }
  template <class... More>
  void Mix(More...) {
    ++pixels;
  }
};

// Returns the disparity of slanted surfaces that are separated by depth edges. The blur radius is
// below 5 pixels.
int16_t DisparityAt(int x) { return int16_t((x / kSurface * 5 % 9 - 4) * 64 + x % kSurface * 2); }

// Scans one line for all views on the horizontal axis, including the search for runs. Counts the
// bytes of disparities that are read, once per view. The scan does not copy any pixels.
void ScanLines(const simd::LineScanKernels& kernels, benchmark::State& state) {
  std::vector<int16_t> rgb(3 * kPixels, 128);
  std::vector<int16_t> disparity(kPixels + simd::kPadding);
  for (int x = 0; x < kPixels; ++x) disparity[size_t(x)] = DisparityAt(x);
  std::vector<Run> runs(kPixels);
  std::vector<uint16_t> starts(RunMarkWords(kPixels, 1)), edges(starts.size());
  std::vector<int16_t> middles(RunMiddles(kPixels, 1));
  simd::RunMarks marks = {starts.data(), edges.data(), middles.data(), 0};
  ViewWeights aperture;
  aperture.n = kViewNumber;
  const ViewGrid grid = MakeViewGrid(aperture, {}, 1, 0);
  Line line = {rgb.data(), disparity.data(), 1, kPixels, runs.data(), 0};
  for (auto _ : state) {
    Ignore ignore;
    for (const Direction direction : {Direction::kRightToLeft, Direction::kLeftToRight}) {
      MarkRuns(kernels, RunRange(grid), disparity.data(), 1, kPixels, 1, direction, &marks);
      line.run_count = ReadRuns(marks, 0, kPixels, grid, grid.Move(1), runs.data());
      ScanLine(line, direction, {0, kPixels}, {1, kViewNumber + 1}, grid, &ignore,
               [&](int32_t i) { return grid.Move(i); });
    }
    benchmark::DoNotOptimize(ignore.pixels);
  }
  state.SetBytesProcessed(int64_t(state.iterations()) * 2 * kViewNumber * kPixels * 2);
}

// Deblocks a chequerboard of layers, in which every boundary is filtered. Counts the bytes of two
// reads and two writes of the picture.
void Deblock(benchmark::State& state) {
  constexpr int kSmallestBlocks = kSide / 16;
  std::vector<uint8_t> layers(size_t(kSmallestBlocks * (kSmallestBlocks + 1))),
      picture(size_t(3 * kSide * kSide));
  for (size_t i = 0; i < layers.size(); ++i) {
    layers[i] = uint8_t((i % kSmallestBlocks + i / kSmallestBlocks) % STARFOCUS_LAYERS);
  }
  for (size_t i = 0; i < picture.size(); ++i) picture[i] = uint8_t(i / 48 * 9);
  LayerMap map;
  map.layers = layers.data();
  map.columns = kSmallestBlocks;
  map.rows = kSmallestBlocks;
  const Deblocking job = {&map,
                          {picture.data(), 3 * kSide, 0, 0},
                          kSide,
                          kSide,
                          0,
                          35,
                          &TransferOf(STARFOCUS_TRANSFER_NONE),
                          &simd::BestKernels()};
  for (auto _ : state) {
    DeblockRowBoundaries(job, {0, kSmallestBlocks});
    DeblockColumnBoundaries(job, {0, kSide});
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(4 * picture.size()));
}

Field MakeField() {
  Field field;
  field.name = "micro";
  field.data.disparity.width = field.data.disparity.height = kSide;
  Image view(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      field.data.disparity.values.push_back(float(DisparityAt((x + y) % kPixels)) / 64);
      for (int c = 0; c < 3; ++c) view.row(y)[3 * x + c] = uint8_t(x * 37 + y * 91 + c * 50);
    }
  }
  field.data.views.push_back(view);
  field.low = -4;
  field.high = 5;
  return field;
}

// Refocuses a picture. Counts the bytes read from the view and the map, and the bytes written to
// the picture.
void WholePicture(const std::string& mode, const std::string& target, benchmark::State& state) {
  static const Field field = MakeField();
  Task task;
  task.mode = mode;
  task.views = 1;
  task.target = target;
  task.timed = false;
  TimedEngine timed;
  Error error = Prepare(field, task, 0, 1, &timed);
  Elapsed ignored;
  for (auto _ : state) {
    if (!error) error = RunOnce(field, task, &timed, &ignored);
  }
  if (error) state.SkipWithError(error.line().c_str());
  state.SetBytesProcessed(int64_t(state.iterations()) * kSide * kSide * (3 + 4 + 3));
}

}  // namespace

void RegisterDeblocking() { benchmark::RegisterBenchmark("deblock", Deblock); }

void RegisterLineScan(const simd::LineScanKernels* kernels) {
  const std::string name = std::string("line_scan/") + kernels->name;
  benchmark::RegisterBenchmark(name.c_str(),
                               [kernels](benchmark::State& state) { ScanLines(*kernels, state); });
}

void RegisterWholePictures(const std::string& target) {
  for (const char* mode : {"blur", "frame", "block"}) {
    const std::string name = std::string("refocus_") + mode + "/" + target;
    benchmark::RegisterBenchmark(name.c_str(), [mode, target](benchmark::State& state) {
      WholePicture(mode, target, state);
    });
  }
}

}  // namespace starfocus::bench
