// SPDX-License-Identifier: Apache-2.0
#include "platform/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

#include "platform/remove_folder.h"

namespace starfocus {
Error TemporaryFolder::Create() {
  const char* parent = std::getenv("TMPDIR");
  const std::string beginning = parent != nullptr && *parent != '\0' ? parent : "/tmp";
  path_ = beginning + "/starfocus-" + std::string(6, 'X');  // mkdtemp replaces each X
  const SignalCleanup::Turn turn;
  if (mkdtemp(path_.data()) == nullptr) {
    return Cannot("create folder", path_, {errno, std::generic_category()});
  }
  cleanup_.Add(
      turn, [](const void* path) { RemoveFolder(static_cast<const char*>(path)); }, path_.c_str());
  return {};
}

TemporaryFolder::~TemporaryFolder() {
  if (!cleanup_.is_listed()) return;
  RemoveFolder(path_.c_str());
  const SignalCleanup::Turn turn;
  cleanup_.Remove(turn);
}

}  // namespace starfocus
