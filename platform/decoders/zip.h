// SPDX-License-Identifier: Apache-2.0
// Reads ZIP archives (APPNOTE.TXT of PKWARE), with files that are stored or compressed by Deflate,
// and with the 64-bit sizes of ZIP64.
#ifndef STARFOCUS_PLATFORM_DECODERS_ZIP_H_
#define STARFOCUS_PLATFORM_DECODERS_ZIP_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

// A file of an archive, as the directory of the archive describes it.
struct ZipEntry {
  std::string name;
  uint64_t packed = 0, bytes = 0;  // Size in the archive, and size of the file.
  uint64_t at = 0;                 // Position of the local header of the file.
  uint32_t crc = 0;
  int method = 0;  // Compression method.
  bool is_encrypted = false;
};

// Returns true if the bytes start with the signature of a file in an archive.
bool IsZip(const Bytes& bytes);

// Reads the directory at the end of the archive. An archive may contain at most 1000 files. The
// archive must be large enough for the declared sizes of all files together. `where` appears only
// in error messages.
Result<std::vector<ZipEntry>> ListZip(const std::string& where, const Bytes& zip);

// Reads and decompresses a file of the archive, and checks its checksum.
Result<Bytes> ReadZipEntry(const std::string& where, const Bytes& zip, const ZipEntry& entry);

// Decompresses Deflate data to result->size() bytes. Requires libdeflate.
Error Inflate(const std::string& where, const uint8_t* data, size_t size, Bytes* result);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_ZIP_H_
