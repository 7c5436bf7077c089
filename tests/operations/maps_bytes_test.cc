// SPDX-License-Identifier: Apache-2.0
// Checks that every operation that makes a map returns the same bytes on every SIMD target, from
// mirrored input, and in memory that holds data of earlier calls.
#include <doctest/doctest.h>

#include <vector>

#include "tests/operations/map_operations.h"
#include "tests/support/simd_targets.h"

namespace maps_bytes_test {
namespace {

using namespace properties;

TEST_CASE("maps: bytes do not depend on SIMD target, mirroring, or earlier data in the memory") {
  std::vector<Setup> setups(4);
  setups[1].used = true;
  setups[2].mirror.mirror_x = setups[3].mirror.mirror_y = true;
  for (const auto* kernels : test::DepthTargets()) setups.emplace_back().depth_kernels = kernels;
  setups.emplace_back().depth_kernels = &starfocus::simd::ReferenceDepthKernels();
  for (const Operation& operation : MapOperations()) CheckSetups(operation, setups);
}

}  // namespace
}  // namespace maps_bytes_test
