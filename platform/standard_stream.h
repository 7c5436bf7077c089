// SPDX-License-Identifier: Apache-2.0
// "-" in place of a file's name: standard input of what is read, standard output of what is
// written. "jpg:-" names the format of a picture, too, which is PNG where nothing does.
#ifndef STARFOCUS_PLATFORM_STANDARD_STREAM_H_
#define STARFOCUS_PLATFORM_STANDARD_STREAM_H_

#include <string>

namespace starfocus {

// "-", or a format and ":-".
bool IsStandardStream(const std::string& path);

// What errors call a file that is read: "standard input" for "-".
std::string InputName(const std::string& path);

// The extension that tells the format of a picture to be written, in lower case with its dot.
std::string FormatExtension(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_STANDARD_STREAM_H_
