// SPDX-License-Identifier: Apache-2.0
// Texts of files and messages: numbers, sizes, letters.
#ifndef STARFOCUS_PLATFORM_TEXT_H_
#define STARFOCUS_PLATFORM_TEXT_H_

#include <cstdint>
#include <optional>
#include <string>

namespace starfocus {

// The finite number that is all of `text`; none if the text is anything else.
std::optional<double> ParseNumber(const std::string& text);

// "640x480".
std::string SizeText(int64_t width, int64_t height);

// The text with the letters A to Z in lower case.
std::string Lower(std::string text);

// The text for XML and HTML: markup and line breaks become references.
std::string EscapeXml(const std::string& text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TEXT_H_
