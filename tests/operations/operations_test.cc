// SPDX-License-Identifier: Apache-2.0
// Checks the properties of operations.h for every operation that makes a picture or a map.
#include <doctest/doctest.h>

#include "tests/operations/map_operations.h"
#include "tests/operations/picture_operations.h"

namespace operations_test {
namespace {

using namespace properties;

// All operations; in slow builds, of the images only those of NV12.
std::vector<Operation> Operations() {
  std::vector<Operation> all = PictureOperations(!test::kSlow);
  for (const Operation& operation : MapOperations()) all.push_back(operation);
  return all;
}

TEST_CASE("operations: the result does not depend on the number of workers or the order of jobs") {
  for (const Operation& operation : Operations()) CheckWorkers(operation);
}

TEST_CASE("operations: an engine that was used before returns the bytes of a new engine") {
  Setup used;
  used.used = true;
  for (const Operation& operation : Operations()) CheckSetups(operation, {{}, used});
}

TEST_CASE(
    "operations: after a runner has failed at any set of jobs, the next call returns the whole "
    "result") {
  for (const Operation& operation : Operations()) CheckFailingRunner(operation);
}

}  // namespace
}  // namespace operations_test
