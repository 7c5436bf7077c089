// SPDX-License-Identifier: Apache-2.0
// Tables between the codes of pictures and light. Light is the quantity that a lens adds up.
#ifndef STARFOCUS_LIB_BASE_TRANSFER_H_
#define STARFOCUS_LIB_BASE_TRANSFER_H_

#include <cstdint>

#include "simd/light.h"
#include "starfocus/starfocus.h"

namespace starfocus {

using simd::kLightBits;
using simd::kLightWhite;

// Returns the tables of a transfer function. Their `light` and `samples` are never null.
// STARFOCUS_TRANSFER_SRGB follows IEC 61966-2-1; with STARFOCUS_TRANSFER_NONE, light is
// proportional to the code. The light of a code is rounded to the
// nearest level. The code of a light level is the code that is nearest to the level on the scale of
// codes.
const simd::Encoding& TransferOf(int32_t transfer);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_TRANSFER_H_
