// SPDX-License-Identifier: Apache-2.0
// Decodes JPEG with libjpeg-turbo.
#include <csetjmp>
#include <cstdio>
#include <memory>

// Include jpeglib.h after <cstdio>, because jpeglib.h uses FILE.
#include <jpeglib.h>

// Include jerror.h after <jpeglib.h>, which defines whether arithmetic coding has error codes.
#include <jerror.h>

#include "platform/container.h"
#include "platform/decoders/jpeg.h"
#include "platform/decoders/limits.h"

namespace starfocus {
namespace {

// Limit on the number of scans in a progressive JPEG file. Decoding a scan, even of a few bytes,
// takes as long as a pass over the whole picture.
constexpr int kMostScans = 500;

// State of libjpeg and the cause of an error. The destructor frees libjpeg's memory.
struct Decoder {
  jpeg_error_mgr manager;  // first member: functions cast the address of `manager` to Decoder*
  std::jmp_buf back;
  jpeg_decompress_struct info;
  jpeg_progress_mgr progress;
  bool truncated = false, many_scans = false;
  char reason[JMSG_LENGTH_MAX] = "";  // message of libjpeg for an error or damaged pixels

  Decoder() {
    info.err = jpeg_std_error(&manager);
    // If `mem` is null, jpeg_destroy_decompress frees nothing.
    info.mem = nullptr;
  }
  ~Decoder() { jpeg_destroy_decompress(&info); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
};

void Fail(j_common_ptr info) {
  Decoder* decoder = reinterpret_cast<Decoder*>(info->err);
  decoder->manager.format_message(info, decoder->reason);
  std::longjmp(decoder->back, 1);
}

void KeepSilent(j_common_ptr) {}

// Returns true if the warning `code` means that pixels are missing or wrong. Ignores other
// warnings, for example about extraneous bytes between the segments of a file.
bool LosesPixels(int code) {
  return code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE ||
         code == JWRN_ARITH_BAD_CODE || code == JWRN_MUST_RESYNC || code == JWRN_NOT_SEQUENTIAL;
}

void Warn(j_common_ptr info, int level) {
  Decoder* decoder = reinterpret_cast<Decoder*>(info->err);
  const int code = decoder->manager.msg_code;
  if (level >= 0 || !LosesPixels(code) || decoder->reason[0] != '\0') return;
  decoder->truncated = code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER;
  decoder->manager.format_message(info, decoder->reason);
}

void CountScans(j_common_ptr info) {
  Decoder* decoder = reinterpret_cast<Decoder*>(info->err);
  if (decoder->info.input_scan_number <= kMostScans) return;
  decoder->many_scans = true;
  std::longjmp(decoder->back, 1);
}

bool IsCmyk(const jpeg_decompress_struct& info) { return info.out_color_space == JCS_CMYK; }

// On failure, functions that call setjmp return false and set decoder->reason. Local objects of
// functions that call setjmp must not have destructors, because longjmp on a libjpeg error skips
// destructors.
bool ReadHeader(const Bytes& jpeg, Decoder* decoder) {
  jpeg_decompress_struct& info = decoder->info;
  decoder->manager.error_exit = Fail;
  decoder->manager.output_message = KeepSilent;
  decoder->manager.emit_message = Warn;
  if (setjmp(decoder->back) != 0) return false;
  jpeg_create_decompress(&info);
  decoder->progress.progress_monitor = CountScans;
  info.progress = &decoder->progress;
  jpeg_mem_src(&info, jpeg.data(), static_cast<unsigned long>(jpeg.size()));
  jpeg_read_header(&info, TRUE);
  const bool cmyk = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
  info.out_color_space = cmyk ? JCS_CMYK : JCS_RGB;
  return true;
}

// Converts a row of CMYK pixels to RGB. In CMYK files, Adobe's programs store 255 minus the amount
// of ink. Like libjpeg-turbo's own program, ToRgb assumes inverted ink even if a file lacks Adobe's
// marker.
void ToRgb(const uint8_t* cmyk, int width, uint8_t* rgb) {
  for (int x = 0; x < width; ++x, cmyk += 4, rgb += 3) {
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<uint8_t>((cmyk[c] * cmyk[3] + 127) / 255);
  }
}

// Reads all rows. `cmyk` is a buffer for one row, or null for RGB.
bool ReadRows(Decoder* decoder, uint8_t* cmyk, Image* image) {
  jpeg_decompress_struct& info = decoder->info;
  if (setjmp(decoder->back) != 0) return false;
  jpeg_start_decompress(&info);
  while (info.output_scanline < info.output_height) {
    uint8_t* const row = image->row(static_cast<int>(info.output_scanline));
    JSAMPROW target = cmyk != nullptr ? cmyk : row;
    jpeg_read_scanlines(&info, &target, 1);
    if (cmyk != nullptr) ToRgb(cmyk, image->width, row);
  }
  jpeg_finish_decompress(&info);
  return decoder->reason[0] == '\0';
}

Error Failed(const std::string& where, const Decoder& decoder) {
  if (decoder.many_scans) {
    return Expected(where, "at most " + std::to_string(kMostScans) + " scans", "more");
  }
  if (decoder.manager.msg_code == JERR_OUT_OF_MEMORY) return OutOfMemory(where, "read it");
  if (decoder.truncated) {
    return Expected(where, "an undamaged picture",
                    "a truncated one (" + std::string(decoder.reason) + ")");
  }
  return Expected(where, "a JPEG picture that libjpeg-turbo can read", decoder.reason);
}

}  // namespace

Result<Image> DecodeJpeg(const std::string& where, const Bytes& jpeg) {
  const auto decoder = std::make_unique<Decoder>();
  if (!ReadHeader(jpeg, decoder.get())) return Failed(where, *decoder);
  const jpeg_decompress_struct& info = decoder->info;
  if (Error error = CheckPictureSize(where, info.image_width, info.image_height)) return error;
  if (!JpegCanHold(jpeg.size(), info.arith_code != FALSE, info.image_width, info.image_height)) {
    return Truncated(where, "JPEG");
  }
  Image result(static_cast<int>(info.image_width), static_cast<int>(info.image_height));
  Bytes cmyk(IsCmyk(info) ? 4 * size_t(result.width) : 0);
  if (!ReadRows(decoder.get(), cmyk.empty() ? nullptr : cmyk.data(), &result)) {
    return Failed(where, *decoder);
  }
  return result;
}

}  // namespace starfocus
