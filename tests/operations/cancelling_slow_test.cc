// SPDX-License-Identifier: Apache-2.0
// Checks that every operation can be cancelled at any call of the progress function, and that the
// engine is then unchanged.
#include <doctest/doctest.h>

#include "tests/operations/map_operations.h"
#include "tests/operations/picture_operations.h"

namespace cancelling_slow_test {
namespace {

using namespace properties;

TEST_CASE(
    "cancelling: after cancellation at any progress call, the engine still returns whole "
    "pictures") {
  for (const Operation& operation : PictureOperations(false)) CheckCancelling(operation);
}

TEST_CASE(
    "cancelling: the progress function is called per tile of a map, and any call can cancel") {
  for (const Operation& operation : MapOperations()) CheckCancelling(operation);
}

}  // namespace
}  // namespace cancelling_slow_test
