// SPDX-License-Identifier: Apache-2.0
// Every way to make a picture may be cancelled wherever it asks, and leaves the engine as it was.
#include <doctest/doctest.h>

#include "tests/properties/operations.h"
#include "tests/properties/picture_operations.h"

namespace cancelling_slow_test {
namespace {

TEST_CASE("cancelling: at any call, the engine is as before") {
  for (const properties::Operation& operation : properties::PictureOperations(false)) {
    properties::CheckCancelling(operation);
  }
}

}  // namespace
}  // namespace cancelling_slow_test
