// SPDX-License-Identifier: Apache-2.0
// Compares checksums of refocused pictures with the checksums in golden.txt, which every machine,
// SIMD target and compiler must reproduce. After an intended change of the output, `./do golden`
// updates golden.txt by running this program with STARFOCUS_RECORD_GOLDEN=1.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/scenes.h"
#include "tests/support/shapes.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace golden_bytes_test {
namespace {

// Returns the FNV-1a checksum of the bytes.
uint64_t Hash(const std::vector<uint8_t>& bytes) {
  uint64_t hash = 0xCBF29CE484222325u;
  for (const uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001B3u;
  return hash;
}

struct Lens {
  starfocus_mode mode;
  double focus, aperture;
};

struct Case {
  std::string name;
  int width, height, views;
  test::Depth depth;
  Lens lens;
  int block;
  int levels = 0, range = 0;                // Levels and range of a LevelCase, or 0 in other cases.
  const test::NamedShape* shape = nullptr;  // Shape of the lens, or null for the default shape.
};

// A scene with `levels` random disparities and blur radii up to `range`, which is cut into slices.
struct LevelCase {
  int block, levels, range;
};
constexpr LevelCase kLevelCases[] = {{32, 13, 40}, {32, 16, 38}, {64, 11, 29},
                                     {64, 12, 32}, {64, 15, 33}, {64, 14, 40},
                                     {64, 16, 39}, {64, 16, 29}, {128, 11, 39}};

std::vector<Case> Cases() {
  constexpr const char* kDepthNames[] = {"layers", "slanted", "noise"};
  constexpr const char* kModeNames[] = {"frame", "benchmark", "block", "blur"};
  constexpr Lens kLenses[] = {
      {STARFOCUS_MODE_FRAME, -2.03125, 1}, {STARFOCUS_MODE_FRAME, 3.75, 0.625},
      {STARFOCUS_MODE_FRAME, 9.3, 0.9},    {STARFOCUS_MODE_BENCHMARK, 0.25, 0.75},
      {STARFOCUS_MODE_BLOCK, -3.5, 1},     {STARFOCUS_MODE_BLOCK, 1.125, 0.8},
      {STARFOCUS_MODE_BLUR, 2.5, 1},       {STARFOCUS_MODE_BLOCK, -27.5, 1}};
  std::vector<Case> cases;
  int number = 0;
  for (const int views : {1, 5, 9, 17}) {
    for (const test::Depth depth :
         {test::Depth::kLayers, test::Depth::kSlanted, test::Depth::kNoise}) {
      for (const Lens& lens : kLenses) {
        // Two lenses suffice for noisy disparities, since with any lens, all views of a noisy line
        // differ.
        if (depth == test::Depth::kNoise && &lens != &kLenses[1] && &lens != &kLenses[4]) continue;
        Case one = {"", 97, 70, views, depth, lens, number % 2 == 0 ? 32 : 64};
        char name[80];
        std::snprintf(name, sizeof(name), "%d-%s-%s-%g-%g-%d", views,
                      kDepthNames[static_cast<int>(depth)], kModeNames[lens.mode], lens.focus,
                      lens.aperture, one.block);
        one.name = name;
        cases.push_back(one);
        ++number;
      }
    }
  }
  // In the cases of kLevelCases, the area of all slices is slightly below or above MostSliceArea.
  // Each picture would change if MostSliceArea were 1 % larger or smaller. In the last case, a
  // block is cut into four tiles, and the picture differs from the picture of the uncut block.
  for (const LevelCase& level : kLevelCases) {
    Case one = {"",          level.block,         level.block,
                1,           test::Depth::kNoise, {STARFOCUS_MODE_FRAME, 0, 1},
                level.block, level.levels,        level.range};
    one.name = "levels-" + std::to_string(level.levels) + "-" + std::to_string(level.range) + "-" +
               std::to_string(level.block);
    cases.push_back(one);
  }
  // The lenses kLenses[5] to kLenses[7] test both renderers in block mode, the PSFs of blur mode,
  // and wide blurs.
  for (const test::NamedShape& shape : test::kShapes) {
    for (const Lens& lens : {kLenses[5], kLenses[6], kLenses[7]}) {
      for (const int block : {32, 64}) {
        if (lens.mode == STARFOCUS_MODE_BLUR && block == 64) continue;  // the same picture
        if (lens.focus == kLenses[7].focus && block == 32) continue;
        Case one = {"", 97, 70, 5, test::Depth::kLayers, lens, block};
        char name[80];
        std::snprintf(name, sizeof(name), "%s-%s-%g-%d", shape.name, kModeNames[lens.mode],
                      lens.focus, block);
        one.name = name;
        one.shape = &shape;
        cases.push_back(one);
      }
    }
  }
  return cases;
}

// Number of pixels at each layer, and number of pixels blurred without rendering views.
struct Covered {
  uint64_t layers[STARFOCUS_LAYERS] = {};
  uint64_t gathered = 0;
};

// Returns the checksum of the refocused picture, and adds its pixels to `covered`.
std::string Refocus(const Case& one, const test::Scene& scene,
                    const starfocus::simd::Kernels* kernels, Covered* covered) {
  test::Config config = test::ConfigFor(scene, 43);
  config.superblock = one.block;
  // Cases with slanted surfaces average codes as in the paper, and other cases average light.
  config.transfer =
      one.depth == test::Depth::kSlanted ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
  // In cases with 9 views, every cell is rendered from views, so views occur at all layers.
  config.tuning.gather = one.views != 9;
  if (one.levels > 0) config.tuning.n_scale = 0.5;
  starfocus::Params params = test::Params(one.lens.focus, one.lens.aperture, one.lens.mode);
  if (one.shape != nullptr) one.shape->Set(&params);
  test::ReserveFor(params, &config);
  test::Engine engine(config);
  test::UseKernels(kernels, engine.get());
  // The renderer slices uses no layer 2 at depth edges, so cases with blocks of 32 use the line
  // scan.
  if (one.block == 32) params.study.renderer = STARFOCUS_RENDERER_LINE_SCAN;
  if (one.levels > 0) params.study.renderer = STARFOCUS_RENDERER_SLICES;
  test::Report report;
  const test::Output out = test::OutputOf(&engine, params, scene, &report);
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    covered->layers[layer] += report.layers[layer].pixels;
  }
  covered->gathered += report.gathered_pixels;
  char text[20];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(Hash(out.bytes)));
  return text;
}

