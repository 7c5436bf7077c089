// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/deep_picture.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <utility>

#include "platform/colour_description.h"
#include "platform/decoders/deep.h"
#include "platform/decoders/limits.h"
#include "platform/deep_image.h"
#include "platform/standard_stream.h"
#include "platform/writers/exr.h"
#include "platform/writers/heif.h"
#include "platform/writers/tiff.h"

namespace starfocus {
namespace {

using Notes = std::vector<std::string>;

constexpr int kLinearCode = 8, kSrgbCode = 13, kPqCode = 16, kHlgCode = 18;  // of H.273

bool IsTiffExtension(const std::string& extension) {
  return extension == ".tif" || extension == ".tiff";
}

int TransferCodeOf(int32_t transfer) {
  return transfer == STARFOCUS_TRANSFER_PQ     ? kPqCode
         : transfer == STARFOCUS_TRANSFER_HLG  ? kHlgCode
         : transfer == STARFOCUS_TRANSFER_NONE ? kLinearCode
                                               : kSrgbCode;
}

const char* NameOfTransfer(int32_t transfer) {
  return transfer == STARFOCUS_TRANSFER_PQ     ? "PQ"
         : transfer == STARFOCUS_TRANSFER_HLG  ? "HLG"
         : transfer == STARFOCUS_TRANSFER_NONE ? "linear light"
                                               : "sRGB";
}

// Describes the brightest light that codes of a transfer can store.
std::string LimitOf(int32_t transfer) {
  if (!IsHdr(transfer)) return "white";
  return std::string("the brightest code of ") + NameOfTransfer(transfer);
}

// Converts a picture to codes, and adds a note about samples that codes cannot store.
DeepImage CodesOf(const DeepImage& image, int32_t transfer, Notes* notes) {
  if (!image.is_half) return image;
  ClippedSamples clipped;
  DeepImage codes = ToCodes(image, transfer, &clipped);
  if (clipped.any()) notes->push_back("clipped: " + Describe(clipped, LimitOf(transfer)));
  return codes;
}

// Returns the metadata of a file of codes: sRGB has the description or the profile of the caller,
// and other transfers have code points, which override a profile.
Metadata MetadataOf(const DeepOptions& options, int32_t transfer, Notes* notes) {
  Metadata metadata = options.picture.metadata;
  ColourDescription& colours = metadata.colours;
  if (transfer == STARFOCUS_TRANSFER_SRGB) {
    if (colours.form.empty()) return metadata;
    colours.transfer = kSrgbCode;
    // A profile describes primaries that have no code point.
    if (metadata.icc.empty() && !IsSrgb(colours)) metadata.icc = ProfileOf(colours);
    colours = {};
    return metadata;
  }
  // A profile that describes linear light needs no code points.
  if (transfer == STARFOCUS_TRANSFER_NONE && !metadata.icc.empty()) {
    colours = {};
    return metadata;
  }
  const int primaries = PrimariesCodeOf(colours);
  if (primaries == ColourDescription::kUnspecified) {
    notes->push_back("the file does not keep the primaries, which have no code point");
  }
  colours = {kCicpForm, primaries, TransferCodeOf(transfer)};
  metadata.icc.clear();
  return metadata;
}

// Adds a note about metadata that files with this extension do not have.
void NoteMetadata(const std::string& extension, const Metadata& metadata, Notes* notes) {
  const bool is_tiff = IsTiffExtension(extension), is_png = extension == ".png";
  const bool loses_exif = (is_tiff || extension == ".exr") && !metadata.exif.empty();
  const bool loses_captions = !is_tiff && !is_png && !metadata.xmp.empty();
  if (!loses_exif && !loses_captions) return;
  notes->push_back(std::string("the file does not keep ") + (!loses_captions ? "EXIF"
                                                             : loses_exif    ? "EXIF and captions"
                                                                             : "captions"));
}

Result<Bytes> EncodeHalf(const std::string& path, const DeepImage& image,
                         const DeepOptions& options, Notes* notes) {
  const Metadata& metadata = options.picture.metadata;
  if (!metadata.icc.empty() && metadata.colours.form.empty()) {
    notes->push_back(
        "OpenEXR files do not keep the ICC profile, so that the colours count as BT.709");
  }
  return EncodeExr(path, image.is_half ? image : ToHalf(image), metadata.colours);
}

Result<Bytes> EncodeTiffCodes(const std::string& path, const DeepImage& codes, Metadata metadata) {
  if (IsHdr(codes.transfer)) {
    return Expected(path, "the extension .png, .exr, .avif or .heic for a picture of PQ or HLG",
                    "a TIFF file, which does not describe them");
  }
  if (!metadata.colours.form.empty()) metadata.icc = ProfileOf(metadata.colours);
  return EncodeTiff(path, codes, metadata);
}

Error CheckDeepExtension(const std::string& path) {
  const std::string extension = FormatExtension(path);
  if (IsDeepExtension(extension)) return {};
  return Expected(path, std::string("a name ending in ") + kDeepExtensions,
                  extension.empty() ? "no extension" : extension);
}

}  // namespace

bool IsDeepExtension(const std::string& extension) {
  constexpr const char* kExtensions[] = {".png", ".tif", ".tiff", ".exr", ".avif", ".heic"};
  return std::find(std::begin(kExtensions), std::end(kExtensions), extension) !=
         std::end(kExtensions);
}

Error CheckDeepEncoder(const std::string& path) {
  const std::string extension = FormatExtension(path);
  if (extension == ".exr") return CheckExrEncoder(path);
  if (IsTiffExtension(extension)) return CheckTiffEncoder(path);
  if (extension == ".avif" || extension == ".heic") {
    return CheckHeifEncoder(path, extension == ".avif");
  }
  return {};
}

Result<Bytes> EncodeDeepPicture(const std::string& path, const DeepImage& image,
                                const DeepOptions& options, std::vector<std::string>* notes) {
  if (Error error = CheckPictureSize(path, image.width, image.height)) return error;
  if (Error error = CheckDeepEncoder(path)) return error;
  const std::string extension = FormatExtension(path);
  NoteMetadata(extension, options.picture.metadata, notes);
  if (extension == ".exr") return EncodeHalf(path, image, options, notes);
  const DeepImage codes = CodesOf(image, options.transfer, notes);
  const Metadata metadata = MetadataOf(options, codes.transfer, notes);
  if (extension == ".png") return EncodeDeepPng(path, codes, metadata, options.picture.png_size);
  if (IsTiffExtension(extension)) return EncodeTiffCodes(path, codes, metadata);
  return EncodeHeif(path, codes, metadata, options.picture.quality, extension == ".avif");
}

Error WriteDeepImage(const std::string& path, const DeepImage& image, const DeepOptions& options,
                     std::vector<std::string>* notes) {
  if (Error error = CheckDeepExtension(path)) return error;
  try {
    return WriteFile(path, EncodeDeepPicture(path, image, options, notes));
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "write it");
  }
}

Error CheckDeepOutput(const std::string& path) {
  Error error = CheckDeepExtension(path);
  if (!error) error = CheckOutputPath(path);
  if (!error) error = CheckDeepEncoder(path);
  if (!error && IsStandardStream(path) && isatty(STDOUT_FILENO) == 1) {
    error = Expected(path, "a file or pipe for a picture", "a terminal");
  }
  return error;
}

}  // namespace starfocus
