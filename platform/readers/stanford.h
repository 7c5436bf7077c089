// SPDX-License-Identifier: Apache-2.0
// The Stanford light field archive: out_RR_CC_Y_X_.png, by row, column, and where the gantry stood.
#ifndef STARFOCUS_PLATFORM_READERS_STANFORD_H_
#define STARFOCUS_PLATFORM_READERS_STANFORD_H_

#include <string>

#include "platform/readers/view_array.h"

namespace starfocus {

// Whether a picture's name is one of the archive's.
bool IsStanford(const std::string& name);

// Turns rows and columns such that Y grows downwards and X to the right; without places in the
// names rows are counted from below.
void OrderStanford(ViewArray* array);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_STANFORD_H_
