// SPDX-License-Identifier: Apache-2.0
// Folders for files that only one run of the program needs.
#ifndef STARFOCUS_PLATFORM_TEMPORARY_FOLDER_H_
#define STARFOCUS_PLATFORM_TEMPORARY_FOLDER_H_

#include <string>

#include "platform/result.h"
#include "platform/signal_cleanup.h"

namespace starfocus {

// A new folder in $TMPDIR, or in /tmp if TMPDIR is not set. Only the user of the program can open
// the folder. The destructor removes the folder with all files in it. If a signal ends the program,
// the folder is removed as well (SignalCleanup).
class TemporaryFolder {
 public:
  TemporaryFolder() = default;
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  // Creates the folder. Call Create once, before path().
  Error Create();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  SignalCleanup cleanup_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TEMPORARY_FOLDER_H_
