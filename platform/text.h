// SPDX-License-Identifier: Apache-2.0
// Converts numbers, sizes and letters for files and messages.
#ifndef STARFOCUS_PLATFORM_TEXT_H_
#define STARFOCUS_PLATFORM_TEXT_H_

#include <cstdint>
#include <optional>
#include <string>

namespace starfocus {

// Parses a finite number. Returns nullopt unless the whole text is a finite number.
std::optional<double> ParseNumber(const std::string& text);

// Formats a size as "640x480".
std::string SizeText(int64_t width, int64_t height);

// Formats a number with six significant digits.
std::string NumberText(double value);

// Converts the letters A to Z to lower case.
std::string Lower(std::string text);

// Replaces control characters by spaces: the characters below U+0020, U+007F, and U+0080 to U+009F,
// which terminals interpret, in UTF-8 or as single bytes. Other characters of UTF-8 are unchanged.
std::string Printable(std::string text);

// Escapes a text for XML and HTML: replaces markup characters and line breaks by character
// references.
std::string EscapeXml(const std::string& text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TEXT_H_
