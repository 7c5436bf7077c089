// SPDX-License-Identifier: Apache-2.0
// Reads light fields of the Stanford archive. File names have the form out_RR_CC_Y_X_.png, with the
// row, the column and the position of the camera gantry.
#ifndef STARFOCUS_PLATFORM_READERS_STANFORD_H_
#define STARFOCUS_PLATFORM_READERS_STANFORD_H_

#include <string>

#include "platform/readers/view_array.h"

namespace starfocus {

// Returns true if `name` has the form of picture names in the Stanford archive.
bool IsStanford(const std::string& name);

// Reverses the rows and columns of a view array if necessary, so that Y grows downwards and X grows
// to the right. If the file names contain no positions, row 0 is taken to be the bottom row.
void OrderStanford(ViewArray* array);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_STANFORD_H_
