// SPDX-License-Identifier: Apache-2.0
// Decodes TIFF with libtiff 4.5 or newer.
#include "platform/decoders/tiff.h"

#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include "platform/decoders/deep.h"
#include "platform/decoders/limits.h"
#include "platform/decoders/numbers.h"
#include "platform/deep_image.h"

namespace starfocus {
namespace {

// A file in memory that libtiff reads, and the first error of libtiff.
struct Source {
  const Bytes& bytes;
  uint64_t at = 0;
  std::string problem = {};
};

tmsize_t Read(thandle_t handle, void* buffer, tmsize_t size) {
  auto* source = static_cast<Source*>(handle);
  const uint64_t left = source->bytes.size() - std::min<uint64_t>(source->at, source->bytes.size());
  const auto count = static_cast<size_t>(std::min<uint64_t>(left, static_cast<uint64_t>(size)));
  if (count > 0) std::memcpy(buffer, source->bytes.data() + source->at, count);
  source->at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t Write(thandle_t, void*, tmsize_t) { return 0; }

toff_t Seek(thandle_t handle, toff_t offset, int origin) {
  auto* source = static_cast<Source*>(handle);
  const uint64_t base = origin == SEEK_CUR   ? source->at
                        : origin == SEEK_END ? source->bytes.size()
                                             : 0;
  source->at = base + offset;
  return source->at;
}

int Close(thandle_t) { return 0; }

toff_t SizeOf(thandle_t handle) { return static_cast<Source*>(handle)->bytes.size(); }

int KeepError(TIFF*, void* source, const char*, const char* format, std::va_list arguments) {
  char text[200];
  std::vsnprintf(text, sizeof(text), format, arguments);
  std::string* problem = &static_cast<Source*>(source)->problem;
  if (problem->empty()) *problem = text;
  return 1;
}

int IgnoreWarning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, CloseTiff>;

// Opens a file. Returns null and sets source->problem if the file has no readable directory.
Tiff Open(Source* source) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (options == nullptr) return nullptr;
  TIFFOpenOptionsSetErrorHandlerExtR(options, KeepError, source);
  TIFFOpenOptionsSetWarningHandlerExtR(options, IgnoreWarning, nullptr);
  // The largest blocks are strips as stored in the file, and tables of 8 bytes for each entry of 2
  // bytes in the file. 1 MiB is enough for the state of a decoder.
  TIFFOpenOptionsSetMaxSingleMemAlloc(
      options, static_cast<tmsize_t>((size_t{1} << 20) + 4 * source->bytes.size()));
  // "m" prevents libtiff from mapping the file.
  Tiff tiff(TIFFClientOpenExt("depth", "rm", source, Read, Write, Seek, Close, SizeOf, nullptr,
                              nullptr, options));
  TIFFOpenOptionsFree(options);
  return tiff;
}

struct Layout {
  uint32_t width = 0, height = 0;
  uint16_t samples = 1, bits = 1, format = SAMPLEFORMAT_UINT;
  uint16_t photometric = PHOTOMETRIC_MINISBLACK, orientation = ORIENTATION_TOPLEFT;
  uint16_t compression = COMPRESSION_NONE, planes = PLANARCONFIG_CONTIG;
  uint16_t alpha = EXTRASAMPLE_UNSPECIFIED;  // meaning of the first sample beyond the colours
  bool is_tiled = false;

  explicit Layout(TIFF* tiff) : is_tiled(TIFFIsTiled(tiff) != 0) {
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
    uint16_t extras = 0;
    uint16_t* meanings = nullptr;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extras, &meanings);
    if (extras > 0) alpha = meanings[0];
  }

