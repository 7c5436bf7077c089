// Checksums of refocused pictures, the same on every machine, SIMD target and compiler: the promise
// of bit-exactness. golden.txt holds them; after an intended change of the engine's output
//   ./do golden
// writes it anew (STARFOCUS_RECORD_GOLDEN=1 makes this program do so).
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/simd_targets.h"
#include "tests/test_scene.h"

namespace {

// FNV-1a.
uint64_t Hash(const std::vector<uint8_t>& bytes) {
  uint64_t hash = 0xCBF29CE484222325u;
  for (const uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001B3u;
  return hash;
}

enum class Depth { kLayers, kSlanted, kNoise };

// A disparity every machine computes alike: multiples of 1/64, 1/96 and 1/7, one division each.
float DisparityAt(Depth depth, int x, int y, test::Random* random) {
  switch (depth) {
    case Depth::kLayers: {
      const bool near = (x / 19 + y / 23) % 3 == 0, middle = (x * 2 + y) % 71 < 24;
      return static_cast<float>(near ? 250 : middle ? 37 : -130) / 64.0f;
    }
    case Depth::kSlanted:
      return static_cast<float>(3 * x - 2 * y) / 96.0f;
    case Depth::kNoise:
      return static_cast<float>(random->Int(-21, 21)) / 7.0f;
  }
  return 0;
}

// Smooth shading with noise and hard edges; views shifted and shaded apart, so that nothing can be
// taken from the wrong one unnoticed. Integers only: no machine's rounding enters.
test::Scene MakeScene(int width, int height, int views, Depth depth) {
  test::Scene scene = test::EmptyScene(width, height, views, -4, 4);
  test::Random random(static_cast<uint64_t>(views) * 10 + static_cast<uint64_t>(depth));
  for (int view = 0; view < views; ++view) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c) {
          const int shade = 5 * x + 3 * y * (c + 1) + 29 * view;
          const int edge = ((x + 2 * view) / 9 + y / 7) % 2 * 90;
          const int noise = random.Int(0, 40);
          scene.Pixel(view, x, y)[c] = static_cast<uint8_t>(shade / 4 % 126 + edge + noise);
        }
      }
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) scene.Disparity(x, y) = DisparityAt(depth, x, y, &random);
  }
  return scene;
}

struct Lens {
  sf_mode mode;
  double focus, aperture;
};

struct Case {
  std::string name;
  int width, height, views;
  Depth depth;
  Lens lens;
  int block;
};

std::vector<Case> Cases() {
  constexpr const char* kDepthNames[] = {"layers", "slanted", "noise"};
  constexpr const char* kModeNames[] = {"frame", "benchmark"};
  constexpr Lens kLenses[] = {{SF_MODE_FRAME, -2.03125, 1},
                              {SF_MODE_FRAME, 3.75, 0.625},
                              {SF_MODE_FRAME, 9.3, 0.9},
                              {SF_MODE_BENCHMARK, 0.25, 0.75}};
  std::vector<Case> cases;
  int number = 0;
  for (const int views : {1, 5, 9, 17}) {
    for (const Depth depth : {Depth::kLayers, Depth::kSlanted, Depth::kNoise}) {
      for (const Lens& lens : kLenses) {
        // Noise makes each view of a line its own; one lens of it is enough.
        if (depth == Depth::kNoise && &lens != &kLenses[1]) continue;
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
  return cases;
}

std::string Refocus(const Case& one, const test::Scene& scene,
                    const starfocus::simd::Kernels* kernels) {
  sf_config config = test::ConfigFor(scene, 16);
  config.largest_block = one.block;
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  test::UseKernels(kernels, engine.get());
  test::Output out(scene.width, scene.height);
  const sf_params params = test::Params(one.lens.focus, one.lens.aperture, one.lens.mode);
  REQUIRE(test::Refocus(&engine, params, scene, &out) == SF_OK);
  char text[20];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(Hash(out.bytes)));
  return text;
}

using Golden = std::map<std::string, std::string>;

Golden ReadGolden() {
  Golden golden;
  std::FILE* file = std::fopen(STARFOCUS_GOLDEN_FILE, "r");
  REQUIRE_MESSAGE(file != nullptr, "cannot read " STARFOCUS_GOLDEN_FILE);
  char name[100], hash[20];
  while (std::fscanf(file, "%99s %19s", name, hash) == 2) golden[name] = hash;
  std::fclose(file);
  return golden;
}

void WriteGolden(const std::vector<Case>& cases, Golden golden) {
  std::FILE* file = std::fopen(STARFOCUS_GOLDEN_FILE, "w");
  REQUIRE_MESSAGE(file != nullptr, "cannot write " STARFOCUS_GOLDEN_FILE);
  for (const Case& one : cases) {
    std::fprintf(file, "%s %s\n", one.name.c_str(), golden[one.name].c_str());
  }
  CHECK(std::fclose(file) == 0);
}

TEST_CASE("golden: the same pictures on every machine and SIMD target") {
  std::vector<const starfocus::simd::Kernels*> tables = test::SimdTargets();
  tables.push_back(&starfocus::simd::ReferenceKernels());
  const std::vector<Case> cases = Cases();
  const bool record = std::getenv("STARFOCUS_RECORD_GOLDEN") != nullptr;
  Golden golden;
  if (!record) golden = ReadGolden();
  std::map<std::string, int> wrong;
  for (const Case& one : cases) {
    const test::Scene scene = MakeScene(one.width, one.height, one.views, one.depth);
    // What is recorded is the reference's: the last table.
    if (record) golden[one.name] = Refocus(one, scene, tables.back());
    for (const starfocus::simd::Kernels* kernels : tables) {
      CAPTURE(one.name);
      CAPTURE(kernels->name);
      const std::string hash = Refocus(one, scene, kernels);
      CHECK(hash == golden[one.name]);
      wrong[kernels->name] += hash != golden[one.name];
    }
  }
  for (const starfocus::simd::Kernels* kernels : tables) {
    std::printf("golden: %s: %zu of %zu checksums equal\n", kernels->name,
                cases.size() - static_cast<size_t>(wrong[kernels->name]), cases.size());
  }
  if (record) WriteGolden(cases, golden);
  CHECK(golden.size() == cases.size());
}

}  // namespace
