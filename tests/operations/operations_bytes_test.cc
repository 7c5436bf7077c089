// SPDX-License-Identifier: Apache-2.0
// Checks that all ways to ask for a picture return the bytes of the whole picture, on every SIMD
// target, with any workers, memory and earlier calls; also that maps do not depend on these.
#include <doctest/doctest.h>

#include "tests/operations/map_operations.h"
#include "tests/operations/picture_operations.h"
#include "tests/operations/random_cases.h"
#include "tests/support/sanitizers.h"
#include "tests/support/simd_targets.h"

namespace operations_bytes_test {
namespace {

using namespace properties;

TEST_CASE("ways: random calls with random conditions return the bytes of the whole picture") {
  // Sanitizers take ten times as long. The fuzz target `differential` draws more of these cases.
  ForRandomCases(test::kSanitized     ? 300
                 : STARFOCUS_EMULATED ? 600
                                      : 1000,
                 [](test::Random* random) {
                   const Case of = RandomCase(random);
                   for (int k = 0; k < 3; ++k) CheckAnyCall(of, random);
                 });
}

TEST_CASE("ways: frames and regions of many blocks have the bytes of the whole picture") {
  ForRandomCases(test::kSlow ? 20 : 60, [](test::Random* random) {
    Case of = RandomCase({260, 12, 8, 100}, random);
    of.config.superblock = 32;
    if (of.params.study.mode == STARFOCUS_MODE_BENCHMARK)
      of.params.study.mode = STARFOCUS_MODE_BLOCK;
    for (const Entry entry : {Entry::kAfter, Entry::kAfter, Entry::kAfter, Entry::kWhole}) {
      CheckWay(of, RandomWay(of, entry, false, random), random);
    }
  });
}

// Cases that random draws rarely or never make.
struct Corner {
  const char* name;
  Case (*make)(int round);
  int rounds = 1;
};

Case CaseOf(test::Scene scene, double blur, int block, const starfocus::Params& params) {
  Case of;
  of.config = test::ConfigFor(scene, blur);
  of.config.superblock = block;
  of.config.tuning.deblocking = 255;
  of.params = params;
  of.scene = std::move(scene);
  return of;
}

const Corner kCorners[] = {
    {"neighbouring blocks at layers 0 and 2",
     [](int round) {
       const int side = 32 << round;
       test::Scene scene = test::LayeredScene(160, 160, 5, 12, 5);
       test::SetDisparity(
           &scene, [side](int x, int y) { return (x / side + y / side) % 2 == 0 ? 0.0f : 11.0f; });
       return CaseOf(scene, 13, side,
                     test::Params(-1, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN));
     },
     2},
    {"rows of side views a hundred rows away",
     [](int round) {
       const auto mode = round == 0 ? STARFOCUS_MODE_FRAME : STARFOCUS_MODE_BLOCK;
       return CaseOf(test::NearScene(70, 400, 5, 12), 8, 32,
                     test::Params(test::kNearFocus, 0.2, mode));
     },
     2},
    // With one view, ring buffers hold exactly the rows that blocks at layers 1 and 2 read.
    {"rings of the rows of one layer",
     [](int round) {
       const float radius = float(round + 1);
       test::Scene scene = test::RandomScene(48, 200, 1, 0, radius, 70 + uint64_t(radius));
       scene.disparity.assign(scene.disparity.size(), radius);
       return CaseOf(scene, round + 1, 32,
                     test::Params(0, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN));
     },
     16},
    {"rows that are pulled late",
     [](int) {
       return CaseOf(test::LayeredScene(20, 900, 1, 1, 50), 2, 256,
                     test::Params(0, 1, STARFOCUS_MODE_BLOCK));
     }},
    {"lamps",
     [](int round) {
       test::Random random(27);
       test::Scene scene = test::LayeredScene(140, 110, 5, 7, 12);
       for (int lamp = 0; lamp < 12; ++lamp) {
         const int x = random.Int(0, 130), y = random.Int(0, 100), side = random.Int(1, 9);
         for (int k = 0; k < side * side * 5; ++k) {
           std::fill_n(scene.Pixel(k % 5, x + k / 5 % side, y + k / 5 / side), 3, uint8_t{255});
         }
       }
       Case of =
           CaseOf(scene, 20, 32,
                  test::Params(5, 1, round == 0 ? STARFOCUS_MODE_BLOCK : STARFOCUS_MODE_BLUR));
       of.config.highlights = 8;
       return of;
     },
     2}};

// Slow builds check each corner and each entry with fewer rounds and images.
TEST_CASE("ways: calls for corner cases return the bytes of the whole picture") {
  test::Random random(71);
  for (const Corner& corner : kCorners) {
    for (int round = 0; round < corner.rounds; round += test::kSlow && corner.rounds > 2 ? 5 : 1) {
      CAPTURES(corner.name, round);
      const Case of = corner.make(round);
      for (const Entry entry : kEntries) {
        for (int way = 0; way < (test::kSlow ? 1 : 3); ++way) {
          const bool images = test::kSlow ? random.Int(0, 1) == 0 : way > 0;
          CheckWay(of, RandomWay(of, entry, images, &random), &random);
        }
      }
    }
  }
}

TEST_CASE("pictures: every SIMD target returns the bytes of the reference kernels") {
  std::vector<Setup> setups(1);
  setups[0].kernels = &starfocus::simd::ReferenceKernels();
  for (const auto* kernels : test::SimdTargets()) setups.emplace_back().kernels = kernels;
  for (const Operation& operation : PictureOperations(false)) CheckSetups(operation, setups);
}

TEST_CASE("maps: bytes do not depend on SIMD target, mirroring, or earlier data in the memory") {
  std::vector<Setup> setups(1);
  // Mirroring and earlier data have the same effect on every machine.
  if (!test::kSlow) {
    setups.resize(4);
    setups[1].used = true;
    setups[2].mirror.mirror_x = setups[3].mirror.mirror_y = true;
  }
  for (const auto* kernels : test::DepthTargets()) setups.emplace_back().depth_kernels = kernels;
  setups.emplace_back().depth_kernels = &starfocus::simd::ReferenceDepthKernels();
  for (const Operation& operation : MapOperations()) CheckSetups(operation, setups);
}

}  // namespace
}  // namespace operations_bytes_test
