// SPDX-License-Identifier: Apache-2.0
// Checks the properties of tests/operations/operations.h for every operation that makes a map.
#include <doctest/doctest.h>

#include "tests/operations/map_operations.h"

namespace maps_test {
namespace {

using namespace properties;

TEST_CASE("maps: the map does not depend on the number of workers or the order of jobs") {
  for (const Operation& operation : MapOperations()) CheckWorkers(operation);
}

TEST_CASE("maps: after the runner fails at any job, the next call makes the complete map") {
  for (const Operation& operation : MapOperations()) CheckFailingRunner(operation);
}

TEST_CASE("maps: the progress function is called per tile, and any call can cancel") {
  for (const Operation& operation : MapOperations()) CheckCancelling(operation);
}

}  // namespace
}  // namespace maps_test