constexpr char kGolden[] = STARFOCUS_SOURCE_DIR "/tests/lib/golden.txt";
using Golden = std::map<std::string, std::string>;

Golden ReadGolden() {
  Golden golden;
  std::FILE* file = std::fopen(kGolden, "r");
  REQUIRE_MESSAGE(file != nullptr, "cannot read ", kGolden);
  char name[100], hash[20];
  while (std::fscanf(file, "%99s %19s", name, hash) == 2) golden[name] = hash;
  std::fclose(file);
  return golden;
}

void WriteGolden(const std::vector<Case>& cases, Golden golden) {
  std::FILE* file = std::fopen(kGolden, "w");
  REQUIRE_MESSAGE(file != nullptr, "cannot write ", kGolden);
  for (const Case& one : cases) {
    std::fprintf(file, "%s %s\n", one.name.c_str(), golden[one.name].c_str());
  }
  CHECK(std::fclose(file) == 0);
}

TEST_CASE(
    "golden: refocused pictures match the recorded checksums on every machine and SIMD target") {
  std::vector<const starfocus::simd::Kernels*> tables = test::SimdTargets();
  tables.push_back(&starfocus::simd::ReferenceKernels());
  const std::vector<Case> cases = Cases();
  const bool record = std::getenv("STARFOCUS_RECORD_GOLDEN") != nullptr;
  Golden golden;
  if (!record) golden = ReadGolden();
  std::map<std::string, int> wrong;
  Covered covered;
  for (const Case& one : cases) {
    const test::Scene scene = one.levels > 0
                                  ? test::LevelScene(one.block, one.levels, one.range)
                                  : test::IntegerScene(one.width, one.height, one.views, one.depth);
    // The last table holds the reference kernels, whose checksums are recorded.
    if (record) golden[one.name] = Refocus(one, scene, tables.back(), &covered);
    for (const starfocus::simd::Kernels* kernels : tables) {
      CAPTURES(one.name, kernels->name);
      const std::string hash = Refocus(one, scene, kernels, &covered);
      CHECK(hash == golden[one.name]);
      wrong[kernels->name] += hash != golden[one.name];
    }
  }
  for (const starfocus::simd::Kernels* kernels : tables) {
    std::printf("golden: %s: %zu of %zu checksums equal\n", kernels->name,
                cases.size() - static_cast<size_t>(wrong[kernels->name]), cases.size());
  }
  for (const uint64_t pixels : covered.layers) CHECK(pixels > 0);
  CHECK(covered.gathered > 0);
  if (record) WriteGolden(cases, golden);
  CHECK(golden.size() == cases.size());
}

}  // namespace
}  // namespace golden_bytes_test
