// SPDX-License-Identifier: Apache-2.0
// Finds arrays of views in rows and columns, as most light fields are published, and chooses up to
// 17 views from an array.
#ifndef STARFOCUS_PLATFORM_READERS_VIEW_ARRAY_H_
#define STARFOCUS_PLATFORM_READERS_VIEW_ARRAY_H_

#include <string>
#include <vector>

#include "platform/readers/photo.h"
#include "platform/result.h"
#include "platform/view_files.h"

namespace starfocus {

// An array of views: the paths of rows * columns pictures. The paths are sorted by row from top to
// bottom, then by column from left to right.
struct ViewArray {
  int rows = 0, columns = 0;
  std::vector<std::string> paths;
};

// Views chosen from an array, with their positions. `reach` is the number of columns from the
// centre to the view at u = 1.
struct Star {
  std::vector<ViewFile> views;
  int reach = 0;
};

// Chooses views at the positions of starfocus_view_position from an array of at least 3 x 3 views,
// as far from the centre view as possible. The result has 17 views if the outermost views are an
// even number of views away from the centre view, otherwise 9. If the array is a single row or
// column, ChooseStar chooses up to 17 views. If the number of rows or columns is even, the last row
// or column is ignored. Adds an entry to `facts`.
Result<Star> ChooseStar(const std::string& where, const ViewArray& array, Facts* facts);

// Finds pictures whose names differ in two numbers (row and column) or in a single number, for
// example NAME_00_01.png. If file names differ in more than two numbers, only the first two numbers
// count, which excludes the camera positions in Stanford's names. The array is empty if the file
// names do not have the form of view names.
Result<ViewArray> FindArray(const std::string& folder, const std::vector<std::string>& names);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_VIEW_ARRAY_H_
