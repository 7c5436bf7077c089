// SPDX-License-Identifier: Apache-2.0
// Whole files in and out of memory.
//
// Every function of platform/ that can fail returns an error: empty for success, otherwise one
// line "<file>: expected ..., found ...".
#ifndef STARFOCUS_PLATFORM_FILE_H_
#define STARFOCUS_PLATFORM_FILE_H_

#include <cstdint>
#include <string>
#include <vector>

namespace starfocus {

using Bytes = std::vector<uint8_t>;

// "<where>: expected <expected>, found <found>", with line breaks and control characters removed.
std::string Expected(const std::string& where, const std::string& expected,
                     const std::string& found);

// The error of whoever caught std::bad_alloc: "<where>: expected enough memory to <purpose>, ...".
std::string OutOfMemory(const std::string& where, const std::string& purpose);

// "-" is standard input.
std::string ReadFile(const std::string& path, Bytes* bytes);

// Writes to a temporary file in the same folder and renames it, so that `path` holds either what
// it held before or all of `bytes`. A file that is there keeps its owner and permissions, and a
// read-only one is refused. A device or pipe is written in place, and standard output
// (standard_stream.h).
std::string WriteFile(const std::string& path, const Bytes& bytes);

// Whether a later WriteFile can be expected to work: the folder exists and may be written into, its
// file system takes the name, and `path` is neither a folder nor read-only.
std::string CheckOutputPath(const std::string& path);

// Whether `path` is no device or pipe, which could keep its reader waiting for ever.
std::string CheckPlainFile(const std::string& path);

// The extension in lower case with its dot; empty when there is none.
std::string LowerExtension(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_FILE_H_
