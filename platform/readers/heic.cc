// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/heic.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>
#include <memory>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "platform/container.h"
#include "platform/readers/heif_boxes.h"

#ifdef STARFOCUS_HAS_HEIF
#include <libheif/heif.h>

#include "platform/decoders/deep.h"
#include "platform/decoders/numbers.h"
#include "platform/helper/decoder_threads.h"
#include "platform/readers/apple_depth.h"
#include "platform/readers/apple_gain_map.h"
#include "platform/readers/apple_mattes.h"
#include "platform/readers/deep_photo.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/exif.h"
#include "platform/readers/gain_map.h"
#include "platform/readers/heif_limits.h"
#include "platform/readers/kept_metadata.h"
#include "platform/readers/orientation.h"
#include "platform/readers/profile.h"
#include "platform/readers/sample_bits.h"
#endif

namespace starfocus {

bool IsHeif(Span file) {
  constexpr const char* kBrands[] = {"heic", "heix", "hevc", "hevx", "heim", "heis",
                                     "mif1", "mif2", "msf1", "avif", "avis", "miaf"};
  for (const std::string& brand : HeifBrands(file)) {
    if (std::find(std::begin(kBrands), std::end(kBrands), brand) != std::end(kBrands)) return true;
  }
  return false;
}

#ifdef STARFOCUS_HAS_HEIF

namespace {

constexpr int kMostSide = 16384;
constexpr size_t kMostMetadata = size_t{1} << 26;

template <class Type, void (*kFree)(Type*)>
struct Freed {
  void operator()(Type* what) const { kFree(what); }
};
void ReleaseHandle(heif_image_handle* handle) { heif_image_handle_release(handle); }
void ReleaseImage(heif_image* image) { heif_image_release(image); }
using Context = std::unique_ptr<heif_context, Freed<heif_context, heif_context_free>>;
using Handle = std::unique_ptr<heif_image_handle, Freed<heif_image_handle, ReleaseHandle>>;
using Decoded = std::unique_ptr<heif_image, Freed<heif_image, ReleaseImage>>;

Error Broken(const std::string& where, const heif_error& error) {
  return Expected(where, "a HEIF file that libheif can read",
                  error.message == nullptr ? "an unknown error" : error.message);
}

Error CheckSize(const std::string& where, const heif_image_handle* handle, size_t file) {
  return CheckHeifSize(where, heif_image_handle_get_width(handle),
                       heif_image_handle_get_height(handle), file);
}

Result<Decoded> Decode(const std::string& where, const heif_image_handle* handle,
                       heif_colorspace colours, heif_chroma chroma) {
  heif_image* raw = nullptr;
  const heif_error failure = heif_decode_image(handle, &raw, colours, chroma, nullptr);
  Decoded decoded(raw);
  if (failure.code != heif_error_Ok) return Broken(where, failure);
  return decoded;
}

Result<Image> DecodePicture(const std::string& where, const heif_image_handle* handle) {
  const Result<Decoded> decoded =
      Decode(where, handle, heif_colorspace_RGB, heif_chroma_interleaved_RGB);
  if (!decoded) return decoded.error();
  const heif_image* raw = decoded->get();
  if (!heif_image_has_channel(raw, heif_channel_interleaved)) {
    return Expected(where, "a decoded picture", "none");
  }
  int stride = 0;
  const uint8_t* rows = heif_image_get_plane_readonly(raw, heif_channel_interleaved, &stride);
  const int width = heif_image_get_width(raw, heif_channel_interleaved);
  const int height = heif_image_get_height(raw, heif_channel_interleaved);
  if (rows == nullptr || width < 1 || height < 1) {
    return Expected(where, "a decoded picture", "none");
  }
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    std::memcpy(image.row(y), rows + size_t(y) * size_t(stride), image.stride());
  }
  return image;
}

// Decodes a picture of more than 8 bits or with alpha to codes of 16 bits.
Result<DeepImage> DecodeCodes(const std::string& where, const heif_image_handle* handle) {
  const bool is_wide = heif_image_handle_get_luma_bits_per_pixel(handle) > 8,
             is_little = kOwnByteOrder == ByteOrder::kLittle,
             has_alpha = heif_image_handle_has_alpha_channel(handle) != 0;
  const heif_chroma wide = is_little   ? has_alpha ? heif_chroma_interleaved_RRGGBBAA_LE
                                                   : heif_chroma_interleaved_RRGGBB_LE
                           : has_alpha ? heif_chroma_interleaved_RRGGBBAA_BE
                                       : heif_chroma_interleaved_RRGGBB_BE;
  const Result<Decoded> decoded =
      Decode(where, handle, heif_colorspace_RGB, is_wide ? wide : heif_chroma_interleaved_RGBA);
  if (!decoded) return decoded.error();
  const heif_image* raw = decoded->get();
  if (!heif_image_has_channel(raw, heif_channel_interleaved)) {
    return Expected(where, "a decoded picture", "none");
  }
  int stride = 0;
  const uint8_t* rows = heif_image_get_plane_readonly(raw, heif_channel_interleaved, &stride);
  const int bits = is_wide ? heif_image_get_bits_per_pixel_range(raw, heif_channel_interleaved) : 8;
  DeepImage deep(heif_image_get_width(raw, heif_channel_interleaved),
                 heif_image_get_height(raw, heif_channel_interleaved),
                 has_alpha || !is_wide ? 4 : 3);
  if (rows == nullptr || deep.samples.empty() || bits < 8 || bits > 16) {
    return Expected(where, "a picture of 8 to 16 bits", "another bit depth");
  }
  const auto most = (uint32_t{1} << bits) - 1;
  for (int y = 0; y < deep.height; ++y) {
    const uint8_t* row = rows + size_t(y) * size_t(stride);
    uint16_t* to = deep.row(y);
    for (size_t k = 0; k < deep.row_samples(); ++k) {
      uint16_t code = row[k];
      if (is_wide) std::memcpy(&code, row + 2 * k, sizeof(code));
      to[k] = static_cast<uint16_t>((std::min<uint32_t>(code, most) * 65535U + most / 2) / most);
    }
  }
  if (has_alpha && heif_image_handle_is_premultiplied_alpha(handle) != 0) DivideByAlpha(&deep);
  return deep;
}

// Returns the levels of a depth map, 0 to 1. If samples have more than 8 bits, libheif stores
// 16-bit integers in the byte order of the machine.
Result<FloatMap> DecodePlane(const std::string& where, const heif_image_handle* handle) {
  const Result<Decoded> decoded =
      Decode(where, handle, heif_colorspace_undefined, heif_chroma_undefined);
  if (!decoded) return decoded.error();
  const heif_image* raw = decoded->get();
  // libheif 1.15 aborts the program if a missing channel is requested.
  const heif_channel channel =
      heif_image_has_channel(raw, heif_channel_Y) ? heif_channel_Y : heif_channel_G;
  if (!heif_image_has_channel(raw, channel)) {
    return Expected(where, "a picture with grey levels", "none");
  }
  int stride = 0;
  const uint8_t* rows = heif_image_get_plane_readonly(raw, channel, &stride);
  const int bits = heif_image_get_bits_per_pixel_range(raw, channel);
  const int width = heif_image_get_width(raw, channel);
  const int height = heif_image_get_height(raw, channel);
  if (rows == nullptr || bits < 1 || bits > 16 || width < 1 || height < 1) {
    return Expected(where, "a picture of 8 to 16 bits", "another bit depth");
  }
  FloatMap map = {width, height, {}};
  map.values.reserve(size_t(width) * size_t(height));
  const float most = static_cast<float>((1 << bits) - 1);
  for (int y = 0; y < height; ++y) {
    const uint8_t* row = rows + size_t(y) * size_t(stride);
    for (int x = 0; x < width; ++x) {
      uint16_t level = row[x];
      if (bits > 8) std::memcpy(&level, row + 2 * size_t(x), sizeof(level));
      map.values.push_back(static_cast<float>(level) / most);
    }
  }
  return map;
}

// Returns the first metadata block of a type, or an empty result if the file has no such block.
Bytes ReadMetadata(const heif_image_handle* handle, const char* type, const char* content) {
  heif_item_id ids[16];
  const int count = heif_image_handle_get_list_of_metadata_block_IDs(handle, type, ids, 16);
  for (int k = 0; k < count && k < 16; ++k) {
    const char* its = heif_image_handle_get_metadata_content_type(handle, ids[k]);
    if (content != nullptr && (its == nullptr || std::strcmp(its, content) != 0)) continue;
    const size_t size = heif_image_handle_get_metadata_size(handle, ids[k]);
    if (size == 0 || size > kMostMetadata) continue;
    Bytes bytes(size);
    if (heif_image_handle_get_metadata(handle, ids[k], bytes.data()).code == heif_error_Ok) {
      return bytes;
    }
  }
  return {};
}

// Reads the code points of the box nclx, unless they are unspecified. The decoded pixels have the
// full range.
void ReadCodePoints(const heif_image_handle* handle, ColourDescription* colours) {
  heif_color_profile_nclx* nclx = nullptr;
  if (heif_image_handle_get_nclx_color_profile(handle, &nclx).code != heif_error_Ok) return;
  constexpr int kUnspecified = ColourDescription::kUnspecified;
  const int primaries = nclx->color_primaries, transfer = nclx->transfer_characteristics;
  heif_nclx_color_profile_free(nclx);
  if (primaries == kUnspecified && transfer == kUnspecified) return;
  *colours = {"nclx", primaries, transfer};
}

// Reads the code points and, unless they are those of PQ or HLG, the ICC profile.
void ReadColours(const heif_image_handle* handle, Metadata* metadata) {
  ReadCodePoints(handle, &metadata->colours);
  const size_t profile = heif_image_handle_get_raw_color_profile_size(handle);
  if (profile == 0 || profile > kMostMetadata || IsHdr(TransferOf(metadata->colours))) return;
  metadata->icc.resize(profile);
  heif_image_handle_get_raw_color_profile(handle, metadata->icc.data());
}

// Decodes the picture to 8 bits and, if it has more bits, alpha, PQ or HLG, to codes of 16 bits. In
// both cases libheif converts YCbCr to RGB, with its own rounding.
Result<DecodedPicture> DecodeBoth(const std::string& where, const heif_image_handle* handle) {
  DecodedPicture picture;
  ReadColours(handle, &picture.metadata);
  const int bits = heif_image_handle_get_luma_bits_per_pixel(handle);
  const bool is_hdr = IsHdr(TransferOf(ColoursOf(picture.metadata)));
  if (bits > 8 || heif_image_handle_has_alpha_channel(handle) != 0) {
    Result<DeepImage> deep = DecodeCodes(where, handle);
    if (deep) picture.deep = std::move(*deep);
  }
  if (!picture.deep || !is_hdr) {
    if (Error error = DecodePicture(where, handle).MoveTo(&picture.image)) return error;
  }
  CompleteDeep(bits, &picture);
  return picture;
}

void ReadExifItem(const heif_image_handle* handle, DepthPhoto* photo) {
  Bytes exif = ReadMetadata(handle, "Exif", nullptr);
  // The first four bytes of the EXIF item are the offset of the TIFF header, counted from the fifth
  // byte.
  if (exif.size() > 4) {
    const size_t skip = ReadBigEndian32(exif.data());
    if (skip < exif.size() - 4) {
      photo->metadata.exif.assign(exif.begin() + 4 + static_cast<ptrdiff_t>(skip), exif.end());
    }
  }
  // libheif has already rotated the pictures by the transformations of the file. In most HEIF
  // files, EXIF's orientation equals the transformations of the file and therefore applies to the
  // subject. If the size of the picture contradicts EXIF's orientation, the subject is ignored.
  const int stored_width = heif_image_handle_get_ispe_width(handle);
  const int stored_height = heif_image_handle_get_ispe_height(handle);
  ReadExif(stored_width, stored_height, photo);
  const bool swaps = photo->orientation >= 5;
  const bool agrees = photo->picture.width == (swaps ? stored_height : stored_width);
  photo->has_subject = photo->has_subject && agrees;
  TurnPoint(photo->orientation, &photo->subject_x, &photo->subject_y);
  photo->orientation = 1;
  std::vector<std::string>* const notes = photo->deep ? &photo->lost : &photo->notes;
  NoteSampleBits(heif_image_handle_get_luma_bits_per_pixel(handle), notes);
  NoteTransparency(heif_image_handle_has_alpha_channel(handle) != 0, notes);
  ChooseProfile(photo);
}

// Reads the XMP properties that describe the photograph. Ignores XMP that is not well-formed.
void ReadCaptions(const heif_image_handle* handle, DepthPhoto* photo) {
  const Bytes xmp = ReadMetadata(handle, "mime", "application/rdf+xml");
  if (xmp.empty() || !CanReadXmp()) return;
  const auto root = ParseXmp("", reinterpret_cast<const char*>(xmp.data()), xmp.size());
  if (root) photo->metadata.xmp = KeptXmp(*root);
}

// Returns the type of an auxiliary picture, or an empty string if it has no type.
std::string TypeOf(const heif_image_handle* auxiliary) {
  const char* type = nullptr;
  if (heif_image_handle_get_auxiliary_type(auxiliary, &type).code != heif_error_Ok) return "";
  const std::string text = type;
  heif_image_handle_free_auxiliary_types(auxiliary, &type);
  return text;
}

// Lists the auxiliary pictures of a picture, which must remain valid until they are decoded.
// `file` is the size of the file in bytes.
std::vector<AuxiliaryPicture> ListAuxiliaries(const heif_image_handle* primary, size_t file) {
  heif_item_id ids[64];
  const int count = heif_image_handle_get_list_of_auxiliary_image_IDs(primary, 0, ids, 64);
  std::vector<AuxiliaryPicture> pictures;
  for (int k = 0; k < count; ++k) {
    heif_image_handle* raw = nullptr;
    if (heif_image_handle_get_auxiliary_image_handle(primary, ids[k], &raw).code != heif_error_Ok) {
      continue;
    }
    const std::shared_ptr<heif_image_handle> handle(raw, ReleaseHandle);
    pictures.push_back({TypeOf(raw),
                        [handle, file](const std::string& where) -> Result<FloatMap> {
                          if (Error error = CheckSize(where, handle.get(), file)) return error;
                          return DecodePlane(where, handle.get());
                        },
                        ReadMetadata(raw, "mime", "application/rdf+xml")});
  }
  return pictures;
}

// Reads the gain map and the mattes among the auxiliary pictures. Adds an entry to photo->facts if
// an auxiliary picture is a gain map.
void ReadAuxiliaries(const heif_image_handle* primary, size_t file, DepthPhoto* photo) {
  const std::vector<AuxiliaryPicture> pictures = ListAuxiliaries(primary, file);
  for (const AuxiliaryPicture& picture : pictures) {
    if (picture.type.find("gainmap") == std::string::npos) continue;
    const Error problem = ReadAppleGainMap(picture, photo);
    photo->facts.emplace_back("gain map", GainMapFact(photo->gain_map, problem));
    break;
  }
  ChooseMatte(pictures, photo);
  if (photo->map.values.empty() && !photo->matte.values.empty()) {
    photo->format = "HEIF photo with a matte";
  }
}

using Information = heif_depth_representation_info;

// Interprets HEVC's depth representation information (ISO/IEC 23008-2, F.14.2.3).
Error UnderstandInformation(const std::string& where, const Information& information, Near near,
                            DepthPhoto* photo) {
  const auto type = information.depth_representation_type;
  if (type == heif_depth_representation_type_nonuniform_disparity) {
    return Expected(where, "a depth map with uniform steps between levels",
                    "nonuniform disparities");
  }
  photo->meaning = MapMeaning::kInverse;
  if (type == heif_depth_representation_type_uniform_disparity && information.has_d_min &&
      information.has_d_max && information.d_max > information.d_min) {
    ToRange(information.d_min, information.d_max, &photo->map);
    TellMap("disparities from " + std::to_string(information.d_min) + " to " +
                std::to_string(information.d_max) + ", correct up to a factor",
            photo);
    return {};
  }
  const DepthRange range = {type == heif_depth_representation_type_uniform_inverse_Z,
                            information.z_near, information.z_far};
  if (type != heif_depth_representation_type_uniform_disparity && information.has_z_near &&
      information.has_z_far && range.near > 0 && range.far > range.near) {
    // If levels are inverse distances, the largest level is the nearest.
    if (range.inverse) ToRange(1, 0, &photo->map);
    ToInverse(range, &photo->map);
    TellMap("distances from " + std::to_string(range.near) + " to " + std::to_string(range.far) +
                ", correct up to a factor",
            photo);
    return {};
  }
  TellMap("without a range", photo);
  const bool distance = type == heif_depth_representation_type_uniform_Z;
  ToOrder(near != Near::kUnknown ? near : distance ? Near::kBlack : Near::kWhite, photo);
  return {};
}

Error Understand(const std::string& where, const heif_image_handle* primary,
                 const heif_image_handle* depth, heif_item_id id, Near near, DepthPhoto* photo) {
  const Bytes xmp = ReadMetadata(depth, "mime", "application/rdf+xml");
  if (!xmp.empty() && CanReadXmp()) {
    const auto root = ParseXmp("the XMP of the depth map is ignored",
                               reinterpret_cast<const char*>(xmp.data()), xmp.size());
    if (root) {
      UnderstandApple(*root, photo);
      return {};
    }
    photo->notes.push_back(root.error().line());
  }
  const Information* information = nullptr;
  if (heif_image_handle_get_depth_image_representation_info(primary, id, &information) &&
      information != nullptr) {
    const Error error = UnderstandInformation(where, *information, near, photo);
    heif_depth_representation_info_free(information);
    return error;
  }
  TellMap("without a range", photo);
  ToOrder(near, photo);
  return {};
}

Error ReadMap(const std::string& where, const heif_image_handle* primary, size_t file, Near near,
              DepthPhoto* photo) {
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_depth_image_IDs(primary, &id, 1) < 1) return {};
  heif_image_handle* raw = nullptr;
  const heif_error failure = heif_image_handle_get_depth_image_handle(primary, id, &raw);
  const Handle depth(raw);
  if (failure.code != heif_error_Ok) return Broken(where, failure);
  if (Error error = CheckSize(where + " (depth map)", raw, file)) return error;
  if (Error error = DecodePlane(where + " (depth map)", raw).MoveTo(&photo->map)) return error;
  return Understand(where, primary, raw, id, near, photo);
}

