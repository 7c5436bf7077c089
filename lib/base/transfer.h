// SPDX-License-Identifier: Apache-2.0
// How codes of the pictures stand for light, which is what a lens adds.
#ifndef STARFOCUS_LIB_BASE_TRANSFER_H_
#define STARFOCUS_LIB_BASE_TRANSFER_H_

#include <cstdint>

#include "simd/light.h"
#include "starfocus/starfocus.h"

namespace starfocus {

using simd::kLightBits;
using simd::kLightWhite;

struct Transfer {
  const int16_t* light;     // of each of the 256 codes
  simd::Encoding encoding;  // the same for kernels, which do without tables where they can
};

// The tables of a transfer: STARFOCUS_TRANSFER_SRGB those of IEC 61966-2-1, STARFOCUS_TRANSFER_NONE
// those of light that is the code itself. Light of a code is rounded to the nearest level; of
// light, the code is that whose own light is nearest in codes.
const Transfer& TransferOf(int32_t transfer);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_TRANSFER_H_
