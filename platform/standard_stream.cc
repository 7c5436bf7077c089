// SPDX-License-Identifier: Apache-2.0
#include "platform/standard_stream.h"

#include <algorithm>

#include "platform/file.h"

namespace starfocus {
namespace {

// Returns the part of a path before ":-", or an empty string if this part cannot be the name of a
// format.
std::string Prefix(const std::string& path) {
  if (path.size() < 3 || path.compare(path.size() - 2, 2, ":-") != 0) return "";
  const std::string prefix = path.substr(0, path.size() - 2);
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  return std::all_of(prefix.begin(), prefix.end(), letter) ? prefix : "";
}

}  // namespace

bool IsStandardStream(const std::string& path) { return path == "-" || !Prefix(path).empty(); }

std::string InputName(const std::string& path) { return path == "-" ? "standard input" : path; }

std::string OutputName(const std::string& path) {
  return IsStandardStream(path) ? "standard output" : path;
}

std::string FormatExtension(const std::string& path) {
  if (path == "-") return ".png";
  const std::string prefix = Prefix(path);
  return prefix.empty() ? LowerExtension(path) : "." + prefix;
}

}  // namespace starfocus
