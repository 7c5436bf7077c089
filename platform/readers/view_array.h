// SPDX-License-Identifier: Apache-2.0
// Views in rows and columns, as most light fields are published, and the star among them.
#ifndef STARFOCUS_PLATFORM_READERS_VIEW_ARRAY_H_
#define STARFOCUS_PLATFORM_READERS_VIEW_ARRAY_H_

#include <string>
#include <vector>

#include "platform/readers/photo.h"
#include "platform/result.h"
#include "platform/view_files.h"

namespace starfocus {

// rows * columns paths, row after row from the top, each from the left.
struct ViewArray {
  int rows = 0, columns = 0;
  std::vector<std::string> paths;
};

// What is chosen of an array: its files by their positions, and how many columns away the view at
// u = 1 is.
struct Star {
  std::vector<ViewFile> views;
  int reach = 0;
};

// The widest star within an array of at least 3 x 3, 17 views where halves of its reach are whole
// and 9 elsewhere; of a single row or column up to 17 views. An even row or column more is left
// out. A fact tells what was chosen.
Result<Star> ChooseStar(const std::string& where, const ViewArray& array, Facts* facts);

// Pictures whose names differ in two numbers, row and column, or in one: NAME_00_01.png and so on.
// The first two that differ count, so that the camera's place in Stanford's names does not.
// The array is empty when the names are none of that kind.
Result<ViewArray> FindArray(const std::string& folder, const std::vector<std::string>& names);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_VIEW_ARRAY_H_
