// SPDX-License-Identifier: Apache-2.0
// Text files of lines "key = value", as calibrations of data sets are.
#ifndef STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_
#define STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_

#include <map>
#include <optional>
#include <string>

#include "platform/result.h"

namespace starfocus {

using KeyValues = std::map<std::string, std::string>;

// Parses a text. Lines without "=" are skipped, of one key the first counts, and characters that do
// not print are left out.
KeyValues ParseKeyValues(const std::string& text);

// Parses a file of at most 1 MiB (ReadSmallFile).
Result<KeyValues> ReadKeyValues(const std::string& path);

// The value of a key; none if the key is absent or its value is not a finite number.
std::optional<double> NumberOf(const KeyValues& values, const std::string& key);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_
