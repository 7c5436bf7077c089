// SPDX-License-Identifier: Apache-2.0
// What holds of every way to make a picture (operations.h).
#include <doctest/doctest.h>

#include "tests/properties/operations.h"
#include "tests/properties/picture_operations.h"

namespace pictures_test {
namespace {

using namespace properties;

TEST_CASE("pictures: any number of workers, of those that there may be, in any order") {
  for (const Operation& operation : PictureOperations()) CheckWorkers(operation);
}

TEST_CASE("pictures: an engine that was used gives what a new one gives") {
  Setup used;
  used.used = true;
  for (const Operation& operation : PictureOperations()) CheckSetups(operation, {{}, used});
}

TEST_CASE("pictures: a runner may fail at any set of jobs, and the next call makes all") {
  for (const Operation& operation : PictureOperations()) CheckFailingRunner(operation);
}

}  // namespace
}  // namespace pictures_test
