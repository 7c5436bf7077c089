// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps and mattes from files of any supported format. The content of a file
// determines the format, not the name.
#ifndef STARFOCUS_PLATFORM_DEPTH_FILE_H_
#define STARFOCUS_PLATFORM_DEPTH_FILE_H_

#include <string>

#include "platform/file.h"
#include "platform/levels.h"
#include "platform/result.h"

namespace starfocus {

// Decodes a depth map or, if `alpha` is kTaken, a matte: PFM, NPY (decoders/npy.h), NPZ
// (decoders/npz.h), TIFF (decoders/tiff.h), OpenEXR (decoders/exr.h), or a picture (levels.h).
// `alpha` applies to pictures. `where` appears only in error messages, which state how to convert
// files of other formats.
Result<Samples> DecodeDepthFile(const std::string& where, Alpha alpha, const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DEPTH_FILE_H_
