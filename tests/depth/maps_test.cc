// SPDX-License-Identifier: Apache-2.0
// What holds of every way to make a map (tests/properties/operations.h).
#include <doctest/doctest.h>

#include "tests/depth/map_operations.h"

namespace maps_test {
namespace {

using namespace properties;

TEST_CASE("maps: any number of workers, of those that there may be, in any order") {
  for (const Operation& operation : MapOperations()) CheckWorkers(operation);
}

TEST_CASE("maps: a runner may fail at any set of jobs, and the next call makes all") {
  for (const Operation& operation : MapOperations()) CheckFailingRunner(operation);
}

TEST_CASE("maps: progress is told tile by tile, and cancels at any of them") {
  for (const Operation& operation : MapOperations()) CheckCancelling(operation);
}

}  // namespace
}  // namespace maps_test
