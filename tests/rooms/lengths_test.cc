// SPDX-License-Identifier: Apache-2.0
// Checks that files and functions are no longer than CONTRIBUTING.md allows.
#include <doctest/doctest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/rooms/tree.h"

namespace lengths_test {
namespace {

namespace fs = std::filesystem;

constexpr size_t kFileLines = 500, kFunctionLines = 60;

const std::set<std::string> kSources = {".h", ".hpp", ".c", ".cc", ".py", ".java"};

// Returns the first lines of functions with more than `limit` lines. In the layout of clang-format,
// the last line of a function contains only a brace. The first line of a function is the last
// preceding line with the indentation of this brace. Lines that contain only a case label are not
// counted.
std::vector<std::string> FindLong(const std::vector<std::string>& lines, size_t limit) {
  const std::regex type(
      "\\s*(?:public |static |final )*(typedef|template|struct|class|enum|union|namespace)\\b.*");
  const std::regex one_case("\\s*case [A-Za-z_0-9:]+:");
  std::vector<std::string> found;
  for (size_t end = 0; end < lines.size(); ++end) {
    const size_t indent = lines[end].find('}');
    if (indent > 2 || lines[end].size() != indent + 1) continue;
    size_t count = 1, begin = end;
    do {
      if (begin-- == 0) break;
      count += std::regex_match(lines[begin], one_case) ? 0 : 1;
    } while (lines[begin].find_first_not_of(' ') != indent);
    if (begin < end && count > limit && !std::regex_match(lines[begin], type)) {
      found.push_back(lines[begin]);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("lengths: no file except public headers has more than 500 lines") {
  const std::vector<fs::path> sources =
      tree::Files({"lib", "simd", "platform", "examples", "tests"}, kSources);
  REQUIRE(sources.size() > 300);
  for (const fs::path& path : sources) {
    if (path.string().find("lib/include/") != std::string::npos) continue;
    CHECK_MESSAGE(tree::Lines(path).size() <= kFileLines, path.string());
  }
}

TEST_CASE("lengths: no function has more than 60 lines") {
  for (const fs::path& path : tree::Files({"lib", "simd", "platform", "examples"}, kSources)) {
    for (const std::string& line : FindLong(tree::Lines(path), kFunctionLines)) {
      FAIL_CHECK(path.string() << ": " << line);
    }
  }
}

TEST_CASE("lengths: FindLong detects long functions and does not count lines of case labels") {
  const auto body = [](const std::string& head, const std::string& line, const std::string& close) {
    std::vector<std::string> lines = {head};
    lines.insert(lines.end(), 20, line);
    lines.push_back(close);
    return lines;
  };
  CHECK(FindLong(body("int Sum(int a) {", "  ++a;", "}"), 21).size() == 1);
  CHECK(FindLong(body("int Sum(int a) {", "  ++a;", "}"), 22).empty());
  CHECK(FindLong(body("  int Sum(int a) const {", "    ++a;", "  }"), 21).size() == 1);
  CHECK(FindLong(body("const char* Name(int a) {", "    case STARFOCUS_OK:", "}"), 21).empty());
  CHECK(FindLong(body("struct Sum {", "  int a;", "}"), 21).empty());
}

}  // namespace lengths_test
