// SPDX-License-Identifier: Apache-2.0
// Encodes JPEG pixels with libjpeg-turbo.
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>

// Include jerror.h and jpeglib.h after <cstdio>, because both headers use FILE.
#include <jerror.h>
#include <jpeglib.h>

#include "platform/writers/jpeg.h"

namespace starfocus {
namespace {

struct Failure {
  jpeg_error_mgr manager;  // first member: Fail casts the address of `manager` to Failure*
  std::jmp_buf back;
  char reason[JMSG_LENGTH_MAX];
};

void Fail(j_common_ptr info) {
  Failure* failure = reinterpret_cast<Failure*>(info->err);
  failure->manager.format_message(info, failure->reason);
  std::longjmp(failure->back, 1);
}

void KeepSilent(j_common_ptr) {}

struct Memory {
  unsigned char* data = nullptr;
  unsigned long size = 0;
  ~Memory() { std::free(data); }
};

// On failure, returns false and sets failure->reason. Local objects of Compress must not have
// destructors, because longjmp on a libjpeg error skips destructors.
bool Compress(const Samples8& picture, int quality, RowGate* rows, Memory* memory,
              Failure* failure) {
  jpeg_compress_struct info;
  info.err = jpeg_std_error(&failure->manager);
  failure->manager.error_exit = Fail;
  failure->manager.output_message = KeepSilent;
  if (setjmp(failure->back) != 0) {
    jpeg_destroy_compress(&info);
    return false;
  }
  jpeg_create_compress(&info);
  jpeg_mem_dest(&info, &memory->data, &memory->size);
  const bool is_grey = picture.channels == 1;
  info.image_width = static_cast<JDIMENSION>(picture.width);
  info.image_height = static_cast<JDIMENSION>(picture.height);
  info.input_components = picture.channels;
  info.in_color_space = is_grey ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  info.optimize_coding = TRUE;
  if (quality >= 90 && !is_grey)
    info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    const int y = static_cast<int>(info.next_scanline);
    if (rows != nullptr) rows->WaitFor(y);
    const size_t stride = size_t(picture.channels) * size_t(picture.width);
    JSAMPROW row = const_cast<JSAMPROW>(picture.samples + size_t(y) * stride);
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  return true;
}

}  // namespace

Result<Bytes> EncodeJpegPixels(const std::string& path, const Samples8& picture, int quality,
                               RowGate* rows) {
  Memory memory;
  const auto failure = std::make_unique<Failure>();
  if (!Compress(picture, quality, rows, &memory, failure.get())) {
    return failure->manager.msg_code == JERR_OUT_OF_MEMORY
               ? OutOfMemory(path, "write it")
               : Expected(path, "a picture that libjpeg can write", failure->reason);
  }
  return Bytes(memory.data, memory.data + memory.size);
}

}  // namespace starfocus
