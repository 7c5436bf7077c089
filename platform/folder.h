// SPDX-License-Identifier: Apache-2.0
// Lists and creates folders.
#ifndef STARFOCUS_PLATFORM_FOLDER_H_
#define STARFOCUS_PLATFORM_FOLDER_H_

#include <string>
#include <vector>

#include "platform/result.h"
#include "platform/signal_cleanup.h"

namespace starfocus {

// Returns the sorted names of all entries of a folder. Returns an error if the folder has more than
// 100 000 entries.
Result<std::vector<std::string>> ListFolder(const std::string& folder);

// A folder for output files. The destructor, and a signal that ends the program, remove the folders
// that Create made if they are empty, so that no folder remains if no file could be written.
class OutputFolder {
 public:
  OutputFolder() = default;
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Creates the folder and its parents unless they exist. Call Create once.
  Error Create(const std::string& folder);

 private:
  void RemoveEmpty() const;

  std::vector<std::string> made_;  // each folder after its parent
  SignalCleanup cleanup_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_FOLDER_H_
