// SPDX-License-Identifier: Apache-2.0
// Text files of lines "key = value", as calibrations of data sets are.
#ifndef STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_
#define STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_

#include <map>
#include <string>

#include "platform/result.h"

namespace starfocus {

using KeyValues = std::map<std::string, std::string>;

// Adds those of a text. Lines without "=" are skipped, of one key the first counts, and characters
// that do not print are left out.
void TakeKeyValues(const std::string& text, KeyValues* values);

// Those of a file of at most 1 MiB (ReadSmallFile).
Result<KeyValues> ReadKeyValues(const std::string& path);

// Whether the key is there and its value a finite number.
bool NumberOf(const KeyValues& values, const std::string& key, double* number);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_KEY_VALUES_H_
