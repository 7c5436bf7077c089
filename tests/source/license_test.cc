// SPDX-License-Identifier: Apache-2.0
// Checks that every source file names the licence in the first line, or in the second line if the
// first line starts with #!.
#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/source/tree.h"

namespace license_test {
namespace {

namespace fs = std::filesystem;

const std::string kLicence = "SPDX-License-Identifier: Apache-2.0";

const std::set<std::string> kSources = {".h",     ".hpp", ".c",   ".cc",           ".js",
                                        ".cmake", ".sh",  ".py",  ".java",         ".gradle",
                                        ".mjs",   ".ts",  ".css", "CMakeLists.txt"};

bool NamesLicence(const fs::path& path) {
  const std::vector<std::string> lines = tree::Lines(path);
  const size_t first = !lines.empty() && lines[0].compare(0, 2, "#!") == 0 ? 1 : 0;
  return first < lines.size() && lines[first].find(kLicence) != std::string::npos;
}

TEST_CASE("licence: every source file names the licence") {
  const std::vector<fs::path> files = tree::Files(
      {"lib", "simd", "platform", "examples", "tests", "toolchains", "cmake"}, kSources);
  for (const fs::path& path : files) {
    CHECK_MESSAGE(NamesLicence(path),
                  "the first line of this file must be '// " << kLicence << "': " << path.string());
  }
  CHECK(files.size() > 300);
}

}  // namespace
}  // namespace license_test
