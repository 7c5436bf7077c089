// SPDX-License-Identifier: Apache-2.0
// Reads light fields of the Stanford archive. Files have the name out_RR_CC_Y_X_.png with the row,
// the column and the position of the gantry.
#ifndef STARFOCUS_PLATFORM_READERS_STANFORD_H_
#define STARFOCUS_PLATFORM_READERS_STANFORD_H_

#include <string>

#include "platform/readers/view_array.h"

namespace starfocus {

// Returns true if a picture's name has the form of the Stanford archive.
bool IsStanford(const std::string& name);

// Reverses rows and columns if necessary, so that Y grows downwards and X to the right. If the
// names contain no positions, row 0 is taken to be the bottom row.
void OrderStanford(ViewArray* array);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_STANFORD_H_
