// SPDX-License-Identifier: Apache-2.0
// Lists and creates folders.
#ifndef STARFOCUS_PLATFORM_FOLDER_H_
#define STARFOCUS_PLATFORM_FOLDER_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Returns the sorted names of all entries of a folder. Returns an error if the folder has more than
// 100 000 entries.
Result<std::vector<std::string>> ListFolder(const std::string& folder);

// Creates a folder and its parents unless they exist.
Error MakeFolder(const std::string& folder);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_FOLDER_H_
