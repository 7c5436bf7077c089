// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/frame_pattern.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "platform/folder.h"
#include "platform/natural_order.h"
#include "platform/readers/pair.h"
#include "platform/writers/picture.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// A file name with a number: text, number with at least `digits` digits, text.
struct NamePattern {
  std::string before, after;
  size_t digits = 1;

  // Returns the number in a name, or nullopt if the name does not match.
  std::optional<uint64_t> NumberIn(const std::string& name) const {
    if (name.size() <= before.size() + after.size()) return {};
    const std::string number =
        name.substr(before.size(), name.size() - before.size() - after.size());
    const bool fits = name.compare(0, before.size(), before) == 0 &&
                      name.compare(name.size() - after.size(), after.size(), after) == 0 &&
                      std::all_of(number.begin(), number.end(), IsDigit);
    // Other numbers of digits are other files, such as 007 for %05d.
    const bool padded = number.size() == digits || (number.size() > digits && number[0] != '0');
    if (!fits || !padded || number.size() > 18) return {};
    return std::strtoull(number.c_str(), nullptr, 10);
  }
};

std::optional<NamePattern> ParsePattern(const std::string& name) {
  for (size_t at = name.find('%'); at != name.npos; at = name.find('%', at + 1)) {
    size_t end = at + 1;
    while (end < name.size() && IsDigit(name[end])) ++end;
    if (end == name.size() || name[end] != 'd' || end > at + 4) continue;
    const std::string width = name.substr(at + 1, end - at - 1);
    if (!width.empty() && width[0] != '0') continue;
    const auto digits = static_cast<size_t>(std::max(1, std::atoi(width.c_str())));
    return NamePattern{name.substr(0, at), name.substr(end + 1), digits};
  }
  return {};
}

// Returns an error if there are files before and after a number that no file has.
Error CheckGaps(const std::string& path, const std::map<uint64_t, std::string>& files) {
  uint64_t next = files.begin()->first;
  for (const auto& [number, file] : files) {
    if (number != next) {
      return Expected(path, "a file with number " + std::to_string(next), "none before " + file);
    }
    ++next;
  }
  return {};
}

// Returns the files by the last numbers of their names. Returns nothing if the names differ in
// more, or if they have few of the numbers between the first and the last.
std::map<uint64_t, std::string> NumberFiles(const std::vector<std::string>& paths) {
  std::map<uint64_t, std::string> files;
  const NumberedName first = ParseNumberedName(fs::path(paths[0]).filename().string());
  for (const std::string& path : paths) {
    const NumberedName name = ParseNumberedName(fs::path(path).filename().string());
    if (name.numbers.empty() || name.numbers.back().size() > 18 || name.shape != first.shape) {
      return {};
    }
    files[std::strtoull(name.numbers.back().c_str(), nullptr, 10)] = path;
  }
  const uint64_t numbers = files.rbegin()->first - files.begin()->first + 1;
  return files.size() == paths.size() && 2 * files.size() > numbers
             ? files
             : std::map<uint64_t, std::string>();
}

// Lists the pictures of a folder in natural order.
Result<std::vector<std::string>> ListPictureFolder(const std::string& folder) {
  const Result<std::vector<std::string>> names = ListFolder(folder);
  if (!names) return names;
  std::error_code ignored;
  std::vector<std::string> paths;
  for (const std::string& name : *names) {
    const std::string path = (fs::path(folder) / name).string();
    if (name[0] == '.' || !fs::is_regular_file(path, ignored)) continue;
    if (HasDepthExtension(name) || IsPictureExtension(LowerExtension(name))) paths.push_back(path);
  }
  if (paths.empty()) return Expected(folder, "a folder with pictures", "none");
  std::sort(paths.begin(), paths.end(), NaturalLess);
  const std::map<uint64_t, std::string> numbered = NumberFiles(paths);
  if (Error error = numbered.empty() ? Error() : CheckGaps(folder, numbered)) return error;
  return paths;
}

}  // namespace

bool IsFramePattern(const std::string& path) {
  std::error_code ignored;
  return ParsePattern(fs::path(path).filename().string()) && !fs::exists(path, ignored);
}

Result<std::map<uint64_t, std::string>> FindPatternFiles(const std::string& pattern) {
  const fs::path parent = fs::path(pattern).parent_path();
  const Result<std::vector<std::string>> names = ListFolder(parent.empty() ? "." : parent.string());
  if (!names) return names.error();
  const std::optional<NamePattern> parsed = ParsePattern(fs::path(pattern).filename().string());
  std::map<uint64_t, std::string> files;
  for (const std::string& name : *names) {
    const std::optional<uint64_t> number = parsed->NumberIn(name);
    if (number) files[*number] = (parent / name).string();
  }
  if (files.empty()) return Expected(pattern, "files with numbers of this pattern", "none");
  return files;
}

Result<std::vector<std::string>> ListPictures(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return ListPictureFolder(path);
  if (!IsFramePattern(path)) return std::vector<std::string>{path};
  const Result<std::map<uint64_t, std::string>> files = FindPatternFiles(path);
  if (!files) return files.error();
  if (Error error = CheckGaps(path, *files)) return error;
  std::vector<std::string> paths;
  for (const auto& [number, file] : *files) paths.push_back(file);
  return paths;
}

Result<std::vector<std::string>> PairWithPattern(const std::vector<std::string>& frames,
                                                 const std::string& pattern,
                                                 const std::string& kind) {
  const Result<std::map<uint64_t, std::string>> files = FindPatternFiles(pattern);
  if (!files) return files.error();
  std::vector<std::string> paths;
  for (const std::string& frame : frames) {
    const NumberedName name = ParseNumberedName(fs::path(frame).stem().string());
    const std::string last = name.numbers.empty() ? "" : name.numbers.back();
    const bool has_number = !name.numbers.empty() && last.size() <= 18;
    const auto file =
        has_number ? files->find(std::strtoull(last.c_str(), nullptr, 10)) : files->end();
    if (file == files->end()) {
      return Expected(frame, "a " + kind + " with the number of the frame in " + pattern, "none");
    }
    paths.push_back(file->second);
  }
  return paths;
}

}  // namespace starfocus
