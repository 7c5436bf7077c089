// SPDX-License-Identifier: Apache-2.0
// starfocus-bench-micro: times single kernels, the line scan and small pictures.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "examples/lab/bench/timed_engine.h"
#include "lib/line_scan/line_scan.h"
#include "simd/kernels.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"
#include "tests/kernels/kernel_cases.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace starfocus::bench {

// Registers the benchmark of the deblocking filter.
void RegisterDeblocking();

// Registers the benchmark of the line scan, including the search for runs.
void RegisterLineScan(const simd::LineScanKernels* kernels);

// Registers benchmarks that refocus small pictures with one view in the modes blur, frame and
// block.
void RegisterWholePictures(const std::string& target);

// Registers benchmarks that measure the time per pixel of an ordinary picture and of the most
// expensive valid pictures.
void RegisterBounds();

namespace {

// Measures the time per pixel of the most expensive valid pictures, and of an ordinary picture.

constexpr int kWidth = 384, kHeight = 256, kViews = 5;
constexpr int kBlur = 16;           // Largest blur radius, pixels.
constexpr double kHighlights = 16;  // Value of starfocus::Config.highlights.

struct Picture {
  const char* name;
  bool noisy_depth;  // True if the disparity of each pixel is random, from -kBlur to kBlur.
  int white;         // White squares in 1000 squares of 4x4 pixels; -1: the ordinary picture.
  double highlights;
};

constexpr Picture kPictures[] = {
    {"room", false, -1, 1},
    {"noisy_depth", true, 0, 1},
    {"noisy_depth_white_highlights", true, 1000, kHighlights},
    {"noisy_depth_lamps_highlights", true, 250, kHighlights},
    {"white_highlights", false, 1000, kHighlights},
};

test::Scene SceneOf(const Picture& picture) {
  if (picture.white < 0) {
    return test::IntegerScene(kWidth, kHeight, kViews, test::Depth::kRoom);
  }
  test::Scene scene = test::EmptyScene(kWidth, kHeight, kViews, -kBlur, kBlur);
  test::Random random(7);
  for (int view = 0; view < kViews; ++view) {
    for (int y = 0; y < kHeight; y += 4) {
      for (int x = 0; x < kWidth; x += 4) {
        const uint8_t code = random.Int(0, 999) < picture.white ? 255 : uint8_t(random.Int(0, 240));
        for (int row = y; row < y + 4; ++row) std::fill_n(scene.Pixel(view, x, row), 12, code);
      }
    }
  }
  for (float& disparity : scene.disparity) {
    disparity = picture.noisy_depth ? float(random.Real(-kBlur, kBlur)) : float(kBlur);
  }
  return scene;
}

void Refocus(const Picture& picture, benchmark::State& state) {
  const test::Scene scene = SceneOf(picture);
  test::Config config = test::ConfigFor(scene, kBlur);
  config.highlights = static_cast<float>(picture.highlights);
  test::Engine engine(config);
  test::Output out(kWidth, kHeight);
  const starfocus::Params params =
      test::Params(picture.white < 0 ? -1 : 0, 1, STARFOCUS_MODE_BLOCK);
  for (auto _ : state) {
    if (test::Refocus(&engine, params, scene, &out) != STARFOCUS_OK)
      state.SkipWithError("not refocused");
  }
  const double pixels = double(kWidth) * kHeight;
  state.counters["per_pixel"] = benchmark::Counter(
      pixels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

void RegisterBounds() {
  for (const Picture& picture : kPictures) {
    benchmark::RegisterBenchmark((std::string("bound/") + picture.name).c_str(),
                                 [&picture](benchmark::State& state) { Refocus(picture, state); });
  }
}

namespace {

// Measures parts of the engine that call kernels: the line scan, deblocking and whole pictures.

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
                          {{picture.data(), 3 * kSide, 0, 0}},
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

// starfocus-bench-micro measures the speed of every kernel on every SIMD target, and the speed of
// each reference. The program also measures parts of the engine that call kernels, and memcpy of
// similar sizes. Speeds are in bytes read and written per second. kernels_bytes_test checks the
// results of the same kernel calls.
namespace {

using starfocus::simd::Kernels;
using starfocus::simd::LineScanKernels;

template <class Case, class Table>
void Register(const Case& one, const Table* kernels) {
  const std::string name = std::string(one.kernel) + "/" + kernels->name;
  benchmark::RegisterBenchmark(name.c_str(), [kernels, &one](benchmark::State& state) {
    test::Draw draw = test::Draw::ForBench();
    test::CallOf<Table> call(&draw);
    one.make(&draw, &call);
    // Kernels that add to sums may overflow after many passes, which does not affect the time.
    for (auto _ : state) benchmark::DoNotOptimize(call.run(*kernels));
    state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(call.Bytes()));
  });
}

template <class Cases, class Table>
void RegisterAll(const Cases& cases, std::vector<const Table*> tables, const Table& reference) {
  tables.push_back(&reference);
  for (const auto& one : cases) {
    for (const Table* kernels : tables) Register(one, kernels);
  }
}

// Registers a benchmark of memcpy. Half of the counted bytes are read, and half are written.
void RegisterCopies() {
  for (const size_t kib : {6, 9, 12, 18, 27}) {
    const std::string name = "memcpy/" + std::to_string(kib) + "_KiB";
    benchmark::RegisterBenchmark(name.c_str(), [kib](benchmark::State& state) {
      const size_t count = kib * 1024 / 2;
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
  for (const Kernels* kernels : test::SimdTargets()) {
    starfocus::bench::RegisterWholePictures(kernels->name);
  }
  RegisterAll(test::kernel_cases::kAll, test::SimdTargets(), starfocus::simd::ReferenceKernels());
  RegisterAll(test::depth_cases::kAll, test::DepthTargets(),
              starfocus::simd::ReferenceDepthKernels());
  RegisterAll(test::line_scan_cases::kAll, test::LineScanTargets(),
              starfocus::simd::ReferenceLineScanKernels());
  for (const LineScanKernels* kernels : test::LineScanTargets()) {
    starfocus::bench::RegisterLineScan(kernels);
  }
  starfocus::bench::RegisterLineScan(&starfocus::simd::ReferenceLineScanKernels());
  starfocus::bench::RegisterDeblocking();
  starfocus::bench::RegisterBounds();
  RegisterCopies();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
