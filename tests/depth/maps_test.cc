// SPDX-License-Identifier: Apache-2.0
// Checks the properties of tests/properties/operations.h for every operation that makes a map.
#include <doctest/doctest.h>

#include "tests/depth/map_operations.h"

namespace maps_test {
namespace {

using namespace properties;

TEST_CASE("maps: the result does not depend on the number of workers or the order of jobs") {
  for (const Operation& operation : MapOperations()) CheckWorkers(operation);
}

TEST_CASE("maps: after a runner has failed at any jobs, the next call makes the whole map") {
  for (const Operation& operation : MapOperations()) CheckFailingRunner(operation);
}

TEST_CASE("maps: progress is reported per tile, and any report can cancel") {
  for (const Operation& operation : MapOperations()) CheckCancelling(operation);
}

}  // namespace
}  // namespace maps_test
