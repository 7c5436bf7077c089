// SPDX-License-Identifier: Apache-2.0
#ifndef STARFOCUS_TESTS_SUPPORT_PSNR_H_
#define STARFOCUS_TESTS_SUPPORT_PSNR_H_

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace test {

// Returns the PSNR of two pictures in dB, or 99 if the pictures are equal.
inline double Psnr(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum == 0 ? 99 : 10 * std::log10(255.0 * 255.0 * double(a.size()) / sum);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_PSNR_H_
