// SPDX-License-Identifier: Apache-2.0
// usage: instruction_bench CASE simd|reference RUNS
//
// Refocuses RUNS times. count_instructions.c counts the instructions of the program with RUNS = 2
// and with RUNS = 1. The setup does not depend on RUNS, so the difference of the two counts is the
// cost of one refocusing. `instruction_bench list` prints the cases.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "simd/kernels.h"
#include "tests/support/inside.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_targets.h"

namespace {

struct Case {
  const char* name;
  int views;
  test::Depth depth;
  starfocus_mode mode;
  double focus, aperture;
  int width = 192, height = 128;
  starfocus_renderer renderer = STARFOCUS_RENDERER_AUTO;
};

// The cases have 192 x 128 pixels unless a size is given. A name consists of the number of views,
// the scene, the mode and the largest blur radius in pixels.
constexpr Case kCases[] = {
    {"17-layers-frame-8", 17, test::Depth::kLayers, STARFOCUS_MODE_FRAME, -4, 1},
    {"17-slanted-frame-8", 17, test::Depth::kSlanted, STARFOCUS_MODE_FRAME, 4, 1},
    {"5-layers-frame-6", 5, test::Depth::kLayers, STARFOCUS_MODE_FRAME, 2, 1},
    {"1-layers-frame-paper-4", 1, test::Depth::kLayers, STARFOCUS_MODE_FRAME, 0, 1, 192, 128,
     STARFOCUS_RENDERER_LINE_SCAN},
    {"17-layers-block-8", 17, test::Depth::kLayers, STARFOCUS_MODE_BLOCK, -4, 1},
    {"5-slanted-block-4", 5, test::Depth::kSlanted, STARFOCUS_MODE_BLOCK, 0, 1},
    // Pictures of 384 x 256 pixels are large enough that the engine may divide superblocks in
    // different ways.
    {"9-room-block-7", 9, test::Depth::kRoom, STARFOCUS_MODE_BLOCK, 3.5, 1, 384, 256},
    {"5-room-block-4", 5, test::Depth::kRoom, STARFOCUS_MODE_BLOCK, -1, 1, 384, 256},
    {"9-room-block-paper-7", 9, test::Depth::kRoom, STARFOCUS_MODE_BLOCK, 3.5, 1, 384, 256,
     STARFOCUS_RENDERER_LINE_SCAN},
    {"1-layers-blur-8", 1, test::Depth::kLayers, STARFOCUS_MODE_BLUR, 4, 1},
    {"9-layers-benchmark-4", 9, test::Depth::kLayers, STARFOCUS_MODE_BENCHMARK, 0, 1},
};

const Case* Find(const char* name) {
  for (const Case& one : kCases) {
    if (std::strcmp(one.name, name) == 0) return &one;
  }
  return nullptr;
}

// Fixed coefficients of the timing model, so that the partition does not depend on the
// architecture.
constexpr starfocus_timing kTiming = {4000000, 12000, 1500, 1700, 2500, 9000, 0, 0};

int Run(const Case& one, bool reference, int runs) {
  const test::Scene scene = test::IntegerScene(one.width, one.height, one.views, one.depth);
  test::Config config = test::ConfigFor(scene, 16);
  config.tuning.timing = kTiming;
  test::Engine engine(config);
  if (engine.status() != STARFOCUS_OK) return 1;
  if (reference) test::UseKernels(&starfocus::simd::ReferenceKernels(), engine.get());
  test::Output out(one.width, one.height);
  starfocus::Params params = test::Params(one.focus, one.aperture, one.mode);
  params.study.renderer = one.renderer;
  for (int run = 0; run < runs; ++run) {
    if (test::Refocus(&engine, params, scene, &out) != STARFOCUS_OK) return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "list") == 0) {
    for (const Case& one : kCases) std::printf("%s %d\n", one.name, one.width * one.height);
    return 0;
  }
  const Case* one = argc == 4 ? Find(argv[1]) : nullptr;
  if (one == nullptr) {
    std::fprintf(stderr, "usage: instruction_bench list | CASE simd|reference RUNS\n");
    return 1;
  }
  return Run(*one, std::strcmp(argv[2], "reference") == 0, std::atoi(argv[3]));
}
