// SPDX-License-Identifier: Apache-2.0
#include "platform/text.h"

#include <cmath>
#include <cstdlib>

namespace starfocus {

std::optional<double> ParseNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::string SizeText(int64_t width, int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string EscapeXml(const std::string& text) {
  const std::string markup = "&<>\"\n\r\t";
  constexpr const char* kReferences[] = {"&amp;", "&lt;",  "&gt;", "&quot;",
                                         "&#10;", "&#13;", "&#9;"};
  std::string escaped;
  for (const char c : text) {
    const size_t at = markup.find(c);
    escaped += at == std::string::npos ? std::string(1, c) : kReferences[at];
  }
  return escaped;
}

}  // namespace starfocus
