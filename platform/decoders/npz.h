// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps in NumPy's format NPZ: a ZIP archive of arrays in the format NPY.
#ifndef STARFOCUS_PLATFORM_DECODERS_NPZ_H_
#define STARFOCUS_PLATFORM_DECODERS_NPZ_H_

#include <string>

#include "platform/file.h"
#include "platform/levels.h"
#include "platform/result.h"

namespace starfocus {

// Decodes the array named "depth" or, if `is_matte` is true, "matte", then "alpha"; otherwise the
// only array of rows and columns. Ignores arrays of booleans, unless `is_matte` is true, and
// matrices of at most 4x4 values if another array has rows and columns: estimators store masks and
// camera matrices together with a map. If several arrays may be the map, the error lists their
// names. `where` appears only in error messages.
Result<Samples> DecodeNpz(const std::string& where, bool is_matte, const Bytes& npz);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_NPZ_H_