  // Type of the samples in memory, after libtiff has swapped their bytes. The type is not supported
  // if samples are of an unknown type or shorter than a byte.
  NumberType type() const {
    const NumberKind kind = format == SAMPLEFORMAT_IEEEFP ? NumberKind::kFloat
                            : format == SAMPLEFORMAT_INT  ? NumberKind::kSigned
                                                          : NumberKind::kUnsigned;
    const bool known = kind != NumberKind::kUnsigned || format == SAMPLEFORMAT_UINT;
    return {kind, known && bits % 8 == 0 ? bits / 8U : 0U, kOwnByteOrder};
  }
};

// Describes samples that are not grey levels with white as the largest value.
std::string DescribeMeaning(const Layout& layout) {
  if (layout.samples != 1) return std::to_string(layout.samples) + " samples for each pixel";
  if (layout.photometric == PHOTOMETRIC_MINISWHITE) return "black as the largest value";
  if (layout.photometric == PHOTOMETRIC_PALETTE) return "palette colours";
  return "photometric interpretation " + std::to_string(layout.photometric);
}

std::string DescribeType(const Layout& layout) {
  const char* type = layout.format == SAMPLEFORMAT_IEEEFP ? "-bit floats"
                     : layout.format == SAMPLEFORMAT_UINT ? "-bit unsigned integers"
                     : layout.format == SAMPLEFORMAT_INT  ? "-bit signed integers"
                                                          : "-bit samples of another type";
  return std::to_string(layout.bits) + type;
}

// Returns an error unless the program reads strips of this layout. `advice` states how to convert
// the file.
Error CheckStrips(const std::string& where, const std::string& advice, const Layout& layout) {
  const auto reject = [&](const std::string& expected, const std::string& found) {
    return Expected(where, expected, found + advice);
  };
  constexpr uint16_t kCompressions[] = {COMPRESSION_NONE, COMPRESSION_LZW,
                                        COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE,
                                        COMPRESSION_PACKBITS};
  if (layout.is_tiled) return reject("a TIFF of strips", "tiles");
  if (layout.orientation != ORIENTATION_TOPLEFT) {
    return reject("a TIFF of orientation 1", std::to_string(layout.orientation));
  }
  if (std::find(std::begin(kCompressions), std::end(kCompressions), layout.compression) ==
      std::end(kCompressions)) {
    return reject("a TIFF without compression, or with LZW, Deflate or PackBits",
                  "compression " + std::to_string(layout.compression));
  }
  return {};
}

// Returns an error unless the program reads depth maps or mattes of this layout.
Error CheckLayout(const std::string& where, bool is_matte, const Layout& layout) {
  const std::string advice = is_matte ? " (convert the matte to PNG)"
                                      : " (convert the map to PFM or NPY, or to PNG of 16 bits)";
  if (layout.samples != 1 || layout.photometric != PHOTOMETRIC_MINISBLACK) {
    return Expected(where, "a TIFF of one value for each pixel, white as the largest value",
                    DescribeMeaning(layout) + advice);
  }
  if (!CanReadNumbers(layout.type())) {
    return Expected(where,
                    "a TIFF of integers of 8, 16, 32 or 64 bits, or floats of 16, 32 or 64 bits",
                    DescribeType(layout) + advice);
  }
  return CheckStrips(where, advice, layout);
}

// Number of samples of the colours of a pixel, 1 or 3, or 0 for a layout that is no picture.
int ColoursOf(const Layout& layout) {
  const bool is_rgb = layout.photometric == PHOTOMETRIC_RGB;
  if (!is_rgb && layout.photometric != PHOTOMETRIC_MINISBLACK) return 0;
  const int colours = is_rgb ? 3 : 1;
  return layout.samples >= colours && layout.samples <= colours + 4 ? colours : 0;
}

// Returns an error unless the program reads pictures of this layout.
Error CheckPictureLayout(const std::string& where, TIFF* tiff, const Layout& layout) {
  const std::string advice = " (convert it to PNG, for example with ImageMagick)";
  uint32_t kind = 0;
  uint8_t* version = nullptr;
  TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &kind);
  if ((kind & FILETYPE_REDUCEDIMAGE) != 0 ||
      TIFFGetField(tiff, TIFFTAG_DNGVERSION, &version) == 1) {
    return Expected(where, "a TIFF picture", "a raw file" + advice);
  }
  if (ColoursOf(layout) == 0 || layout.planes != PLANARCONFIG_CONTIG) {
    return Expected(where, "a TIFF picture of interleaved RGB or grey",
                    std::to_string(layout.samples) + " samples of photometric interpretation " +
                        std::to_string(layout.photometric) + advice);
  }
  const NumberType type = layout.type();
  const bool is_float = type.kind == NumberKind::kFloat;
  if (type.kind == NumberKind::kSigned || (type.bytes != 2 && type.bytes != (is_float ? 4 : 1))) {
    return Expected(where, "a TIFF of integers of 8 or 16 bits, or floats of 16 or 32 bits",
                    DescribeType(layout) + advice);
  }
  return CheckStrips(where, advice, layout);
}

// Returns true if the file can contain the pixels. An LZW code of 12 bits expands to at most 4096
// bytes, and other compressions expand less.
bool CanHold(const Bytes& tiff, const Layout& layout) {
  constexpr uint64_t kMostExpansion = 4096;
  const uint64_t pixel = uint64_t{layout.samples} * (layout.bits / 8U);
  return uint64_t{layout.width} * layout.height * pixel / kMostExpansion <= tiff.size();
}

// Converts a pixel of floats to half floats that are multiplied with alpha. NaN and wrong alpha
// stay, so that CountUnusable finds them.
void StoreHalf(const float* values, bool is_straight, size_t channels, uint16_t* to) {
  const float alpha = std::isnan(values[3]) ? 0 : std::clamp(values[3], 0.0F, 1.0F);
  for (size_t c = 0; c < channels; ++c) {
    const float value = values[c] * (is_straight && c < 3 ? alpha : 1);
    to[c] = HalfOfFloat(std::isnan(value) ? value : std::clamp(value, -kLargestHalf, kLargestHalf));
  }
}

