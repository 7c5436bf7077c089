// SPDX-License-Identifier: Apache-2.0
// Decompresses files of ZIP archives with libdeflate.
#include <libdeflate.h>

#include <memory>

#include "platform/decoders/zip.h"

namespace starfocus {

Error Inflate(const std::string& where, const uint8_t* data, size_t size, Bytes* result) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (decompressor == nullptr) return OutOfMemory(where, "read it");
  // Without a pointer that receives the size, the result must fill the buffer.
  const libdeflate_result status = libdeflate_deflate_decompress(
      decompressor.get(), data, size, result->data(), result->size(), nullptr);
  if (status == LIBDEFLATE_SUCCESS) return {};
  return Expected(where, "an undamaged ZIP archive", "compressed data that cannot be decompressed");
}

}  // namespace starfocus
