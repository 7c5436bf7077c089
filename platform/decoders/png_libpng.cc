// SPDX-License-Identifier: Apache-2.0
// Decodes PNG with libpng.
#include "platform/decoders/png.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include "platform/decoders/deep.h"
#include "platform/decoders/exif_bytes.h"
#include "platform/decoders/numbers.h"
#include "platform/decoders/png_text.h"
#include "platform/png.h"
#include "platform/png_call.h"

namespace starfocus {
namespace {

// Input of libpng, metadata from text chunks, and the cause of an error.
struct Call : PngCall {
  const Bytes& png;
  size_t at = 0;
  bool truncated = false;
  Bytes exif = {};  // EXIF from a text chunk
  std::string xmp = {};
  ColourDescription colours = {};  // from the chunk cICP
  bool is_deep = false;            // true if rows have 16 bits, and alpha if the file has it
};

void Take(png_structp png, png_bytep data, png_size_t size) {
  Call* call = static_cast<Call*>(png_get_io_ptr(png));
  if (size > call->png.size() - call->at) {
    call->truncated = true;
    png_error(png, "truncated");
  }
  std::copy_n(call->png.data() + call->at, size, data);
  call->at += size;
}

// Reads the chunk cICP (PNG specification, 11.3.2.6): primaries, transfer, matrix, range.
void TakeCodePoints(const png_unknown_chunk& chunk, ColourDescription* colours) {
  if (chunk.size != 4) return;
  *colours = {kCicpForm, chunk.data[0], chunk.data[1], chunk.data[3] != 0};
}

// Handles text chunks and suggested palettes, which libpng would otherwise store and, if
// compressed, inflate. Keeps only EXIF, XMP and the chunk cICP, which older versions of libpng do
// not read.
int TakeChunk(png_structp png, png_unknown_chunkp chunk) {
  Call* call = static_cast<Call*>(png_get_user_chunk_ptr(png));
  const bool packed = std::memcmp(chunk->name, "zTXt", 4) == 0;
  const bool is_xmp = std::memcmp(chunk->name, "iTXt", 4) == 0;
  try {
    if (std::memcmp(chunk->name, "cICP", 4) == 0) {
      TakeCodePoints(*chunk, &call->colours);
      return 1;
    }
    if (is_xmp) {
      ReadXmpText(chunk->data, chunk->size, &call->xmp);
      return 1;
    }
    if (packed || std::memcmp(chunk->name, "tEXt", 4) == 0) {
      ReadRawProfile(packed, chunk->data, chunk->size, &call->exif);
    }
    return 1;
  } catch (const std::bad_alloc&) {
    call->no_memory = true;
  }
  // Return -1 instead of calling Fail, because longjmp must not leave an exception handler. libpng
  // then calls Fail.
  return -1;
}

// Owns libpng's structures.
struct Reader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  Reader() = default;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

// On failure, functions that call setjmp return false and set call->reason. Local objects of
// functions that call setjmp must not have destructors, because longjmp on a libpng error skips
// destructors.
bool ReadHeader(Call* call, Reader* reader) {
  PngCall* const base = call;
  constexpr char kOwn[] = "tEXt\0zTXt\0iTXt\0sPLT\0cICP";
  reader->png =
      png_create_read_struct_2(PNG_LIBPNG_VER_STRING, base, PngCall::Fail, PngCall::KeepSilent,
                               base, PngCall::Allocate, PngCall::Free);
  if (reader->png != nullptr) reader->info = png_create_info_struct(reader->png);
  if (reader->info == nullptr) {
    call->no_memory = true;
    return false;
  }
  png_structp png = reader->png;
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, call, Take);
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, reinterpret_cast<png_const_bytep>(kOwn),
                              sizeof(kOwn) / 5);
  png_set_read_user_chunk_fn(png, call, TakeChunk);
  png_read_info(png, reader->info);
  png_set_packing(png);
  const png_byte colour = png_get_color_type(png, reader->info);
  const bool has_key = png_get_valid(png, reader->info, PNG_INFO_tRNS) != 0;
  const bool has_alpha = has_key || (colour & PNG_COLOR_MASK_ALPHA) != 0;
  call->is_deep =
      colour != PNG_COLOR_TYPE_PALETTE &&
      (has_alpha || png_get_bit_depth(png, reader->info) == 16 || IsHdr(TransferOf(call->colours)));
  if (call->is_deep) {
    png_set_expand_16(png);  // also turns tRNS into alpha
    if (kOwnByteOrder == ByteOrder::kLittle) png_set_swap(png);
  } else if (colour == PNG_COLOR_TYPE_GRAY) {
    png_set_expand_gray_1_2_4_to_8(png);
  }
  if ((colour & PNG_COLOR_MASK_COLOR) == 0) png_set_gray_to_rgb(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader->info);
  return true;
}

bool ReadRows(const Reader& reader, int height, size_t row_bytes, uint8_t* rows) {
  png_structp png = reader.png;
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const bool whole = png_get_interlace_type(png, reader.info) == PNG_INTERLACE_NONE;
  for (int pass = 0; pass < (whole ? 1 : PNG_INTERLACE_ADAM7_PASSES); ++pass) {
    for (int y = 0; y < height; ++y) png_read_row(png, rows + size_t(y) * row_bytes, nullptr);
  }
  png_read_end(png, reader.info);
  return true;
}

