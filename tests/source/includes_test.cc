// SPDX-License-Identifier: Apache-2.0
// Reads the dependencies between the folders of the project from #include lines, and checks them.
// Data flows in one direction through lib/, and no two modules include each other.
// docs/developing.md describes the folders.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/source/tree.h"

namespace includes_test {
namespace {

namespace fs = std::filesystem;

// Source files may include headers of their own folder and headers of earlier folders in this list.
const std::vector<std::string> kRooms = {"simd",          "lib/base",   "lib/optics", "lib/io",
                                         "lib/matting",   "lib/plan",   "lib/gather", "lib/slices",
                                         "lib/line_scan", "lib/engine", "lib/depth",  "lib/video",
                                         "lib/api"};

struct Include {
  std::string from, to;  // paths relative to the root of the project
};

std::string RoomOf(const std::string& file) {
  const std::string folder = fs::path(file).parent_path().generic_string();
  return folder.rfind("lib/", 0) == 0 ? folder : folder.substr(0, folder.find('/'));
}

// Returns the module of a file. A module is a header and the source file with the same name. In
// simd/, each file is a separate module, because source files in simd/ include files that include
// the source file's header.
std::string ModuleOf(const std::string& file) {
  if (RoomOf(file) == "simd") return file;
  return fs::path(file).replace_extension().generic_string();
}

std::vector<Include> ReadIncludes(const std::vector<std::string>& folders) {
  const std::regex line_of("^ *#include \"((lib|simd|platform|examples|tests)/[^\"]+)\".*");
  std::vector<Include> includes;
  for (const fs::path& path : tree::Files(folders, {".h", ".cc", ".hpp"})) {
    std::smatch found;
    for (const std::string& line : tree::Lines(path)) {
      if (!std::regex_match(line, found, line_of)) continue;
      includes.push_back({fs::relative(path, tree::kRoot).generic_string(), found[1]});
    }
  }
  return includes;
}

int PlaceOf(const std::string& room) {
  const auto found = std::find(kRooms.begin(), kRooms.end(), room);
  return found == kRooms.end() ? -1 : int(found - kRooms.begin());
}

// Returns the includes that violate the order of kRooms, one line each.
std::vector<std::string> FindBackward(const std::vector<Include>& includes) {
  std::vector<std::string> found;
  for (const Include& include : includes) {
    const int from = PlaceOf(RoomOf(include.from)), to = PlaceOf(RoomOf(include.to));
    if (from < 0 || to < 0 || to > from) found.push_back(include.from + " -> " + include.to);
  }
  return found;
}

// Returns the modules that include themselves through other modules.
std::set<std::string> FindCircles(const std::vector<Include>& includes) {
  std::map<std::string, std::set<std::string>> needs;  // modules that a module includes
  for (const Include& include : includes) {
    const std::string from = ModuleOf(include.from), to = ModuleOf(include.to);
    if (from != to) needs[from].insert(to);
  }
  std::set<std::string> found;
  for (const auto& [module, to] : needs) {
    std::set<std::string> reached = to;
    std::vector<std::string> left(to.begin(), to.end());
    while (!left.empty()) {
      const std::set<std::string> next = needs[left.back()];
      left.pop_back();
      for (const std::string& name : next) {
        if (reached.insert(name).second) left.push_back(name);
      }
    }
    if (reached.count(module) == 1) found.insert(module);
  }
  return found;
}

}  // namespace

TEST_CASE("includes: folders of simd and lib include only headers of earlier folders") {
  const std::vector<Include> includes = ReadIncludes({"lib", "simd"});
  REQUIRE(includes.size() > 200);
  for (const std::string& line : FindBackward(includes)) FAIL_CHECK(line);
  for (const std::string& room : kRooms) {
    const auto inside = [&](const Include& include) { return RoomOf(include.from) == room; };
    const auto count = std::count_if(includes.begin(), includes.end(), inside);
    CHECK(count > 0);
    std::printf("%-14s %3d includes, none backwards\n", room.c_str(), int(count));
  }
}

TEST_CASE("includes: the modules of simd and lib form no circle of includes") {
  for (const std::string& module : FindCircles(ReadIncludes({"lib", "simd"})))
    FAIL_CHECK("a circle of includes contains the module " << module);
}

TEST_CASE("includes: platform code uses the engine only through its C ABI") {
  for (const Include& include : ReadIncludes({"platform"})) {
    CHECK_MESSAGE(RoomOf(include.to) == "platform", include.from << " -> " << include.to);
  }
}

TEST_CASE("includes: tests access the internals of the engine through one header") {
  const std::string inside = "tests/support/inside.h";
  int found = 0;
  for (const Include& include : ReadIncludes({"tests"})) {
    if (RoomOf(include.to) != "lib/engine") continue;
    CHECK_MESSAGE(include.from == inside, include.from << " -> " << include.to);
    ++found;
  }
  CHECK(found > 0);
}

TEST_CASE("includes: FindBackward and FindCircles detect backward includes and circles") {
  const std::vector<Include> backward = {{"lib/plan/partition.cc", "lib/gather/gather.h"}};
  CHECK(FindBackward(backward) ==
        std::vector<std::string>{"lib/plan/partition.cc -> lib/gather/gather.h"});
  CHECK(FindBackward({{"lib/gather/gather.h", "lib/plan/partition.h"}}).empty());
  CHECK(FindBackward({{"lib/optics/rules.cc", "platform/file.h"}}).size() == 1);
  const std::vector<Include> circle = {{"lib/io/field.cc", "lib/io/block_pixels.h"},
                                       {"lib/io/block_pixels.h", "lib/io/field.h"},
                                       {"lib/io/field.h", "lib/io/window.h"}};
  CHECK(FindCircles(circle) == std::set<std::string>{"lib/io/block_pixels", "lib/io/field"});
}

}  // namespace includes_test
