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
                                         "lib/line_scan", "lib/engine", "lib/depth",  "lib/api"};

// Folders outside the engine, each with the folders whose headers it may include. From the engine,
// the outside folders may include only public headers.
const std::map<std::string, std::set<std::string>> kOutside = {
    {"platform", {"platform"}},
};

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

std::vector<Include> ReadIncludes(const std::string& folder) {
  const std::regex line_of("^ *#include \"((lib|simd|platform|examples|tests)/[^\"]+)\".*");
  std::vector<Include> includes;
  for (const fs::path& path : tree::Files({folder}, {".h", ".cc", ".hpp"})) {
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

using Needs = std::map<std::string, std::set<std::string>>;  // modules that a module includes

// Removes modules that do not include any remaining module from `needs`. Returns true if a module
// was removed.
bool DropLeaves(Needs* needs) {
  bool changed = false;
  for (auto module = needs->begin(); module != needs->end();) {
    std::set<std::string>& to = module->second;
    for (auto need = to.begin(); need != to.end();) {
      need = needs->count(*need) == 0 ? to.erase(need) : std::next(need);
    }
    changed |= to.empty();
    module = to.empty() ? needs->erase(module) : std::next(module);
  }
  return changed;
}

// Removes modules that no remaining module includes. Returns true if a module was removed.
bool DropRoots(Needs* needs) {
  std::set<std::string> needed;
  for (const auto& [module, to] : *needs) needed.insert(to.begin(), to.end());
  bool changed = false;
  for (auto module = needs->begin(); module != needs->end();) {
    const bool root = needed.count(module->first) == 0;
    changed |= root;
    module = root ? needs->erase(module) : std::next(module);
  }
  return changed;
}

// Returns the modules of circles of includes, and the modules on paths between circles.
std::set<std::string> FindCircles(const std::vector<Include>& includes) {
  Needs needs;
  for (const Include& include : includes) {
    const std::string from = ModuleOf(include.from), to = ModuleOf(include.to);
    if (from != to) needs[from].insert(to);
  }
  while (DropLeaves(&needs) || DropRoots(&needs)) {
  }
  std::set<std::string> left;
  for (const auto& [module, to] : needs) left.insert(module);
  return left;
}

}  // namespace

TEST_CASE("includes: folders of simd and lib include only headers of earlier folders") {
  std::vector<Include> includes = ReadIncludes("lib");
  const std::vector<Include> kernels = ReadIncludes("simd");
  includes.insert(includes.end(), kernels.begin(), kernels.end());
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
  std::vector<Include> includes = ReadIncludes("lib");
  const std::vector<Include> kernels = ReadIncludes("simd");
  includes.insert(includes.end(), kernels.begin(), kernels.end());
  for (const std::string& module : FindCircles(includes))
    FAIL_CHECK("a circle of includes contains the module " << module);
}

TEST_CASE("includes: platform code uses the engine only through its C ABI") {
  for (const auto& [folder, rooms] : kOutside) {
    for (const Include& include : ReadIncludes(folder)) {
      CHECK_MESSAGE(rooms.count(RoomOf(include.to)) == 1, include.from << " -> " << include.to);
    }
  }
}

TEST_CASE("includes: tests access the internals of the engine through one header") {
  const std::string inside = "tests/support/inside.h";
  int found = 0;
  for (const Include& include : ReadIncludes("tests")) {
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
