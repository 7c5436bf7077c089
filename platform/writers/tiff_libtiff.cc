// SPDX-License-Identifier: Apache-2.0
// Encodes TIFF with libtiff 4.5 or newer.
#include "platform/writers/tiff.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

#include "platform/writers/jpeg_segments.h"

namespace starfocus {
namespace {

// The file that libtiff writes, and the first error.
struct TiffOutput {
  Bytes bytes;
  uint64_t at = 0;
  bool no_memory = false;
  std::string problem;
};

tmsize_t ReadBack(thandle_t handle, void* buffer, tmsize_t size) {
  auto* output = static_cast<TiffOutput*>(handle);
  const uint64_t left = output->bytes.size() - std::min<uint64_t>(output->at, output->bytes.size());
  const auto count = static_cast<size_t>(std::min<uint64_t>(left, static_cast<uint64_t>(size)));
  if (count > 0) std::memcpy(buffer, output->bytes.data() + output->at, count);
  output->at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t WriteOn(thandle_t handle, void* data, tmsize_t size) {
  auto* output = static_cast<TiffOutput*>(handle);
  try {
    const auto begin = static_cast<size_t>(output->at), count = static_cast<size_t>(size);
    if (output->bytes.size() < begin + count) output->bytes.resize(begin + count);
    if (count > 0) std::memcpy(output->bytes.data() + begin, data, count);
    output->at += count;
    return size;
  } catch (const std::bad_alloc&) {  // exceptions must not pass C functions
    output->no_memory = true;
    return -1;
  }
}

toff_t SeekTo(thandle_t handle, toff_t offset, int origin) {
  auto* output = static_cast<TiffOutput*>(handle);
  const uint64_t base = origin == SEEK_CUR   ? output->at
                        : origin == SEEK_END ? output->bytes.size()
                                             : 0;
  output->at = base + offset;
  return output->at;
}

int CloseOutput(thandle_t) { return 0; }

toff_t SizeOfOutput(thandle_t handle) { return static_cast<TiffOutput*>(handle)->bytes.size(); }

int KeepWriteError(TIFF*, void* output, const char*, const char* format, std::va_list arguments) {
  char text[200];
  std::vsnprintf(text, sizeof(text), format, arguments);
  std::string* problem = &static_cast<TiffOutput*>(output)->problem;
  if (problem->empty()) *problem = text;
  return 1;
}

int IgnoreWriteWarning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

TIFF* OpenOutput(TiffOutput* output) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (options == nullptr) return nullptr;
  TIFFOpenOptionsSetErrorHandlerExtR(options, KeepWriteError, output);
  TIFFOpenOptionsSetWarningHandlerExtR(options, IgnoreWriteWarning, nullptr);
  TIFF* tiff = TIFFClientOpenExt("picture", "w", output, ReadBack, WriteOn, SeekTo, CloseOutput,
                                 SizeOfOutput, nullptr, nullptr, options);
  TIFFOpenOptionsFree(options);
  return tiff;
}

void SetTags(const DeepImage& image, const Metadata& metadata, TIFF* tiff) {
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<uint32_t>(image.width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<uint32_t>(image.height));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, image.channels);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 16);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff, 0));
  if (image.channels == 4) {
    const uint16_t kind = EXTRASAMPLE_UNASSALPHA;
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &kind);
  }
  if (!metadata.icc.empty()) {
    TIFFSetField(tiff, TIFFTAG_ICCPROFILE, static_cast<uint32_t>(metadata.icc.size()),
                 metadata.icc.data());
  }
  const std::string xmp = XmpPacket(metadata.xmp);
  if (!xmp.empty()) {
    TIFFSetField(tiff, TIFFTAG_XMLPACKET, static_cast<uint32_t>(xmp.size()), xmp.data());
  }
}

}  // namespace

Error CheckTiffEncoder(const std::string&) { return {}; }

Result<Bytes> EncodeTiff(const std::string& path, const DeepImage& image,
                         const Metadata& metadata) {
  TiffOutput output;
  TIFF* tiff = OpenOutput(&output);
  if (tiff == nullptr) return OutOfMemory(path, "write it");
  SetTags(image, metadata, tiff);
  std::vector<uint16_t> row(image.row_samples());
  bool written = true;
  for (int y = 0; y < image.height && written; ++y) {
    std::copy_n(image.row(y), row.size(), row.begin());  // the predictor changes the row
    written = TIFFWriteScanline(tiff, row.data(), static_cast<uint32_t>(y), 0) == 1;
  }
  written = TIFFFlush(tiff) == 1 && written;
  TIFFClose(tiff);
  if (written && !output.no_memory && output.problem.empty()) return std::move(output.bytes);
  if (output.no_memory || output.problem.empty()) return OutOfMemory(path, "write it");
  return Expected(path, "a picture that libtiff can write", output.problem);
}

}  // namespace starfocus
