// SPDX-License-Identifier: Apache-2.0
// What may be asked for in several ways, each of which must give the same bytes: the input draws
// the configuration, the lens and the ways; pictures follow from a number of it.
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/input.h"
#include "tests/stress/families.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  test::Random random(data, size);
  const starfocus::stress::Outcome outcome = starfocus::stress::Differential(&random);
  if (outcome.failure.empty()) return 0;
  std::fprintf(stderr, "%s\n", outcome.failure.c_str());
  std::abort();
}