// Returns true if a top-level box (ISO/IEC 14496-12, 4.2) extends beyond the end of the file.
bool EndsWithinBox(Span file) {
  constexpr uint64_t kToTheEnd = 0, kLong = 1;  // special values of the size field of a box
  uint64_t at = 0;
  while (at + 16 <= file.size) {
    const uint8_t* box = file.data + at;
    uint64_t size = ReadBigEndian32(box);
    if (size == kToTheEnd) return false;
    if (size == kLong) size = uint64_t{ReadBigEndian32(box + 8)} << 32 | ReadBigEndian32(box + 12);
    if (size > file.size - at) return true;
    if (size < 8) return false;
    at += size;
  }
  return at < file.size;
}

// Limits the threads that decode tiles at the same time. libheif decodes in the calling thread if
// the limit is 0. In all cases the decoder for HEVC has one thread for which the caller waits.
void LimitThreads(heif_context* context) {
#if LIBHEIF_HAVE_VERSION(1, 13, 0)
  const int threads = DecoderThreads();
  if (threads > 0) heif_context_set_max_decoding_threads(context, threads == 1 ? 0 : threads);
#else
  static_cast<void>(context);
#endif
}

// Opens a file whose boxes are within the limits. libheif reads from `file`, which the caller
// keeps.
Result<Context> OpenContext(const std::string& where, Span file) {
  if (Error error = CheckHeif(where, file)) return error;
  Context context(heif_context_alloc());
  if (context == nullptr) return OutOfMemory(where, "read it");
  heif_context_set_maximum_image_size_limit(context.get(), kMostSide);
  LimitThreads(context.get());
  const heif_error failure =
      heif_context_read_from_memory_without_copy(context.get(), file.data, file.size, nullptr);
  if (failure.code != heif_error_Ok) return Broken(where, failure);
  return context;
}

