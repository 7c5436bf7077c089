// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/key_values.h"

#include "platform/file.h"
#include "platform/text.h"

namespace starfocus {
namespace {

std::string Trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

void Take(const std::string& line, KeyValues* values) {
  const size_t equals = line.find('=');
  if (equals == std::string::npos) return;
  values->emplace(Trimmed(line.substr(0, equals)), Trimmed(line.substr(equals + 1)));
}

}  // namespace

KeyValues ParseKeyValues(const std::string& text) {
  KeyValues values;
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      Take(line, &values);
      line.clear();
    } else if (c >= 0x20 && c < 0x7f) {
      line += c;
    }
  }
  Take(line, &values);
  return values;
}

Result<KeyValues> ReadKeyValues(const std::string& path) {
  const Result<Bytes> bytes = ReadSmallFile(path);
  if (!bytes) return bytes.error();
  return ParseKeyValues({bytes->begin(), bytes->end()});
}

std::optional<double> NumberOf(const KeyValues& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::nullopt : ParseNumber(found->second);
}

}  // namespace starfocus
