// SPDX-License-Identifier: Apache-2.0
// Files that are written under a temporary name until they are complete.
#ifndef STARFOCUS_PLATFORM_TEMPORARY_FILE_H_
#define STARFOCUS_PLATFORM_TEMPORARY_FILE_H_

#include <cstdio>
#include <string>

#include "platform/signal_cleanup.h"

namespace starfocus {

// A new file, which the destructor removes unless MoveTo has succeeded. If a signal ends the
// program, the file is removed as well (SignalCleanup).
class TemporaryFile {
 public:
  // Creates the temporary file in the folder `folder`. On failure, file() is null and errno is set.
  // The temporary name is short, so that file systems that accept the final name also accept the
  // temporary name.
  explicit TemporaryFile(const std::string& folder);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::FILE* file() const { return file_; }

  // Closes the temporary file and renames it to `target`. Returns false and sets errno on failure.
  bool MoveTo(const std::string& target);

 private:
  std::string name_;
  std::FILE* file_ = nullptr;
  SignalCleanup cleanup_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TEMPORARY_FILE_H_
