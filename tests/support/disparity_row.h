// Random rows of disparities for tests of kernels.
#ifndef STARFOCUS_TESTS_SUPPORT_DISPARITY_ROW_H_
#define STARFOCUS_TESTS_SUPPORT_DISPARITY_ROW_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/test_scene.h"

namespace test {

// Disparities with runs and edges, also at the ends of the range.
inline std::vector<int16_t> DisparityRow(size_t count, Random* random) {
  std::vector<int16_t> row(count);
  int value = random->Int(-2000, 2000);
  for (int16_t& disparity : row) {
    if (random->Int(0, 5) == 0) value += random->Int(-200, 200);
    disparity = int16_t(random->Int(0, 60) == 0 ? random->Int(-32000, 32000) : value);
  }
  return row;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_DISPARITY_ROW_H_