// Converts a row of numbers, as ReadNumbers returns them.
void StoreRow(const Layout& layout, const float* values, DeepImage* deep, uint16_t* to) {
  const auto colours = static_cast<size_t>(ColoursOf(layout)),
             channels = static_cast<size_t>(deep->channels);
  const float scale = layout.bits == 8 ? 257.0F : 1.0F;
  for (uint32_t x = 0; x < layout.width; ++x, values += layout.samples, to += channels) {
    const float pixel[] = {values[0], values[colours / 2], values[colours - 1],
                           channels == 4 ? values[colours] : 1.0F};
    if (deep->is_half) {
      StoreHalf(pixel, layout.alpha == EXTRASAMPLE_UNASSALPHA, channels, to);
    } else {
      for (size_t c = 0; c < channels; ++c) to[c] = static_cast<uint16_t>(pixel[c] * scale);
    }
  }
}

// Adds a note if samples are neither colours nor alpha. Some programs write alpha like this.
void NoteUnread(const Layout& layout, int channels, std::vector<std::string>* notes) {
  const int unread = layout.samples - ColoursOf(layout) - (channels == 4 ? 1 : 0);
  if (unread <= 0) return;
  notes->push_back((unread == 1 ? "a sample" : std::to_string(unread) + " samples") +
                   " of each pixel, which the file does not declare as colour or alpha, " +
                   (unread == 1 ? "is" : "are") + " ignored");
}

Metadata ReadTiffMetadata(TIFF* tiff) {
  Metadata metadata;
  uint32_t size = 0;
  void* data = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_ICCPROFILE, &size, &data) == 1) {
    metadata.icc.assign(static_cast<uint8_t*>(data), static_cast<uint8_t*>(data) + size);
  }
  if (TIFFGetField(tiff, TIFFTAG_XMLPACKET, &size, &data) == 1) {
    metadata.xmp.assign(static_cast<char*>(data), size);
  }
  return metadata;
}

}  // namespace

Result<DecodedPicture> DecodeTiffPicture(const std::string& where, const Bytes& bytes) {
  Source source = {bytes};
  const auto damaged = [&] {
    return Expected(where, "an undamaged TIFF file", "a damaged one (" + source.problem + ")");
  };
  const Tiff tiff = Open(&source);
  if (tiff == nullptr) return damaged();
  const Layout layout(tiff.get());
  if (Error error = CheckPictureLayout(where, tiff.get(), layout)) return error;
  if (Error error = CheckPictureSize(where, layout.width, layout.height)) return error;
  if (!CanHold(bytes, layout)) {
    source.problem = "it is too small for its pixels";
    return damaged();
  }
  const bool has_alpha =
      layout.samples > ColoursOf(layout) && layout.alpha != EXTRASAMPLE_UNSPECIFIED;
  DecodedPicture picture;
  picture.deep =
      DeepImage(static_cast<int>(layout.width), static_cast<int>(layout.height), has_alpha ? 4 : 3);
  DeepImage& deep = *picture.deep;
  const NumberType type = layout.type();
  deep.is_half = type.kind == NumberKind::kFloat;
  deep.is_multiplied = layout.alpha == EXTRASAMPLE_ASSOCALPHA;
  const size_t count = size_t{layout.width} * layout.samples;
  std::vector<uint8_t> row(
      std::max(static_cast<size_t>(TIFFScanlineSize(tiff.get())), count * type.bytes));
  std::vector<float> values(count);
  for (uint32_t y = 0; y < layout.height; ++y) {
    if (TIFFReadScanline(tiff.get(), row.data(), y, 0) != 1) return damaged();
    ReadNumbers(type, row.data(), count, values.data());
    StoreRow(layout, values.data(), &deep, deep.row(static_cast<int>(y)));
  }
  if (has_alpha && !deep.is_half && layout.alpha == EXTRASAMPLE_ASSOCALPHA) DivideByAlpha(&deep);
  NoteUnread(layout, deep.channels, &picture.notes);
  picture.metadata = ReadTiffMetadata(tiff.get());
  CompleteDeep(layout.bits, &picture);
  return picture;
}

Result<Samples> DecodeTiff(const std::string& where, bool is_matte, const Bytes& bytes) {
  Source source = {bytes};
  const auto damaged = [&] {
    return Expected(where, "an undamaged TIFF file", "a damaged one (" + source.problem + ")");
  };
  const Tiff tiff = Open(&source);
  if (tiff == nullptr) return damaged();
  const Layout layout(tiff.get());
  if (Error error = CheckLayout(where, is_matte, layout)) return error;
  if (Error error = CheckPictureSize(where, layout.width, layout.height)) return error;
  if (!CanHold(bytes, layout)) {
    source.problem = "it is too small for its pixels";
    return damaged();
  }
  const NumberType type = layout.type();
  Samples samples = {{static_cast<int>(layout.width), static_cast<int>(layout.height), {}},
                     LargestNumber(type),
                     type.bytes > 2};
  samples.map.values.resize(size_t{layout.width} * layout.height);
  std::vector<uint8_t> row(
      std::max(static_cast<size_t>(TIFFScanlineSize(tiff.get())), layout.width * type.bytes));
  float* values = samples.map.values.data();
  for (uint32_t y = 0; y < layout.height; ++y, values += layout.width) {
    if (TIFFReadScanline(tiff.get(), row.data(), y, 0) != 1) return damaged();
    ReadNumbers(type, row.data(), layout.width, values);
  }
  return samples;
}

}  // namespace starfocus
