// SPDX-License-Identifier: Apache-2.0
// Every source file names its licence in its first line, or in the second of scripts.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace license_test {
namespace {

namespace fs = std::filesystem;

const std::string kLicence = "SPDX-License-Identifier: Apache-2.0";

bool IsSource(const fs::path& path) {
  static const std::set<std::string> kExtensions = {".h",     ".hpp", ".c",  ".cc",   ".js",
                                                    ".cmake", ".sh",  ".py", ".java", ".gradle",
                                                    ".mjs",   ".ts",  ".css"};
  return kExtensions.count(path.extension().string()) == 1 || path.filename() == "CMakeLists.txt";
}

bool NamesLicence(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  if (line.compare(0, 2, "#!") == 0) std::getline(file, line);
  return line.find(kLicence) != std::string::npos;
}

TEST_CASE("licence: every source file names it") {
  const fs::path root = STARFOCUS_SOURCE_DIR;
  size_t files = 0;
  for (const char* folder :
       {"lib", "simd", "platform", "examples", "tests", "toolchains", "cmake"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
      ++files;
      CHECK_MESSAGE(NamesLicence(entry.path()),
                    "its first line must be '// "
                        << kLicence << "': " << fs::relative(entry.path(), root).string());
    }
  }
  CHECK(files > 300);
}

}  // namespace
}  // namespace license_test
