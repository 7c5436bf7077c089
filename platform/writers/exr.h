// SPDX-License-Identifier: Apache-2.0
// Writes OpenEXR files.
#ifndef STARFOCUS_PLATFORM_WRITERS_EXR_H_
#define STARFOCUS_PLATFORM_WRITERS_EXR_H_

#include <string>

#include "platform/colour_description.h"
#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Encodes half floats as one part with the channels R, G, B and, if the picture has it, A,
// compressed by Deflate in blocks of 16 rows (ZIP). Writes the chromaticities of `colours` unless
// they are those of BT.709, which OpenEXR assumes. Requires OpenEXR. `path` appears only in error
// messages.
Result<Bytes> EncodeExr(const std::string& path, const DeepImage& half,
                        const ColourDescription& colours);

// Returns an error if this build lacks OpenEXR.
Error CheckExrEncoder(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_EXR_H_
