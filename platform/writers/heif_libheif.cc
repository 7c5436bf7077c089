// SPDX-License-Identifier: Apache-2.0
// Encodes AVIF and HEIC with libheif.
#include "platform/writers/heif.h"

#include <libheif/heif.h>

#include <cstring>
#include <exception>
#include <memory>
#include <new>

#include "platform/decoders/numbers.h"
#include "platform/icc_profile.h"
#include "platform/writers/exif.h"

namespace starfocus {
namespace {

// Returns the bits of a sample: 10. libheif 1.15 requests the wrong profile for 10 bits from libaom
// 3.6, which then aborts the program (libheif issue 788), and encodes 12 bits correctly.
int BitsOf(bool is_avif) {
  constexpr uint32_t kVersion16 = 0x01100000;
  return is_avif && heif_get_version_number() < kVersion16 ? 12 : 10;
}

template <class Type, void (*kFree)(Type*)>
struct FreedHeif {
  void operator()(Type* what) const { kFree(what); }
};
void ReleaseEncoder(heif_encoder* encoder) { heif_encoder_release(encoder); }
void ReleaseWritten(heif_image* image) { heif_image_release(image); }
void ReleaseWrittenHandle(heif_image_handle* handle) { heif_image_handle_release(handle); }
void FreeNclx(heif_color_profile_nclx* nclx) { heif_nclx_color_profile_free(nclx); }
void FreeOptions(heif_encoding_options* options) { heif_encoding_options_free(options); }

using HeifContext = std::unique_ptr<heif_context, FreedHeif<heif_context, heif_context_free>>;
using HeifEncoder = std::unique_ptr<heif_encoder, FreedHeif<heif_encoder, ReleaseEncoder>>;
using HeifImage = std::unique_ptr<heif_image, FreedHeif<heif_image, ReleaseWritten>>;
using HeifHandle =
    std::unique_ptr<heif_image_handle, FreedHeif<heif_image_handle, ReleaseWrittenHandle>>;
using HeifNclx =
    std::unique_ptr<heif_color_profile_nclx, FreedHeif<heif_color_profile_nclx, FreeNclx>>;
using HeifOptions =
    std::unique_ptr<heif_encoding_options, FreedHeif<heif_encoding_options, FreeOptions>>;

Error FailedToWrite(const std::string& path, const heif_error& error) {
  if (error.code == heif_error_Memory_allocation_error) return OutOfMemory(path, "write it");
  return Expected(path, "a picture that libheif can write",
                  error.message == nullptr ? "an unknown error" : error.message);
}

heif_compression_format FormatOf(bool is_avif) {
  return is_avif ? heif_compression_AV1 : heif_compression_HEVC;
}

// Copies the samples, rounded from 16 to `bits` bits.
heif_error TakeSamples(const DeepImage& image, int bits, heif_image* to) {
  const heif_error failure =
      heif_image_add_plane(to, heif_channel_interleaved, image.width, image.height, bits);
  if (failure.code != heif_error_Ok) return failure;
  int stride = 0;
  uint8_t* rows = heif_image_get_plane(to, heif_channel_interleaved, &stride);
  const uint32_t most = (uint32_t{1} << bits) - 1;
  for (int y = 0; y < image.height; ++y) {
    const uint16_t* from = image.row(y);
    uint8_t* row = rows + size_t(y) * size_t(stride);
    for (size_t k = 0; k < image.row_samples(); ++k) {
      const auto sample = static_cast<uint16_t>((from[k] * most + 32767) / 65535);
      std::memcpy(row + 2 * k, &sample, sizeof(sample));
    }
  }
  return failure;
}

// Describes the colours by code points, and by the profile if there is one. The matrix of BT.2020
// belongs to its primaries; other pictures have the matrix of BT.601, as JPEG.
HeifNclx TakeColours(const Metadata& metadata, heif_image* image) {
  constexpr int kBt2020 = 9, kBt709 = 1, kSrgb = 13;
  HeifNclx nclx(heif_nclx_color_profile_alloc());
  if (nclx == nullptr) throw std::bad_alloc();
  ColourDescription colours = metadata.colours;
  if (colours.form.empty()) {
    colours = metadata.icc.empty() ? ColourDescription{"sRGB", kBt709, kSrgb}
                                   : DescriptionOf(metadata.icc).value_or(ColourDescription());
  }
  constexpr int kLargestCode = 255;
  const auto code_of = [](int code) {
    return static_cast<uint16_t>(code > kLargestCode ? ColourDescription::kUnspecified : code);
  };
  const int primaries = code_of(colours.primaries);
  heif_nclx_color_profile_set_color_primaries(nclx.get(), code_of(colours.primaries));
  heif_nclx_color_profile_set_transfer_characteristics(nclx.get(), code_of(colours.transfer));
  nclx->matrix_coefficients = primaries == kBt2020
                                  ? heif_matrix_coefficients_ITU_R_BT_2020_2_non_constant_luminance
                                  : heif_matrix_coefficients_ITU_R_BT_601_6;
  nclx->full_range_flag = 1;
  if (!metadata.icc.empty()) {
    heif_image_set_raw_color_profile(image, "prof", metadata.icc.data(), metadata.icc.size());
  }
  heif_image_set_nclx_color_profile(image, nclx.get());
  return nclx;
}

heif_error AppendHeif(heif_context*, const void* data, size_t size, void* bytes) {
  const auto* first = static_cast<const uint8_t*>(data);
  try {
    auto* to = static_cast<Bytes*>(bytes);
    to->insert(to->end(), first, first + size);
    return {heif_error_Ok, heif_suberror_Unspecified, ""};
  } catch (const std::bad_alloc&) {  // exceptions must not pass C functions
    return {heif_error_Memory_allocation_error, heif_suberror_Unspecified, "out of memory"};
  }
}

Result<Bytes> EncodeUnguarded(const std::string& path, const DeepImage& image,
                              const Metadata& metadata, int quality, bool is_avif) {
  const HeifContext context(heif_context_alloc());
  heif_encoder* raw_encoder = nullptr;
  heif_error failure =
      heif_context_get_encoder_for_format(context.get(), FormatOf(is_avif), &raw_encoder);
  const HeifEncoder encoder(raw_encoder);
  if (failure.code != heif_error_Ok) return FailedToWrite(path, failure);
  heif_encoder_set_lossy_quality(encoder.get(), quality);
  heif_encoder_set_parameter_string(encoder.get(), "chroma", "444");
  const bool is_little = kOwnByteOrder == ByteOrder::kLittle, has_alpha = image.channels == 4;
  const heif_chroma chroma = is_little   ? has_alpha ? heif_chroma_interleaved_RRGGBBAA_LE
                                                     : heif_chroma_interleaved_RRGGBB_LE
                             : has_alpha ? heif_chroma_interleaved_RRGGBBAA_BE
                                         : heif_chroma_interleaved_RRGGBB_BE;
  heif_image* raw_image = nullptr;
  failure = heif_image_create(image.width, image.height, heif_colorspace_RGB, chroma, &raw_image);
  const HeifImage pixels(raw_image);
  if (failure.code == heif_error_Ok) failure = TakeSamples(image, BitsOf(is_avif), raw_image);
  if (failure.code != heif_error_Ok) return FailedToWrite(path, failure);
  const HeifNclx nclx = TakeColours(metadata, raw_image);
  const HeifOptions options(heif_encoding_options_alloc());
  if (options == nullptr) return OutOfMemory(path, "write it");
  options->output_nclx_profile = nclx.get();
  options->macOS_compatibility_workaround_no_nclx_profile = 0;
  options->save_two_colr_boxes_when_ICC_and_nclx_available = 1;
  heif_image_handle* raw_handle = nullptr;
  failure = heif_context_encode_image(context.get(), raw_image, encoder.get(), options.get(),
                                      &raw_handle);
  const HeifHandle handle(raw_handle);
  if (failure.code != heif_error_Ok) return FailedToWrite(path, failure);
  const Bytes exif = EditedExif(metadata.exif, image.width, image.height);
  if (!exif.empty()) {
    failure = heif_context_add_exif_metadata(context.get(), raw_handle, exif.data(),
                                             static_cast<int>(exif.size()));
    if (failure.code != heif_error_Ok) return FailedToWrite(path, failure);
  }
  Bytes bytes;
  heif_writer writer = {1, AppendHeif};
  failure = heif_context_write(context.get(), &writer, &bytes);
  if (failure.code != heif_error_Ok) return FailedToWrite(path, failure);
  return bytes;
}

}  // namespace

Error CheckHeifEncoder(const std::string& path, bool is_avif) {
  if (heif_have_encoder_for_format(FormatOf(is_avif)) != 0) return {};
  return Unsupported(path, is_avif ? "AVIF" : "HEIC",
                     is_avif ? "an encoder of libheif for AV1" : "an encoder of libheif for HEVC");
}

Result<Bytes> EncodeHeif(const std::string& path, const DeepImage& image, const Metadata& metadata,
                         int quality, bool is_avif) {
  try {
    return EncodeUnguarded(path, image, metadata, quality, is_avif);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {  // C functions of libheif may throw C++ exceptions
    return Expected(path, "a picture that libheif can write", failure.what());
  }
}

}  // namespace starfocus
