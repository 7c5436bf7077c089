// SPDX-License-Identifier: Apache-2.0
// Lists and makes folders.
#ifndef STARFOCUS_PLATFORM_FOLDER_H_
#define STARFOCUS_PLATFORM_FOLDER_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// The names of everything in a folder of at most 100 000, sorted.
Result<std::vector<std::string>> ListFolder(const std::string& folder);

// Makes the folder and those above it, unless it is there.
Error MakeFolder(const std::string& folder);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_FOLDER_H_
