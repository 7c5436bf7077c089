// SPDX-License-Identifier: Apache-2.0
// Fuzz target: calls that must return the same bytes. The input selects the configuration, the lens
// and the calls. One number of the input is the seed of the pictures.
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/input.h"
#include "tests/operations/families.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  test::Random random(data, size);
  const starfocus::stress::Outcome outcome = starfocus::stress::Differential(&random);
  if (outcome.failure.empty()) return 0;
  std::fprintf(stderr, "%s\n", outcome.failure.c_str());
  std::abort();
}
