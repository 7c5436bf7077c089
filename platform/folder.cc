// SPDX-License-Identifier: Apache-2.0
#include "platform/folder.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "platform/file.h"

namespace starfocus {

Result<std::vector<std::string>> ListFolder(const std::string& folder) {
  std::vector<std::string> names;
  constexpr size_t kMostFiles = 100000;
  std::error_code error;
  std::filesystem::directory_iterator at(folder, error);
  for (const std::filesystem::directory_iterator end; !error && at != end; at.increment(error)) {
    if (names.size() == kMostFiles) {
      return Expected(folder, "a folder of at most " + std::to_string(kMostFiles) + " files",
                      "more");
    }
    names.push_back(at->path().filename().string());
  }
  if (error == std::errc::not_enough_memory) return OutOfMemory(folder, "list its files");
  if (error) return Cannot("read folder", folder, error);
  std::sort(names.begin(), names.end());
  return names;
}

OutputFolder::~OutputFolder() {
  if (made_.empty()) return;
  const SignalCleanup::Turn turn;
  cleanup_.Remove(turn);
  RemoveEmpty();
}

// Calls only functions that are safe in a signal handler.
void OutputFolder::RemoveEmpty() const {
  for (size_t k = made_.size(); k-- > 0;) rmdir(made_[k].c_str());
}

Error OutputFolder::Create(const std::string& folder) {
  std::error_code error;
  // A signal handler that removes a temporary folder ends the program before it can come back.
  const SignalCleanup::Turn turn;
  std::filesystem::path path;
  for (const std::filesystem::path& part : std::filesystem::path(folder)) {
    path /= part;
    const bool made = std::filesystem::create_directory(path, error);
    if (error && error != std::errc::file_exists) {
      RemoveEmpty();
      made_.clear();
      return Cannot("create folder", folder, error);
    }
    if (made) made_.push_back(path.string());
  }
  if (!made_.empty()) {
    cleanup_.Add(
        turn, [](const void* made) { static_cast<const OutputFolder*>(made)->RemoveEmpty(); },
        this);
  }
  if (std::filesystem::is_directory(folder, error)) return {};
  return Cannot("create folder", folder, "a file of that name exists");
}

}  // namespace starfocus
