// SPDX-License-Identifier: Apache-2.0
// Lists and reads the files of the project. The tests in tests/source use these functions.
#ifndef STARFOCUS_TESTS_SOURCE_TREE_H_
#define STARFOCUS_TESTS_SOURCE_TREE_H_

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace tree {

inline const std::filesystem::path kRoot = STARFOCUS_SOURCE_DIR;

inline std::string Read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<std::string> Lines(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

// Returns the files in the folders and their subfolders whose extension or name is in `endings`.
inline std::vector<std::filesystem::path> Files(const std::vector<std::string>& folders,
                                                const std::set<std::string>& endings) {
  std::vector<std::filesystem::path> found;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::filesystem::path& path = entry.path();
      if (endings.count(path.extension().string()) + endings.count(path.filename().string()) > 0) {
        found.push_back(path);
      }
    }
  }
  return found;
}

}  // namespace tree

#endif  // STARFOCUS_TESTS_SOURCE_TREE_H_
