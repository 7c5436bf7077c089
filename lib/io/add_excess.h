// SPDX-License-Identifier: Apache-2.0
// Last step of rendering highlights: adds the excess, which is the light beyond white, to a
// picture.
#ifndef STARFOCUS_LIB_IO_ADD_EXCESS_H_
#define STARFOCUS_LIB_IO_ADD_EXCESS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/transfer.h"
#include "simd/kernels.h"

namespace starfocus {

// Returns the factor of the excess, highlights - 1, with kExcessBits fractional bits.
inline constexpr int kExcessBits = 8;
int32_t ExcessFactor(float highlights);

struct ExcessSum {
  const simd::Kernels* kernels;
  const Transfer* transfer;
  int32_t factor;  // factor of the excess, with kExcessBits; a factor of 0 adds nothing
};

// Adds the excess in `sums` (lib/io/excess.h) to the light of `codes`. The sums have `shift`
// fractional bits. Results beyond white are clipped to white. Sums of 0 do not change the codes.
void AddExcess(const ExcessSum& excess, const uint32_t* sums, size_t count, int shift,
               uint8_t* codes);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_ADD_EXCESS_H_
