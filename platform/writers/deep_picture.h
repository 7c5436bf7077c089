// SPDX-License-Identifier: Apache-2.0
// Writes pictures of more than 8 bits in the format that the extension of their file name selects:
// PNG and TIFF of 16 bits, OpenEXR of half floats, and AVIF and HEIC of 10 bits.
#ifndef STARFOCUS_PLATFORM_WRITERS_DEEP_PICTURE_H_
#define STARFOCUS_PLATFORM_WRITERS_DEEP_PICTURE_H_

#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/result.h"
#include "platform/writers/picture.h"

namespace starfocus {

// List of the extensions that WriteDeepImage supports, for use in error messages.
inline constexpr char kDeepExtensions[] = ".png, .tif, .tiff, .exr, .avif or .heic";

// Returns true if WriteDeepImage supports `extension`, in lower case with its dot.
bool IsDeepExtension(const std::string& extension);

// Returns an error if this build cannot encode the format that the extension of `path` selects.
Error CheckDeepEncoder(const std::string& path);

struct DeepOptions {
  // Quality of AVIF and HEIC, metadata, and size of PNG. The primaries of `metadata.colours` apply
  // to the picture in all formats; their transfer is that of the picture.
  PictureOptions picture;
  // starfocus_transfer of half floats in formats of codes. Codes keep their own transfer.
  int32_t transfer = STARFOCUS_TRANSFER_SRGB;
};

// Encodes a picture in the format that the extension of `path` selects. Half floats become codes of
// options.transfer in formats of codes, and codes become half floats in OpenEXR. Transfers other
// than sRGB are described by code points of H.273 (cICP in PNG, nclx in AVIF and HEIC), which
// override the ICC profile. Adds a note for clipped samples and for each property that the format
// does not keep. Does not write a file: `path` appears only in error messages.
Result<Bytes> EncodeDeepPicture(const std::string& path, const DeepImage& image,
                                const DeepOptions& options, std::vector<std::string>* notes);

// Writes a picture. The file appears only when it is complete, as for WriteImage.
Error WriteDeepImage(const std::string& path, const DeepImage& image, const DeepOptions& options,
                     std::vector<std::string>* notes);

// Returns an error if WriteDeepImage does not support the extension of `path` or this build lacks
// the encoder, or if the folder does not exist. Call CheckDeepOutput before long computations.
Error CheckDeepOutput(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_DEEP_PICTURE_H_
