// SPDX-License-Identifier: Apache-2.0
// Fuzz target: calls that must return the same bytes. The input selects the configuration, the lens
// and the calls. One number of the input is the seed of the pictures.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/input.h"
#include "tests/operations/picture_operations.h"

// Aborts at the first failed check.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static doctest::Context* const context = [] {
    auto* made = new doctest::Context;
    made->setAsDefaultForAssertsOutOfTestCases();
    made->setAssertHandler([](const doctest::AssertData& failed) {
      if (!failed.m_failed) return;
      std::fprintf(stderr, "%s:%d: %s is %s\n", failed.m_file, failed.m_line, failed.m_expr,
                   failed.m_decomp.c_str());
      std::abort();
    });
    return made;
  }();
  (void)context;
  test::Random random(data, size);
  const properties::Case of = properties::RandomCase(&random);
  for (int k = 0; k < 3; ++k) properties::CheckAnyCall(of, &random);
  return 0;
}
