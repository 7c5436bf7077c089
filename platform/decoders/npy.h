// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps in NumPy's format NPY, versions 1 to 3: a header in text form and the values
// of one array.
#ifndef STARFOCUS_PLATFORM_DECODERS_NPY_H_
#define STARFOCUS_PLATFORM_DECODERS_NPY_H_

#include <string>

#include "platform/file.h"
#include "platform/levels.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if the bytes start with the signature of NPY files.
bool IsNpy(const Bytes& bytes);

// Decodes an array in C order with two dimensions, rows and columns. Further dimensions before or
// after these two must be 1. The values are little-endian: 32-bit or 64-bit floats, or integers of
// type u1, u2 or i2. 64-bit floats beyond the range of float become infinite. `where` appears only
// in error messages.
Result<Samples> DecodeNpy(const std::string& where, const Bytes& npy);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_NPY_H_
