// SPDX-License-Identifier: Apache-2.0
// Checks that every operation that makes a picture returns the same bytes on every SIMD target.
#include <doctest/doctest.h>

#include <vector>

#include "tests/operations/operations.h"
#include "tests/operations/picture_operations.h"
#include "tests/support/simd_targets.h"

namespace pictures_bytes_test {
namespace {

using namespace properties;

TEST_CASE("pictures: every SIMD target returns the bytes of the reference kernels") {
  std::vector<Setup> setups(1);
  setups[0].kernels = &starfocus::simd::ReferenceKernels();
  for (const auto* kernels : test::SimdTargets()) setups.emplace_back().kernels = kernels;
  for (const Operation& operation : PictureOperations(false)) CheckSetups(operation, setups);
}

}  // namespace
}  // namespace pictures_bytes_test
