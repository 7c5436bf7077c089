// SPDX-License-Identifier: Apache-2.0
// starfocus-bench-micro measures the speed of every kernel on every SIMD target, and the speed of
// each reference. The program also measures parts of the engine that call kernels, and memcpy of
// similar sizes. Speeds are in bytes read and written per second. kernels_bytes_test checks the
// results of the same kernel calls.
#include "examples/lab/bench/micro.h"

#include <benchmark/benchmark.h>

#include <cstring>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "tests/kernels/kernel_cases.h"
#include "tests/support/simd_targets.h"

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
