// SPDX-License-Identifier: Apache-2.0
// Files that are written under another name until they are whole.
#ifndef STARFOCUS_PLATFORM_TEMPORARY_FILE_H_
#define STARFOCUS_PLATFORM_TEMPORARY_FILE_H_

#include <cstdio>
#include <string>

namespace starfocus {

// A new file that is removed again unless it is moved to its place.
class TemporaryFile {
 public:
  // Makes the file in `folder`; file() is null and errno says why where that fails. The name is
  // short, so that a folder that can hold the final name can hold this one.
  explicit TemporaryFile(const std::string& folder);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::FILE* file() const { return file_; }

  // Closes the file and renames it to `target`. False with errno where that fails.
  bool MoveTo(const std::string& target);

  // From now on SIGINT, SIGTERM and SIGHUP remove the temporary files of all threads before they
  // end the program. A signal that is ignored stays so.
  static void RemoveOnSignals();

 private:
  class Turn;
  static void RemoveAllAndEnd(int signal);
  void Leave();

  std::string name_;
  std::FILE* file_ = nullptr;
  bool listed_ = false;
  TemporaryFile *next_ = nullptr, *previous_ = nullptr;  // in the list of all
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TEMPORARY_FILE_H_
