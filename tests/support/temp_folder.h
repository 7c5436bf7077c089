// SPDX-License-Identifier: Apache-2.0
// A temporary folder for one test. The folder is removed with its contents at the end of the test.
#ifndef STARFOCUS_TESTS_SUPPORT_TEMP_FOLDER_H_
#define STARFOCUS_TESTS_SUPPORT_TEMP_FOLDER_H_

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>

namespace starfocus {

class TempFolder {
 public:
  TempFolder() {
    static std::atomic<int> counter{0};
    const auto stamp = std::chrono::system_clock::now().time_since_epoch().count();
    do {
      path_ = std::filesystem::temp_directory_path() /
              ("starfocus-test-" + std::to_string(stamp) + "-" + std::to_string(counter++));
    } while (!std::filesystem::create_directory(path_));
  }
  ~TempFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

  int count() const {  // number of files and folders in the folder, without subfolders' contents
    int entries = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      (void)entry;
      ++entries;
    }
    return entries;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_SUPPORT_TEMP_FOLDER_H_