Error Failed(const std::string& where, const Call& call) {
  if (call.no_memory) return OutOfMemory(where, "read it");
  if (call.truncated) return Expected(where, "an undamaged picture", "a truncated one");
  return Expected(where, "an undamaged picture",
                  "a damaged one (" + std::string(call.reason) + ")");
}

// Replaces palette indices by colours. Returns an error for an index outside the palette, for which
// libpng would return black.
Error LookUp(const std::string& where, const Reader& reader, const Bytes& indices,
             DecodedPicture* picture) {
  Image* image = &picture->image;
  Bytes alphas(indices.size(), 255);
  png_colorp palette = nullptr;
  int colours = 0;
  png_get_PLTE(reader.png, reader.info, &palette, &colours);
  png_bytep opacities = nullptr;
  int some = 0;  // the first colours, which have opacities
  png_get_tRNS(reader.png, reader.info, &opacities, &some, nullptr);
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= colours) {
      return Expected(where, "palette indices below " + std::to_string(colours),
                      std::to_string(indices[i]));
    }
    if (indices[i] < some) alphas[i] = opacities[indices[i]];
    picture->is_transparent |= alphas[i] < 255;
    const png_color& colour = palette[indices[i]];
    image->pixels[3 * i] = colour.red;
    image->pixels[3 * i + 1] = colour.green;
    image->pixels[3 * i + 2] = colour.blue;
  }
  if (picture->is_transparent) picture->deep = Widen(*image, alphas);
  return {};
}

// Returns the colours that the chunks gAMA and cHRM describe, unless a chunk sRGB overrides them.
ColourDescription ColoursOf(const Reader& reader) {
  ColourDescription colours;
  int intent = 0;
  if (png_get_sRGB(reader.png, reader.info, &intent) != 0) return colours;
  png_fixed_point gamma = 0;
  if (png_get_gAMA_fixed(reader.png, reader.info, &gamma) != 0 && gamma > 0) {
    constexpr int64_t kUnit = 100000;
    colours.form = "gAMA";
    colours.transfer = ColourDescription::kGiven;
    colours.gamma = static_cast<int32_t>(std::min<int64_t>(kUnit * kUnit / gamma, INT32_MAX));
  }
  Chromaticities& at = colours.chromaticities;
  if (png_get_cHRM_fixed(reader.png, reader.info, &at[6], &at[7], &at[0], &at[1], &at[2], &at[3],
                         &at[4], &at[5]) != 0) {
    colours.form += colours.form.empty() ? "cHRM" : " and cHRM";
    colours.primaries = ColourDescription::kGiven;
  }
  return colours;
}

Metadata TakeMetadata(const Reader& reader, Call* call) {
  Metadata metadata;
  png_charp name = nullptr;
  png_bytep profile = nullptr, exif = nullptr;
  png_uint_32 size = 0;
  int method = 0;
  if (png_get_iCCP(reader.png, reader.info, &name, &method, &profile, &size) != 0) {
    metadata.icc.assign(profile, profile + size);
  }
  if (png_get_eXIf_1(reader.png, reader.info, &size, &exif) != 0) {
    metadata.exif.assign(exif, exif + size);
    TrimExif(&metadata.exif);
  }
  if (metadata.exif.empty()) metadata.exif = std::move(call->exif);
  metadata.xmp = std::move(call->xmp);
  metadata.colours = call->colours.form.empty() ? ColoursOf(reader) : std::move(call->colours);
  return metadata;
}

}  // namespace

Result<DecodedPicture> DecodePngPixels(const std::string& where, const Bytes& png) {
  Call call = {{}, png};
  Reader reader;
  if (!ReadHeader(&call, &reader)) return Failed(where, call);
  const bool palette = png_get_color_type(reader.png, reader.info) == PNG_COLOR_TYPE_PALETTE;
  DecodedPicture result = {};
  const auto width = static_cast<int>(png_get_image_width(reader.png, reader.info)),
             height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  Bytes indices(palette ? size_t(width) * size_t(height) : 0);
  size_t row_bytes = size_t(width);
  uint8_t* rows = indices.data();
  if (call.is_deep) {
    const bool has_alpha = png_get_channels(reader.png, reader.info) == 4;
    result.deep = DeepImage(width, height, has_alpha ? 4 : 3);
    row_bytes = result.deep->row_samples() * sizeof(uint16_t);
    rows = reinterpret_cast<uint8_t*>(result.deep->samples.data());
  } else {
    result.image = Image(width, height);
    if (!palette) {
      row_bytes = result.image.stride();
      rows = result.image.pixels.data();
    }
  }
  if (png_get_rowbytes(reader.png, reader.info) != row_bytes) {
    return Expected(where, "a PNG picture that libpng can convert to RGB", "another format");
  }
  if (!ReadRows(reader, height, row_bytes, rows)) return Failed(where, call);
  if (Error error = palette ? LookUp(where, reader, indices, &result) : Error()) return error;
  result.metadata = TakeMetadata(reader, &call);
  CompleteDeep(ReadPngHeader(png)->depth, &result);
  return result;
}

}  // namespace starfocus
