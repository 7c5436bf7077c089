// SPDX-License-Identifier: Apache-2.0
// Checks that every source file names the licence in the first line, or in the second line if the
// first line starts with #!, that no two structures or classes in lib have the same name, and that
// all lines of the programs on stderr go through one module.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/source/tree.h"

namespace sources_test {
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

TEST_CASE("sources: every source file names the licence") {
  const std::vector<fs::path> files = tree::Files(
      {"lib", "simd", "platform", "examples", "tests", "toolchains", "cmake"}, kSources);
  for (const fs::path& path : files) {
    CHECK_MESSAGE(NamesLicence(path),
                  "the first line of this file must be '// " << kLicence << "': " << path.string());
  }
  CHECK(files.size() > 300);
}

// Counts the definitions of structures and classes by name. Structures and classes inside other
// structures and classes are ignored.
void CountStructures(const std::vector<std::string>& lines, std::map<std::string, int>* counts) {
  static const std::regex kDefinition("(?:struct|class) ([A-Za-z0-9]+)(?: final)?(?: :.*)? \\{.*");
  std::smatch match;
  for (const std::string& line : lines) {
    if (std::regex_match(line, match, kDefinition)) ++(*counts)[match[1]];
  }
}

TEST_CASE("sources: no two structures in lib have the same name") {
  std::map<std::string, int> counts;
  for (const fs::path& path : tree::Files({"lib"}, {".h", ".cc"})) {
    CountStructures(tree::Lines(path), &counts);
  }
  CHECK(counts.size() > 150);
  for (const auto& [name, count] : counts) {
    CAPTURE(name);
    CHECK(count == 1);
  }
}

TEST_CASE("sources: CountStructures counts both definitions of a structure that is defined twice") {
  std::map<std::string, int> counts;
  CountStructures({"struct A {", "struct B;", "class A : public B {", "  struct C {"}, &counts);
  CHECK(counts == std::map<std::string, int>{{"A", 2}});
}

TEST_CASE("sources: the programs write to stderr by platform/console.h only") {
  // The handler for lack of memory in program.cc must not allocate memory for a line.
  const std::map<std::string, int> kAllowed = {{"console.cc", 1}, {"program.cc", 1}};
  static const std::regex kStderr("\\b(stderr|cerr|clog|perror)\\b");
  std::map<std::string, int> counts;
  for (const fs::path& path :
       tree::Files({"platform", "examples/board", "examples/cli", "examples/command_line",
                    "examples/lab", "examples/scene", "examples/tap"},
                   {".h", ".cc"})) {
    if (path.parent_path().filename() == "bench")
      continue;  // examples/lab/bench is no part of them
    for (const std::string& line : tree::Lines(path)) {
      const std::string code = line.substr(0, line.find("//"));
      if (std::regex_search(code, kStderr)) ++counts[path.filename().string()];
    }
  }
  CHECK(counts == kAllowed);
}

TEST_CASE("sources: the program prints names and contents of files by platform/console.h only") {
  // printf prints only the help, the manual, the completion and the version.
  std::set<std::string> files;
  for (const fs::path& path :
       tree::Files({"examples/cli", "examples/command_line"}, {".h", ".cc"})) {
    const std::string code = tree::Read(path);
    static const std::regex kPrint("\\b(printf|puts|fputs|fwrite|putchar|cout)\\b");
    if (std::regex_search(code, kPrint)) files.insert(path.filename().string());
  }
  CHECK(files == std::set<std::string>{"help.cc", "parse.cc"});
}

}  // namespace
}  // namespace sources_test
