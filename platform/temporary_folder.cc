// SPDX-License-Identifier: Apache-2.0
#include "platform/temporary_folder.h"

#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace starfocus {
namespace {

// Removes a folder in a signal handler, where functions that list folders must not be called. For
// the same reason, RemoveFolder calls vfork, because fork may wait for a lock of the C library.
void RemoveFolder(const void* path) {
  const pid_t child = vfork();
  if (child == 0) {
    execl("/bin/rm", "rm", "-rf", "--", static_cast<const char*>(path), nullptr);
    _exit(1);
  }
  if (child > 0) waitpid(child, nullptr, 0);
}

}  // namespace

Error TemporaryFolder::Create() {
  const char* parent = std::getenv("TMPDIR");
  const std::string beginning = parent != nullptr && *parent != '\0' ? parent : "/tmp";
  path_ = beginning + "/starfocus-" + std::string(6, 'X');  // mkdtemp replaces each X
  const SignalCleanup::Turn turn;
  if (mkdtemp(path_.data()) == nullptr) {
    return Cannot("create folder", path_, {errno, std::generic_category()});
  }
  cleanup_.Add(turn, RemoveFolder, path_.c_str());
  return {};
}

TemporaryFolder::~TemporaryFolder() {
  if (!cleanup_.is_listed()) return;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  const SignalCleanup::Turn turn;
  cleanup_.Remove(turn);
}

}  // namespace starfocus