Result<Image> ReadPicture(const std::string& where, heif_context* context, uint32_t id,
                          size_t file) {
  heif_image_handle* raw = nullptr;
  const heif_error failure = heif_context_get_image_handle(context, id, &raw);
  const Handle handle(raw);
  if (failure.code != heif_error_Ok) return Broken(where, failure);
  if (Error error = CheckSize(where, raw, file)) return error;
  return DecodePicture(where, raw);
}

Result<DepthPhoto> Read(const std::string& where, Span file, Near near) {
  const Result<Context> context = OpenContext(where, file);
  if (!context) return context.error();
  heif_image_handle* raw = nullptr;
  const heif_error failure = heif_context_get_primary_image_handle(context->get(), &raw);
  const Handle primary(raw);
  if (failure.code != heif_error_Ok) return Broken(where, failure);
  DepthPhoto photo;
  photo.format = "HEIF depth photo";
  if (Error error = CheckSize(where, raw, file.size)) return error;
  Result<DecodedPicture> picture = DecodeBoth(where, raw);
  if (!picture) return picture.error();
  TakePicture(std::move(*picture), &photo);
  ReadExifItem(raw, &photo);
  ReadCaptions(raw, &photo);
  photo.map_problem = ReadMap(where, raw, file.size, near, &photo).line();
  if (!photo.map_problem.empty()) photo.map = {};
  ReadAuxiliaries(raw, file.size, &photo);
  return photo;
}

}  // namespace

