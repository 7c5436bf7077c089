// SPDX-License-Identifier: Apache-2.0
// Checks the properties of operations.h for every operation that makes a picture.
#include <doctest/doctest.h>

#include "tests/operations/operations.h"
#include "tests/operations/picture_operations.h"
#include "tests/support/rounds.h"

namespace pictures_test {
namespace {

using namespace properties;

// Operations on all formats; in slow builds, only on NV12.
std::vector<Operation> Operations() { return PictureOperations(!test::kSlow); }

TEST_CASE("pictures: the result does not depend on the number of workers or the order of jobs") {
  for (const Operation& operation : Operations()) CheckWorkers(operation);
}

TEST_CASE("pictures: an engine that was used before returns the bytes of a new engine") {
  Setup used;
  used.used = true;
  for (const Operation& operation : Operations()) CheckSetups(operation, {{}, used});
}

TEST_CASE(
    "pictures: after a runner has failed at any set of jobs, the next call returns the whole "
    "picture") {
  for (const Operation& operation : Operations()) CheckFailingRunner(operation);
}

}  // namespace
}  // namespace pictures_test
