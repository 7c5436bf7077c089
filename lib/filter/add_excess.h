// SPDX-License-Identifier: Apache-2.0
// The last step of highlights: what they are beyond white is added to a picture.
#ifndef STARFOCUS_LIB_FILTER_ADD_EXCESS_H_
#define STARFOCUS_LIB_FILTER_ADD_EXCESS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/transfer.h"
#include "simd/kernels.h"

namespace starfocus {

// What is added, with kExcessBits: highlights - 1.
inline constexpr int kExcessBits = 8;
int32_t ExcessFactor(float highlights);

struct ExcessSum {
  const simd::Kernels* kernels;
  const Transfer* transfer;
  int32_t factor;  // 0: nothing is added
};

// Adds the excess of sums (lib/input/excess.h), which have `shift` fractional bits, to codes, as
// light. Light beyond white becomes white; where the sums are 0, codes stay.
void AddExcess(const ExcessSum& excess, const uint32_t* sums, size_t count, int shift,
               uint8_t* codes);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_ADD_EXCESS_H_
