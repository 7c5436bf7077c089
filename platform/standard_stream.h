// SPDX-License-Identifier: Apache-2.0
// Handles "-" instead of a file name: standard input for reading, standard output for writing. A
// prefix such as in "jpg:-" selects the format of a picture; the default is PNG.
#ifndef STARFOCUS_PLATFORM_STANDARD_STREAM_H_
#define STARFOCUS_PLATFORM_STANDARD_STREAM_H_

#include <string>

namespace starfocus {

// Returns true for "-", and for a format followed by ":-".
bool IsStandardStream(const std::string& path);

// Returns the name of an input for errors: "standard input" for "-".
std::string InputName(const std::string& path);

// Returns the extension that selects the format of an output picture, in lower case with its dot.
std::string FormatExtension(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_STANDARD_STREAM_H_
