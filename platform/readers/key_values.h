// SPDX-License-Identifier: Apache-2.0
// Parses text files with lines "key = value", such as the calibration files of data sets.
#ifndef STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_
#define STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_

#include <map>
#include <optional>
#include <string>

#include "platform/result.h"

namespace starfocus {

using KeyValues = std::map<std::string, std::string>;

// Parses `text`. Skips lines without "=", keeps the first value of a repeated key, and removes
// non-printable characters.
KeyValues ParseKeyValues(const std::string& text);

// Parses the "key = value" lines of a file of at most 1 MiB (ReadSmallFile).
Result<KeyValues> ReadKeyValues(const std::string& path);

// Returns the value of a key, or nullopt if the key is absent or its value is not a finite number.
std::optional<double> NumberOf(const KeyValues& values, const std::string& key);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_
