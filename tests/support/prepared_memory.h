// SPDX-License-Identifier: Apache-2.0
// Memory for a prepared light field of a configuration: of exactly the size asked for, poisoned.
#ifndef STARFOCUS_TESTS_SUPPORT_PREPARED_MEMORY_H_
#define STARFOCUS_TESTS_SUPPORT_PREPARED_MEMORY_H_

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace test {

class PreparedMemory {
 public:
  explicit PreparedMemory(const sf_config& config) {
    REQUIRE(sf_prepared_size(&config, &bytes) == SF_OK);
    memory_.assign(bytes + SF_ALIGNMENT, kPoison);
  }
  uint8_t* get() {
    const auto address = reinterpret_cast<uintptr_t>(memory_.data());
    return memory_.data() + (SF_ALIGNMENT - address % SF_ALIGNMENT) % SF_ALIGNMENT;
  }
  // What sf_prepare makes of a light field there.
  sf_prepared* Prepare(sf_engine* engine, const sf_light_field& field) {
    sf_prepared* prepared = nullptr;
    REQUIRE(sf_prepare(engine, &field, get(), bytes, &prepared) == SF_OK);
    return prepared;
  }

  size_t bytes = 0;

 private:
  std::vector<uint8_t> memory_;
};

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_PREPARED_MEMORY_H_
