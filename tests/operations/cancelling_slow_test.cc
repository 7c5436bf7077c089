// SPDX-License-Identifier: Apache-2.0
// Checks that every operation that makes a picture can be cancelled at any call of the progress
// function, and that the engine is then unchanged.
#include <doctest/doctest.h>

#include "tests/operations/operations.h"
#include "tests/operations/picture_operations.h"

namespace cancelling_slow_test {
namespace {

TEST_CASE(
    "cancelling: after cancellation at any progress call, the engine still returns whole "
    "pictures") {
  for (const properties::Operation& operation : properties::PictureOperations(false)) {
    properties::CheckCancelling(operation);
  }
}

}  // namespace
}  // namespace cancelling_slow_test
