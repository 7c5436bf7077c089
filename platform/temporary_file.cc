// SPDX-License-Identifier: Apache-2.0
#include "platform/temporary_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>

namespace starfocus {

TemporaryFile::TemporaryFile(const std::string& folder) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    name_ = folder + "/.starfocus-" + std::to_string(getpid()) + "-" + std::to_string(counter++) +
            ".part";
    const SignalCleanup::Turn turn;
    file_ = std::fopen(name_.c_str(), "wbx");
    if (file_ == nullptr && errno == EEXIST) continue;
    if (file_ == nullptr) return;
    cleanup_.Add(
        turn, [](const void* name) { unlink(static_cast<const char*>(name)); }, name_.c_str());
    return;
  }
}

TemporaryFile::~TemporaryFile() {
  if (file_ != nullptr) std::fclose(file_);
  if (!cleanup_.is_listed()) return;
  const SignalCleanup::Turn turn;
  unlink(name_.c_str());
  cleanup_.Remove(turn);
}

bool TemporaryFile::MoveTo(const std::string& target) {
  std::FILE* file = file_;
  file_ = nullptr;
  // Flush to disk before renaming: after a power failure, the final name must not refer to an empty
  // file.
  const bool whole = std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (std::fclose(file) != 0 || !whole) return false;
  const SignalCleanup::Turn turn;
  if (std::rename(name_.c_str(), target.c_str()) != 0) return false;
  cleanup_.Remove(turn);
  return true;
}

}  // namespace starfocus