void LoadHeifDecoders() {
#if LIBHEIF_HAVE_VERSION(1, 13, 0)
  static const heif_error ignored = heif_init(nullptr);
  static_cast<void>(ignored);
#endif
}

Result<DepthPhoto> ReadHeif(const std::string& where, Span file, Near near) {
  try {
    Result<DepthPhoto> photo = Read(where, file, near);
    if (!photo && EndsWithinBox(file)) return Truncated(where, "HEIF");
    return photo;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::system_error&) {
    return OutOfMemory(where, "start a thread");
  } catch (const std::exception& failure) {  // C functions of libheif may throw C++ exceptions
    return Expected(where, "a HEIF file that libheif can read", failure.what());
  }
}

bool ReadHeifPair(const std::string& where, Span file, DepthPhoto* photo) {
  const std::vector<uint32_t> ids = HeifStereoPair(file);
  if (ids.empty()) return false;
  try {
    const Result<Context> context = OpenContext(where, file);
    if (!context) return false;
    heif_item_id primary = 0;
    const heif_error failure = heif_context_get_primary_image_ID(context->get(), &primary);
    // The caller has already decoded the primary picture, which usually is the left picture.
    const bool has_left = failure.code == heif_error_Ok && primary == ids[0];
    Image decoded;
    if (!has_left && ReadPicture(where, context->get(), ids[0], file.size).MoveTo(&decoded)) {
      return false;
    }
    const Image& left = has_left ? photo->picture : decoded;
    Result<Image> right = ReadPicture(where, context->get(), ids[1], file.size);
    if (!right || left.width != right->width || left.height != right->height) return false;
    if (!has_left) {
      photo->picture = std::move(decoded);
      photo->deep.reset();
    }
    photo->right = std::move(*right);
    return true;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // C functions of libheif may throw C++ exceptions
    return false;
  }
}

#else

void LoadHeifDecoders() {}

Result<DepthPhoto> ReadHeif(const std::string& where, Span, Near) {
  return Unsupported(where, "HEIC", "libheif");
}

bool ReadHeifPair(const std::string&, Span, DepthPhoto*) { return false; }

#endif

}  // namespace starfocus
