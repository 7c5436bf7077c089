// SPDX-License-Identifier: Apache-2.0
// Reads the seeds of the fuzz targets, which tests also use, and changes copies of them.
#ifndef STARFOCUS_TESTS_SUPPORT_SEED_FILE_H_
#define STARFOCUS_TESTS_SUPPORT_SEED_FILE_H_

#include <doctest/doctest.h>

#include <string>

#include "platform/file.h"
#include "tests/support/error_line.h"

namespace starfocus {

inline std::string Seed(const std::string& name) {
  const Bytes bytes = ValueOf(ReadFile(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/" + name));
  return {bytes.begin(), bytes.end()};
}

// Returns `file` with `bytes` written `behind` bytes after the end of the first `text`.
inline std::string Changed(std::string file, const std::string& text, size_t behind,
                           const std::string& bytes) {
  const size_t at = file.find(text);
  REQUIRE(at != std::string::npos);
  return file.replace(at + text.size() + behind, bytes.size(), bytes);
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_SUPPORT_SEED_FILE_H_
