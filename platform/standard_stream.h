// SPDX-License-Identifier: Apache-2.0
// Handles the file name "-", which means standard input for reading and standard output for
// writing. A prefix selects the format of a picture, for example "jpg:-". Pictures on standard
// output are PNG by default.
#ifndef STARFOCUS_PLATFORM_STANDARD_STREAM_H_
#define STARFOCUS_PLATFORM_STANDARD_STREAM_H_

#include <string>

namespace starfocus {

// Returns true for the path "-", and for the name of a format followed by ":-".
bool IsStandardStream(const std::string& path);

// Returns the name of an input in error messages: "standard input" for the path "-", otherwise the
// path.
std::string InputName(const std::string& path);

// Returns the name of an output in messages: "standard output" for a standard stream, otherwise the
// path.
std::string OutputName(const std::string& path);

// Returns the extension that selects the format of an output picture, in lower case with its dot.
std::string FormatExtension(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_STANDARD_STREAM_H_
