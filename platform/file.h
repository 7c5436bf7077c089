// SPDX-License-Identifier: Apache-2.0
// Whole files in and out of memory.
#ifndef STARFOCUS_PLATFORM_FILE_H_
#define STARFOCUS_PLATFORM_FILE_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

using Bytes = std::vector<uint8_t>;

// Reads a regular file or a pipe of at most 2 GiB. Rejects folders and devices: a device such as
// /dev/zero never ends. "-" is standard input, here and below.
Result<Bytes> ReadFile(const std::string& path);

// The same of a file that is wanted only if its first 64 KiB say so: of any other file it returns
// these alone, so that a file of another kind costs no memory and a stream of it ends.
Result<Bytes> ReadFileIf(const std::string& path, bool (*is_wanted)(const Bytes& beginning));

// Reads a file of at most kMostSmallBytes: timings, calibrations and other texts.
constexpr size_t kMostSmallBytes = size_t{1} << 20;
Result<Bytes> ReadSmallFile(const std::string& path);

// Writes to a temporary file in the same folder and renames it, so that `path` holds either what
// it held before or all of `bytes`. A file that is there keeps its owner and permissions, and a
// read-only one is refused. A device or pipe is written in place, and standard output
// (standard_stream.h).
Error WriteFile(const std::string& path, const Bytes& bytes);

// Writes what an encoder made, or returns its error.
Error WriteFile(const std::string& path, const Result<Bytes>& encoded);

Error WriteText(const std::string& path, const std::string& text);

// Whether a later WriteFile can be expected to work: the folder exists and may be written into, its
// file system takes the name, and `path` is neither a folder nor read-only.
Error CheckOutputPath(const std::string& path);

// Whether `path` is no device or pipe, which could keep its reader waiting for ever.
Error CheckPlainFile(const std::string& path);

// The extension in lower case with its dot; empty when there is none.
std::string LowerExtension(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_FILE_H_
