// SPDX-License-Identifier: Apache-2.0
// Poisoned memory that has exactly the size of a prepared light field.
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
  explicit PreparedMemory(const Engine& engine) : PreparedMemory(engine.config()) {}
  explicit PreparedMemory(const starfocus_config& config) {
    REQUIRE(starfocus_prepared_size(&config, &bytes, nullptr) == STARFOCUS_OK);
    memory_.assign(bytes + STARFOCUS_ALIGNMENT, kPoison);
  }
  uint8_t* get() {
    const auto address = reinterpret_cast<uintptr_t>(memory_.data());
    return memory_.data() +
           (STARFOCUS_ALIGNMENT - address % STARFOCUS_ALIGNMENT) % STARFOCUS_ALIGNMENT;
  }
  // Prepares a light field in the memory of this object.
  starfocus_prepared* Prepare(starfocus_engine* engine, const starfocus_light_field& field) {
    starfocus_prepared* prepared = nullptr;
    REQUIRE(starfocus_prepare(engine, &field, get(), bytes, &prepared) == STARFOCUS_OK);
    return prepared;
  }

  size_t bytes = 0;

 private:
  std::vector<uint8_t> memory_;
};

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_PREPARED_MEMORY_H_
