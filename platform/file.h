// SPDX-License-Identifier: Apache-2.0
// Reads and writes whole files.
#ifndef STARFOCUS_PLATFORM_FILE_H_
#define STARFOCUS_PLATFORM_FILE_H_

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

using Bytes = std::vector<uint8_t>;

// Reads a regular file of at most 2 GiB. Rejects folders, devices and pipes without waiting, since
// a device such as /dev/zero never ends, and a pipe may have no writer. The path "-" means standard
// input, which may be a pipe, in all functions of this header that read a file.
Result<Bytes> ReadFile(const std::string& path);

// Reads a file, or only its first 64 KiB if `is_wanted` returns false for these bytes. Reading an
// unwanted file therefore takes little memory, and reading an endless stream ends.
Result<Bytes> ReadFileIf(const std::string& path, bool (*is_wanted)(const Bytes& beginning));

// Reads a file of at most kMostSmallBytes, for timings, calibrations and other texts.
constexpr size_t kMostSmallBytes = size_t{1} << 20;
Result<Bytes> ReadSmallFile(const std::string& path);

// Replaces a link by its target, and again if the target is a link. The last target may be absent.
// WriteFile writes to this target, because renaming onto a link would replace the link.
std::filesystem::path FollowLinks(std::filesystem::path path);

// Writes a temporary file in the folder of `path` and renames the temporary file, so that `path`
// contains either its old content or all of `bytes`. Keeps the owner and permissions of an existing
// file, and rejects a read-only file. Devices, pipes and standard output (standard_stream.h) are
// written directly.
Error WriteFile(const std::string& path, const Bytes& bytes);

// Writes the output of an encoder to `path`. If the encoder failed, returns the error of the
// encoder.
Error WriteFile(const std::string& path, const Result<Bytes>& encoded);

Error WriteText(const std::string& path, const std::string& text);

// Returns an error if a later call of WriteFile with the path `path` would probably fail. The
// folder of `path` must exist and be writable, the file system must accept the file name, and
// `path` must not be a folder or a read-only file.
Error CheckOutputPath(const std::string& path);

// Returns an error if `path` is a device or pipe, as the functions that read a file do.
Error CheckPlainFile(const std::string& path);

// Returns the extension of a path in lower case with its dot, or an empty string if the path has no
// extension.
std::string LowerExtension(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_FILE_H_
